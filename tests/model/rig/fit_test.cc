#include "model/rig/fit.h"

#include <gtest/gtest.h>

#include <random>

#include "model/geometry/so3.h"

namespace retarget {
namespace {

Vec3 SomeVector(std::mt19937* random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  return {number(*random), number(*random), number(*random)};
}

// A trunk of four bones that forks into two limbs of three, in cm.
RigMotion Forked(std::mt19937* random) {
  RigMotion motion;
  const int parents[] = {-1, 0, 1, 2, 3, 4, 5, 3, 7, 8};
  for (const int parent : parents) {
    RigJoint joint;
    joint.name = "joint" + std::to_string(motion.rig.num_joints());
    joint.parent = parent;
    joint.offset = Vec3(0, 12, 0) + SomeVector(random, 6);
    motion.rig.joints.push_back(joint);
  }
  RigFrame frame;
  for (const RigJoint& joint : motion.rig.joints) {
    frame.translation.push_back(joint.offset);
    frame.rotation.push_back(ExpSo3(SomeVector(random, 0.5)));
  }
  motion.frames = {frame};
  return motion;
}

// Positions by products of 4x4 matrices.
std::vector<Vec3> ByMatrices(const Rig& rig, const RigFrame& frame) {
  std::vector<Eigen::Matrix4d> world;
  std::vector<Vec3> out;
  for (int j = 0; j < rig.num_joints(); ++j) {
    Eigen::Matrix4d translation = Eigen::Matrix4d::Identity(), rotation = translation;
    Eigen::Matrix4d scale = translation;
    translation.topRightCorner<3, 1>() = frame.translation[j];
    rotation.topLeftCorner<3, 3>() = frame.rotation[j].toRotationMatrix();
    if (!frame.scale.empty()) scale.topLeftCorner<3, 3>() = frame.scale[j].asDiagonal();
    const int parent = rig.joints[j].parent;
    const Eigen::Matrix4d own = translation * rotation * scale;
    world.push_back(parent < 0 ? own : Eigen::Matrix4d(world[parent] * own));
    out.emplace_back(world.back().topRightCorner<3, 1>());
  }
  return out;
}

TEST(PoseRig, IsTheProductOfMatrices) {
  std::mt19937 random(3);
  for (const bool scaled : {false, true}) {
    RigMotion motion = Forked(&random);
    RigFrame& frame = motion.frames[0];
    for (size_t j = 0; scaled && j < frame.rotation.size(); ++j) {
      frame.scale.emplace_back(Vec3::Ones() + SomeVector(&random, 0.4));
    }
    const PosedRig posed = PoseRig(motion.rig, frame);
    const std::vector<Vec3> expected = ByMatrices(motion.rig, frame);
    for (size_t j = 0; j < expected.size(); ++j) {
      EXPECT_LT((posed.position[j] - expected[j]).norm(), 1e-12) << j;
    }
  }
}

struct Case {
  RigMotion motion;
  std::vector<RigTarget> targets;
  RigFreedom freedom;
};

// Targets that the rig reaches with every bone turned by at most `turn`.
Case Reachable(unsigned seed, double turn, bool scaled) {
  std::mt19937 random(seed);
  Case out;
  out.motion = Forked(&random);
  RigFrame& frame = out.motion.frames[0];
  for (size_t j = 0; scaled && j < frame.rotation.size(); ++j) {
    frame.scale.emplace_back(j == 2 ? Vec3(1.2, 1, 0.9) : Vec3::Ones());
  }
  RigFrame other = frame;
  for (Quat& q : other.rotation) q = q * ExpSo3(SomeVector(&random, turn));
  other.translation[0] += SomeVector(&random, 1);
  const std::vector<Vec3> there = ByMatrices(out.motion.rig, other);
  for (const int j : {0, 2, 3, 4, 6, 7, 9}) out.targets.push_back({j, there[j]});
  out.freedom.turns.assign(10, 1);
  out.freedom.shifts.assign(10, 0);
  out.freedom.shifts[0] = 1;
  return out;
}

double WorstOf(const Case& c, const RigFrame& frame) {
  const std::vector<Vec3> at = ByMatrices(c.motion.rig, frame);
  double worst = 0;
  for (const RigTarget& target : c.targets) {
    worst = std::max(worst, 0.01 * (at[target.joint] - target.position).norm());
  }
  return worst;
}

TEST(FitFrame, ReachesWhatTheRigCanReach) {
  int checked = 0;
  for (const bool scaled : {false, true}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Case c = Reachable(seed, 0.15, scaled);
      const RigFrame& before = c.motion.frames[0];
      if (WorstOf(c, before) < 0.01) continue;
      const RigFrame after = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
      EXPECT_LT(WorstOf(c, after), kFitSlack + 1e-4) << seed << (scaled ? " scaled" : "");
      for (size_t j = 1; j < after.translation.size(); ++j) {
        EXPECT_EQ(after.translation[j], before.translation[j]) << "it may not be shifted";
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST(FitFrame, WhatIsThereStaysAsItIs) {
  const Case c = Reachable(5, 0, false);
  RigFrame frame = c.motion.frames[0];
  frame.translation[0] = c.targets[0].position + Vec3(0, 0.04, 0);  // 0.4 mm
  const RigFrame after = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, frame);
  for (size_t j = 0; j < frame.rotation.size(); ++j) {
    EXPECT_EQ(after.rotation[j].coeffs(), frame.rotation[j].coeffs());
    EXPECT_EQ(after.translation[j], frame.translation[j]);
  }
}

// A bone that need not turn keeps its orientation in the world, whatever turns above it.
TEST(FitFrame, WhatHangsBelowKeepsItsOrientation) {
  const Case c = Reachable(6, 0.15, false);
  const RigFrame& before = c.motion.frames[0];
  const RigFrame after = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
  const PosedRig was = PoseRig(c.motion.rig, before), is = PoseRig(c.motion.rig, after);
  EXPECT_GT(was.rotation[5].angularDistance(is.rotation[5]), 1e-3);
  for (const int leaf : {6, 9}) {
    EXPECT_LT(was.rotation[leaf].angularDistance(is.rotation[leaf]), 1e-9);
  }
}

// Bones that change their length are reached by shifts.
TEST(FitFrame, ShiftsWhereTurnsCannotReach) {
  Case c = Reachable(7, 0.05, false);
  c.targets[4].position += Vec3(0, 4, 0);  // beyond the limb's length
  const RigFrame& before = c.motion.frames[0];
  RigFrame after = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
  const double turned = WorstOf(c, after);
  c.freedom.shifts.assign(10, 1);
  after = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
  EXPECT_LT(WorstOf(c, after), kFitSlack + 1e-4);
  EXPECT_LT(WorstOf(c, after), turned);
}

// A joint with one axis turns about that axis alone.
TEST(FitFrame, KeepsTheAxesOfAJoint) {
  Case c = Reachable(8, 0.1, false);
  RigJoint& hinge = c.motion.rig.joints[5];
  hinge.turns_freely = false;
  hinge.turn_axes = {Vec3::UnitX()};
  RigFrame before = c.motion.frames[0];
  before.rotation[5] = ExpSo3(Vec3(0.4, 0, 0));
  const RigFrame after = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
  EXPECT_LT(WorstOf(c, after), WorstOf(c, before));
  const Vec3 turn = LogSo3(after.rotation[5]);
  EXPECT_GT(std::abs(turn.x() - 0.4), 1e-6);
  EXPECT_LT(std::abs(turn.y()) + std::abs(turn.z()), 1e-9);
}

// Smooth motions stay smooth: a small change of the targets changes the frame by little.
TEST(FitFrame, IsContinuous) {
  int checked = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Case c = Reachable(seed, 0.1, false);
    const RigFrame& before = c.motion.frames[0];
    const RigFrame one = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
    std::mt19937 random(seed);
    for (RigTarget& target : c.targets) target.position += SomeVector(&random, 0.01);
    const RigFrame two = FitFrame(c.motion.rig, c.freedom, c.targets, 0.01, before);
    for (size_t j = 0; j < one.rotation.size(); ++j) {
      EXPECT_LT(one.rotation[j].angularDistance(two.rotation[j]), 0.02) << seed << " " << j;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 100);
}

}  // namespace
}  // namespace retarget
