// Which starts are tried, and what is said of it.
#include "solver/attempts.h"

#include <gtest/gtest.h>

#include "solver/problem/root_targets.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kFrames = 8;

// Two who stand apart with hanging arms; the simulation holds them in the template.
RetargetResult Apart() {
  RetargetResult result;
  result.scene = SmallScene(kFrames, 0.05);
  Scene& scene = result.scene;
  scene.holds.clear();
  result.simulation.frames_simulated = kFrames;
  for (int f = 0; f < 2; ++f) {
    scene.contacts[f].clear();
    result.simulation.motion[f] = scene.source[f];
    result.simulation.motion[f].frames.assign(kFrames, scene.posture.pose[f]);
    for (Pose& pose : scene.source[f].frames) {
      const Pose rest = RestPose(scene.body[f]);
      pose.rotation = rest.rotation;
      pose.root_position.z() += f == 0 ? -0.3 : 0.3;
    }
  }
  scene.base = EditBase(scene);
  return result;
}

bool Says(const std::vector<std::string>& warnings, const std::string& text) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

TEST(Attempts, WhatMeetsEverythingIsSolvedOnce) {
  RetargetResult result = Apart();
  result.scene.source = result.simulation.motion;
  Settings settings;
  settings.requirements.penetration_m = settings.requirements.floor_m = 1;
  settings.requirements.penetration_1cm_percent = 100;
  settings.requirements.pass_throughs = 1000;
  settings.requirements.gli = 0;
  const Problem problem(result.scene, settings);
  SolveInAttempts(problem, nullptr, &result);
  EXPECT_EQ(result.start.used, Start::kSimulated);
  EXPECT_EQ(result.start.reason, "as asked for");
  EXPECT_TRUE(result.start.simulated_cost.has_value());
  EXPECT_FALSE(result.start.template_cost.has_value());
  EXPECT_TRUE(result.warnings.empty());
}

TEST(Attempts, AResultThatIsWorseThanTheBaselineIsSolvedFromTheOtherStartsAndSaid) {
  RetargetResult result = Apart();
  Settings settings;
  settings.solve.start = Start::kTemplate;
  // Nothing keeps the tags, and the captures stand apart.
  settings.weights.tangle = 0;
  settings.weights.root_tracking = settings.weights.pose_tracking = 100;
  const Problem problem(result.scene, settings);
  SolveInAttempts(problem, nullptr, &result);
  EXPECT_TRUE(result.start.template_cost.has_value());
  EXPECT_TRUE(Says(result.warnings, "the solve was worse than the simulated baseline in tag"));
  EXPECT_TRUE(Says(result.warnings, "solved again from the simulated motion, which is kept"));
  EXPECT_EQ(result.start.used, Start::kSimulated);
  EXPECT_EQ(result.start.reason, "the first solve was worse than the baseline");
}

TEST(Attempts, WithATimeLimitThereIsOne) {
  RetargetResult result = Apart();
  Settings settings;
  settings.weights.tangle = 0;
  settings.weights.root_tracking = settings.weights.pose_tracking = 100;
  settings.solve.max_seconds = 100;
  const Problem problem(result.scene, settings);
  SolveInAttempts(problem, nullptr, &result);
  EXPECT_FALSE(result.start.template_cost.has_value());
  EXPECT_TRUE(result.warnings.empty());
}

TEST(Attempts, AnInterruptedSolveEndsThem) {
  RetargetResult result = Apart();
  const Problem problem(result.scene, {});
  int calls = 0;
  SolveInAttempts(
      problem, [&](const Iteration&) { return ++calls < 2; }, &result);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(result.solve.status, SolveStatus::kInterrupted);
  EXPECT_EQ(result.solve.unknowns.edit.cols(), kFrames);
}

}  // namespace
}  // namespace retarget::solver
