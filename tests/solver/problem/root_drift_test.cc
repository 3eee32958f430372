// Where two drifting clips are to meet: drifts that are known by hand.
#include "solver/problem/root_drift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/geometry/so3.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kFrames = 121;  // 4 s
constexpr double kFps = 30, kPlay = 0.1, kPlayTurn = 0.25;

// The figures of the small scene, each going straight ahead at its own speed (m/s).
Scene Walking(double speed_a, double speed_b) {
  Scene scene = SmallScene(1, 0);
  const double speed[2] = {speed_a, speed_b};
  for (int f = 0; f < 2; ++f) {
    scene.source[f].fps = kFps;
    scene.source[f].frames.assign(kFrames, scene.posture.pose[f]);
    for (int t = 0; t < kFrames; ++t) {
      scene.source[f].frames[t].root_position.z() += speed[f] * t / kFps;
    }
  }
  return scene;
}

double LargestOf(const std::vector<RootShift>& shifts) {
  double largest = 0;
  for (const RootShift& s : shifts) {
    largest = std::max({largest, s.shift.norm(), std::abs(s.yaw)});
  }
  return largest;
}

TEST(Meeting, WalkersOfDifferentSpeedMeetByTheShareOfTheirTravel) {
  const auto shifts = RootDriftCorrection(Walking(1.0, 1.5));
  for (int t = 0; t < kFrames; ++t) {
    const double drift = 0.5 * t / kFps;
    const double shared = std::max(0.0, drift - kPlay);
    EXPECT_NEAR(shifts[0][t].shift.z(), 0.4 * shared, 1e-9) << t;
    EXPECT_NEAR(shifts[1][t].shift.z(), -0.6 * shared, 1e-9) << t;
    EXPECT_NEAR(shifts[0][t].shift.x(), 0, 1e-9);
    EXPECT_EQ(shifts[0][t].shift.y(), 0);
    EXPECT_NEAR(shifts[0][t].yaw, 0, 1e-9);
  }
}

TEST(Meeting, TheFrameThatIsLaidIntoTheTemplateStaysThere) {
  Scene scene = Walking(1.0, 1.5);
  scene.template_frame = 60;
  for (int f = 0; f < 2; ++f) {
    const double ahead = scene.source[f].frames[60].root_position.z();
    for (Pose& pose : scene.source[f].frames) {
      pose.root_position.z() += scene.posture.pose[f].root_position.z() - ahead;
    }
  }
  const auto shifts = RootDriftCorrection(scene);
  EXPECT_LT(shifts[0][60].shift.norm() + shifts[1][60].shift.norm(), 1e-9);
  EXPECT_NEAR(shifts[0][120].shift.z(), 0.4 * (1 - kPlay), 1e-9);
  EXPECT_NEAR(shifts[0][0].shift.z(), -0.4 * (1 - kPlay), 1e-9);
}

TEST(Meeting, WhoStandsStaysWhereHeIs) {
  const auto shifts = RootDriftCorrection(Walking(0, 1.2));
  EXPECT_LT(LargestOf(shifts[0]), 1e-9);
  EXPECT_NEAR(shifts[1].back().shift.z(), -(4 * 1.2 - kPlay), 1e-9);
}

TEST(Meeting, TurnsAreSharedToo) {
  Scene scene = Walking(1.0, 1.0);
  for (int t = 0; t < kFrames; ++t) {
    Quat& root = scene.source[1].frames[t].rotation[0];
    root = YawRotation(1.5 * t / (kFrames - 1)) * root;
  }
  const auto shifts = RootDriftCorrection(scene);
  EXPECT_NEAR(shifts[0].back().yaw, 0.5 * (1.5 - kPlayTurn), 1e-6);
  EXPECT_NEAR(shifts[1].back().yaw, -0.5 * (1.5 - kPlayTurn), 1e-6);
  const Pose& root = scene.source[1].frames.back();
  EXPECT_NEAR(YawOf(ShiftedRoot(root, shifts[1].back()).rotation[0] *
                    scene.posture.pose[1].rotation[0].conjugate()),
              1.5 + shifts[1].back().yaw, 1e-9);
}

TEST(Meeting, SwayAndPaceAreNotDrift) {
  Scene scene = Walking(1.2, 1.2);
  for (int t = 0; t < kFrames; ++t) {
    Vec3& p = scene.source[0].frames[t].root_position;
    p.x() += 0.04 * std::sin(2 * kPi * t / kFps);
    p.z() += 0.04 * std::sin(4 * kPi * t / kFps);
  }
  for (const auto& shifts : RootDriftCorrection(scene)) EXPECT_EQ(LargestOf(shifts), 0);
}

TEST(Meeting, NothingIsSharedWithoutATieOrByAFollower) {
  Scene scene = Walking(1.0, 1.5);
  scene.root[0] = RootReference::kPartner;
  for (const auto& shifts : RootDriftCorrection(scene)) EXPECT_EQ(LargestOf(shifts), 0);
  scene.root[0] = RootReference::kOwnClip;
  scene.tangles.clear();
  for (const auto& shifts : RootDriftCorrection(scene)) EXPECT_EQ(LargestOf(shifts), 0);
}

}  // namespace
}  // namespace retarget::solver
