// What weights.smoothness promises: more of it, and the result is smoother.
#include "solver/problem/smoothness.h"

#include <gtest/gtest.h>

#include "solver/optimizer/spacetime.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

// Mean third difference of the nodes' ways from the source (m per frame^3).
double Roughness(const Scene& scene, const std::array<Clip, 2>& clips) {
  double sum = 0, count = 0;
  for (int f = 0; f < 2; ++f) {
    std::vector<std::vector<Vec3>> node;
    for (const Pose& pose : clips[f].frames) node.push_back(PoseBody(scene.body[f], pose).node);
    for (size_t t = 0; t + 3 < node.size(); ++t) {
      for (size_t n = 0; n < node[t].size(); ++n, ++count) {
        sum += (node[t + 3][n] - 3 * node[t + 2][n] + 3 * node[t + 1][n] - node[t][n]).norm();
      }
    }
  }
  return sum / count;
}

TEST(Smoothness, OneWeightWorksOnJointsAndRoots) {
  const Scene scene = SmallScene(6, 0.2);
  Settings settings;
  settings.weights.root_smoothness = 0;
  const VecX once = Smoothness(scene, settings).weight();
  settings.weights.smoothness *= 3;
  EXPECT_TRUE(Smoothness(scene, settings).weight().isApprox(3 * once, 1e-12));
  EXPECT_GT(once.minCoeff(), 0);
  EXPECT_EQ(once[0], settings.weights.smoothness / 3 * settings.joint_weights.root);
  // root_smoothness adds to the roots alone.
  settings.weights.smoothness = 0;
  settings.weights.root_smoothness = 7;
  const VecX root = Smoothness(scene, settings).weight();
  for (int f = 0; f < 2; ++f) {
    const int first = scene.FirstCoordinate(f), n = scene.body[f].num_coordinates();
    EXPECT_EQ(root.segment(first, 6), VecX::Constant(6, 7.0));
    EXPECT_TRUE(root.segment(first + 6, n - 6).isZero(0));
  }
}

TEST(Smoothness, MoreIsSmoother) {
  // Contacts that come and go make the edit rough. Of weights beyond the default the contacts get
  // the worse, and the result is no smoother for it.
  const Scene scene = SmallScene(30, 0.25);
  Settings settings;
  settings.solve.polish_decrease = 1e-5;
  std::vector<double> rough;
  for (const double weight : {0.3, 1.0, 3.0, 10.0}) {
    settings.weights.smoothness = weight;
    const Problem problem(scene, settings);
    const SolveResult solved =
        SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
    rough.push_back(Roughness(scene, EditedClips(scene, solved.unknowns)));
    std::printf("smoothness %5.0f: %.3g m per frame^3\n", weight, rough.back());
  }
  for (size_t k = 1; k < rough.size(); ++k) EXPECT_LT(rough[k], rough[k - 1]) << k;
  // Of the joints alone it is not so: a root that stays soft takes the shocks.
  settings.joint_weights.root = 0.01;
  settings.weights.smoothness = 10;
  const Problem problem(scene, settings);
  const SolveResult solved =
      SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
  EXPECT_GT(Roughness(scene, EditedClips(scene, solved.unknowns)), 2 * rough.back());
}

}  // namespace
}  // namespace retarget::solver
