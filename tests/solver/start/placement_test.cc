// Placement: heading and horizontal place of one frame, height of the planted feet.
#include "solver/start/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/geometry/so3.h"
#include "solver/problem/terms/ground.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

double Heading(const Pose& pose) {
  const Vec3 ahead = pose.rotation[0] * Vec3::UnitZ();
  return std::atan2(ahead.x(), ahead.z());
}

class PlacementTest : public testing::Test {
 protected:
  PlacementTest() : body_(StandardBody(AverageMeasures(1.7))) {
    Pose pose = RestPose(body_);
    pose.root_position = Vec3(2, 1.3, -4);
    pose.rotation[0] = Turn(0, 70, 0);
    clip_ = Fidget(body_, pose, 20, 30, 5, 0.2);
    target_ = RestPose(body_);
    target_.root_position = Vec3(-0.4, 0.9, 0.3);
    target_.rotation[0] = Turn(0, -130, 0);
    contacts_ = {{body_.FindNode("left_ankle"), 2, 9}, {body_.FindNode("right_toe"), 5, 17}};
  }

  double LowestPlantedCapsule(const Clip& clip) const {
    // The widest capsule at the ankle is the shank's or the foot's, at the toe the foot's.
    const double foot = body_.nodes[body_.FindNode("right_toe")].radius;
    const double ankle = std::max(foot, body_.nodes[body_.FindNode("left_ankle")].radius);
    double lowest = 1e9;
    for (int t = 2; t <= 9; ++t) {
      lowest = std::min(
          lowest, PoseBody(body_, clip.frames[t]).node[body_.FindNode("left_ankle")].y() - ankle);
    }
    for (int t = 5; t <= 17; ++t) {
      lowest = std::min(
          lowest, PoseBody(body_, clip.frames[t]).node[body_.FindNode("right_toe")].y() - foot);
    }
    return lowest;
  }

  Body body_;
  Clip clip_;
  Pose target_;
  std::vector<Contact> contacts_;
};

TEST_F(PlacementTest, TurnsAndShiftsAllFramesAlike) {
  const Placement placement{kPi / 2, Vec3(1, 2, 3)};
  Pose pose = RestPose(body_);
  pose.root_position = Vec3(5, 1, 7);  // a quarter turn takes +Z to +X, +X to -Z
  EXPECT_LT((Placed(pose, placement).root_position - Vec3(7 + 1, 1 + 2, -5 + 3)).norm(), 1e-14);
  const Clip placed = Placed(clip_, placement);
  ASSERT_EQ(placed.num_frames(), clip_.num_frames());
  EXPECT_EQ(placed.fps, clip_.fps);
  for (int t = 0; t < placed.num_frames(); ++t) {
    const PosedBody before = PoseBody(body_, clip_.frames[t]),
                    after = PoseBody(body_, placed.frames[t]);
    for (int n = 0; n < body_.num_nodes(); ++n) {
      const Vec3& p = before.node[n];
      EXPECT_LT((after.node[n] - Vec3(p.z() + 1, p.y() + 2, -p.x() + 3)).norm(), 1e-13);
    }
    for (int l = 1; l < body_.num_links(); ++l) {
      EXPECT_EQ(placed.frames[t].rotation[l].coeffs(), clip_.frames[t].rotation[l].coeffs());
    }
  }
}

TEST_F(PlacementTest, BringsTheFrameToTheTargetsHeadingAndPlaceOnTheFloor) {
  for (Pose& pose : clip_.frames) pose.rotation[0] = Turn(0, 70, 0);  // upright: heading is exact
  for (const int frame : {0, 7, 19}) {
    const Placement placement = PlaceAt(body_, clip_, frame, target_, contacts_);
    const Clip placed = Placed(clip_, placement);
    EXPECT_NEAR(std::remainder(Heading(placed.frames[frame]) - Heading(target_), 2 * kPi), 0,
                1e-12);
    EXPECT_NEAR(std::remainder(placement.yaw - (-200 * kDegree), 2 * kPi), 0, 1e-12);
    const Vec3 miss = placed.frames[frame].root_position - target_.root_position;
    EXPECT_NEAR(miss.x(), 0, 1e-12);
    EXPECT_NEAR(miss.z(), 0, 1e-12);
    EXPECT_NEAR(LowestPlantedCapsule(placed), 0, 1e-12);
  }
}

TEST_F(PlacementTest, TheHeightIsOneForTheWholeClip) {
  const Placement placement = PlaceAt(body_, clip_, 3, target_, contacts_);
  const Clip placed = Placed(clip_, placement);
  for (int t = 0; t < clip_.num_frames(); ++t) {
    EXPECT_NEAR(placed.frames[t].root_position.y() - clip_.frames[t].root_position.y(),
                placement.shift.y(), 1e-14);
  }
  EXPECT_NEAR(placement.shift.y(), -LowestPlantedCapsule(clip_), 1e-12);
}

TEST_F(PlacementTest, WithoutContactsTheHeightStays) {
  EXPECT_EQ(PlaceAt(body_, clip_, 3, target_, {}).shift.y(), 0);
}

TEST_F(PlacementTest, WhatIsPlacedStays) {
  // Leaning roots too: yaw is then the turn that agrees best.
  for (Pose& pose : clip_.frames) pose.rotation[0] = pose.rotation[0] * Turn(25, 0, 10);
  for (const int frame : {0, 11}) {
    const Clip placed = Placed(clip_, PlaceAt(body_, clip_, frame, target_, contacts_));
    const Placement again = PlaceAt(body_, placed, frame, target_, contacts_);
    EXPECT_NEAR(std::remainder(again.yaw, 2 * kPi), 0, 1e-12);
    EXPECT_LT(again.shift.norm(), 1e-12);
  }
}

TEST_F(PlacementTest, WhereTheClipWasBeforeDoesNotMatter) {
  const Clip one = Placed(clip_, PlaceAt(body_, clip_, 4, target_, contacts_));
  const Clip elsewhere = Placed(clip_, {2.2, Vec3(-7, 0.4, 3)});
  const Clip other = Placed(elsewhere, PlaceAt(body_, elsewhere, 4, target_, contacts_));
  for (int t = 0; t < clip_.num_frames(); ++t) {
    const PosedBody p = PoseBody(body_, one.frames[t]), q = PoseBody(body_, other.frames[t]);
    for (int n = 0; n < body_.num_nodes(); ++n) EXPECT_LT((p.node[n] - q.node[n]).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace retarget::solver
