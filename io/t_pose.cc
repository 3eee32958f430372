#include "io/t_pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/rig_units.h"

namespace retarget {
namespace {

bool Along(const Vec3& v, const Vec3& unit, double degrees) {
  return v.dot(unit) > std::cos(degrees * kDegree) * v.norm();
}

// Arms out sideways and legs down, each within so many degrees.
bool IsTPose(const PosedRig& pose, const JointMap& map, const Vec3& up, double arm, double leg) {
  const auto& p = pose.position;
  Vec3 left = p[map.left.shoulder] - p[map.right.shoulder];
  left -= left.dot(up) * up;
  if (left.norm() == 0) return false;
  left.normalize();
  for (const auto& [side, outwards] :
       {std::pair(&map.left, left), std::pair(&map.right, Vec3(-left))}) {
    if (!Along(p[side->elbow] - p[side->shoulder], outwards, arm) ||
        !Along(p[side->wrist] - p[side->elbow], outwards, arm) ||
        !Along(p[side->hip] - p[side->knee], up, leg) ||
        !Along(p[side->knee] - p[side->ankle], up, leg)) {
      return false;
    }
  }
  return true;
}

// Speed of the faster upper arm from one frame to the next (degrees per second).
double ArmSpeed(const RigMotion& motion, const JointMap& map, int frame) {
  const PosedRig from = PoseRig(motion.rig, motion.frames[frame]);
  const PosedRig to = PoseRig(motion.rig, motion.frames[frame + 1]);
  double turn = 0;
  for (const JointMap::Side* side : {&map.left, &map.right}) {
    const Vec3 before = from.position[side->elbow] - from.position[side->shoulder];
    const Vec3 after = to.position[side->elbow] - to.position[side->shoulder];
    turn = std::max(turn, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return turn / kDegree / motion.frame_time;
}

}  // namespace

std::vector<int> TPoseFrames(const RigMotion& motion, const RigFacts& facts) {
  constexpr double kArm = 20, kLeg = 15, kRoughArm = 45, kRoughLeg = 25;  // degrees
  constexpr double kLeap = 1500;  // degrees per second, faster than an arm is lifted or lowered
  const Vec3 up = UpAxis(facts);
  const auto pose = [&](int frame) { return PoseRig(motion.rig, motion.frames[frame]); };
  const int count = motion.num_frames();
  std::vector<int> frames;
  while (static_cast<int>(frames.size()) < count &&
         IsTPose(pose(static_cast<int>(frames.size())), facts.map, up, kArm, kLeg)) {
    frames.push_back(static_cast<int>(frames.size()));
  }
  if (static_cast<int>(frames.size()) == count && count > 1) frames.clear();
  if (frames.empty() && count > 1 && IsTPose(pose(0), facts.map, up, kRoughArm, kRoughLeg) &&
      ArmSpeed(motion, facts.map, 0) > kLeap) {
    frames.push_back(0);
  }
  return frames;
}

void NoteTPose(const RigMotion& motion, RigFacts* facts) {
  constexpr int kMostHasty = 5;
  constexpr double kHasty = 500;  // degrees per second
  if (facts->t_pose_frames.empty() || motion.num_frames() == 1) return;
  const int after = facts->t_pose_frames.back() + 1;
  int start = after;
  while (start + 1 < motion.num_frames() && start < after + kMostHasty &&
         ArmSpeed(motion, facts->map, start) > kHasty) {
    ++start;
  }
  facts->notes.push_back(fmt::format(
      "the clip begins in a T-pose, the motion at frame {0}: --skip-frames {0} leaves it out",
      start));
}

}  // namespace retarget
