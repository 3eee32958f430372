// tangle_aim and hand_contact: what they ask for, and what they do in a solve.
#include <gtest/gtest.h>

#include "model/body/pass_through.h"
#include "model/body/path.h"
#include "model/geometry/polyline.h"
#include "solver/optimizer/spacetime.h"
#include "solver/problem/terms/hand_contact.h"
#include "solver/problem/terms/tangle_aim.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

double SignedGli(const Scene& scene, const std::array<Clip, 2>& clips, int t, size_t tag) {
  const TangleTarget& held = scene.tangles[tag];
  const auto points = [&](int f, const Path& path) {
    const PosedBody posed = PoseBody(scene.body[f], clips[f].frames[t]);
    return PointsOn(posed.node, NodesOn(scene.body[f], path));
  };
  return held.sign * PolylineGli(points(0, held.tag.tangle.a), points(1, held.tag.tangle.b));
}

std::vector<double> Residuals(const Term& term, const Scene& scene, const Unknowns& u, int t) {
  Frame frame;
  frame.Set(scene, u, t, false);
  Rows rows;
  rows.Reset(frame, false);
  term.Evaluate(frame, &rows);
  return rows.residual();
}

TEST(TangleAim, IsTwoSidedAndBounded) {
  Scene scene = SmallScene(1, 0);
  ASSERT_FALSE(scene.tangles.empty());
  const Unknowns u = UnknownsFromPoses(scene, scene.source);
  const double here = SignedGli(scene, scene.source, 0, 0);
  scene.tangles.resize(1);
  EXPECT_NEAR(scene.tangles[0].aim, here, 1e-12) << "the template's own";
  for (const double off : {-2.0, -0.1, 0.0, 1e-3, 0.1, 2.0}) {
    scene.tangles[0].aim = here + off;
    const std::vector<double> r = Residuals(TangleAim(scene), scene, u, 0);
    ASSERT_EQ(r.size(), 1u);
    EXPECT_LE(std::abs(r[0]), 0.25);
    EXPECT_EQ(r[0] < 0, off < 0);
    if (std::abs(off) <= 0.1) {
      EXPECT_NEAR(r[0], off, 0.06 * std::abs(off));
    }
  }
}

// With the aim, tags come closer to the template's value than without it, and no limb is on another
// side of another.
TEST(TangleAim, DrawsTagsToTheTemplateAndNothingThrough) {
  Scene scene = SmallScene(8, 0.2);
  for (int t = 0; t < 8; ++t) scene.source[1].frames[t].root_position += Vec3(0, 0, 0.12);
  Settings settings;
  settings.weights.tangle = 0;
  double off[2] = {0, 0};
  std::array<std::array<Clip, 2>, 2> clips;
  for (const int aims : {0, 1}) {
    settings.weights.tangle_aim = 10 * aims;
    const Problem problem(scene, settings);
    const SolveResult solved =
        SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
    clips[aims] = EditedClips(scene, solved.unknowns);
    for (int t = 0; t < 8; ++t) {
      for (size_t k = 0; k < scene.tangles.size(); ++k) {
        off[aims] += std::abs(SignedGli(scene, clips[aims], t, k) - scene.tangles[k].aim);
      }
    }
  }
  EXPECT_LT(off[1], 0.7 * off[0]);
  for (int t = 0; t < 8; ++t) {
    const auto nodes = [&](const std::array<Clip, 2>& of) {
      return NodePositions{PoseBody(scene.body[0], of[0].frames[t]).node,
                           PoseBody(scene.body[1], of[1].frames[t]).node};
    };
    EXPECT_LT(LargestGliJump(scene.body, nodes(clips[0]), nodes(clips[1]), 10).size, 0.5) << t;
  }
}

TEST(HandContactTerm, PullsAHandOntoTheSurfaceAndLetsItSlide) {
  Scene scene = SmallScene(6, 0.1);
  scene.holds.clear();
  const std::array<PosedBody, 2> posed = {PoseBody(scene.body[0], scene.posture.pose[0]),
                                          PoseBody(scene.body[1], scene.posture.pose[1])};
  scene.hand_contacts = FindHandContacts(scene.body, posed, 0.3);
  ASSERT_GE(scene.hand_contacts.size(), 2u);
  scene.hand_contacts.resize(2);  // a's hands
  for (int t = 0; t < 6; ++t) scene.source[1].frames[t].root_position += Vec3(0, 0, 0.1);
  Settings settings;
  double largest[2] = {0, 0};
  for (const int on : {0, 1}) {
    settings.weights.hand_contact = 30 * on;
    settings.weights.joint_limit = 0;  // b is carried off further than arms may reach
    const Problem problem(scene, settings);
    const SolveResult solved =
        SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
    const std::array<Clip, 2> clips = EditedClips(scene, solved.unknowns);
    for (int t = 0; t < 6; ++t) {
      for (const HandContact& c : scene.hand_contacts) {
        largest[on] = std::max(
            largest[on],
            SurfaceGap(scene.body[0], PoseBody(scene.body[0], clips[0].frames[t]).node, c.hand,
                       scene.body[1], PoseBody(scene.body[1], clips[1].frames[t]).node, c.to));
      }
    }
  }
  EXPECT_GT(largest[0], 0.02);
  EXPECT_LT(largest[1], 0.01);
}

TEST(HandContactTerm, IsSilentWhereAHandTouches) {
  Scene scene = SmallScene(1, 0);
  const std::array<PosedBody, 2> posed = {PoseBody(scene.body[0], scene.posture.pose[0]),
                                          PoseBody(scene.body[1], scene.posture.pose[1])};
  HandContact contact = FindHandContacts(scene.body, posed, 1)[0];
  // Wide enough to touch: no gap, no slide.
  const double gap = SurfaceGap(scene.body[0], posed[0].node, contact.hand, scene.body[1],
                                posed[1].node, contact.to);
  scene.hand_contacts = {contact};
  const Unknowns u = UnknownsFromPoses(scene, scene.source);
  EXPECT_EQ(Residuals(HandContactTerm(0.04), scene, u, 0).size(), gap > 0.04 ? 2u : gap > 0);
  scene.body[0].nodes[contact.hand].radius += std::max(gap, 0.0) + 1e-6;
  EXPECT_TRUE(Residuals(HandContactTerm(0.04), scene, u, 0).empty());
}

}  // namespace
}  // namespace retarget::solver
