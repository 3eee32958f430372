#include "io/recognition/t_pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace retarget::io {
namespace {

bool Along(const Vec3& v, const Vec3& unit, double degrees) {
  return v.dot(unit) > std::cos(degrees * kDegree) * v.norm();
}

// Arms out sideways and legs down, each within so many degrees.
bool IsTPose(const PosedRig& pose, const RigPoints& points, const Vec3& up, double arm,
             double leg) {
  Vec3 left = At(pose, points.left.shoulder) - At(pose, points.right.shoulder);
  left -= left.dot(up) * up;
  if (left.norm() == 0) return false;
  left.normalize();
  for (const auto& [side, outwards] :
       {std::pair(&points.left, left), std::pair(&points.right, Vec3(-left))}) {
    const Vec3 elbow = At(pose, side->elbow), knee = At(pose, side->knee);
    if (!Along(elbow - At(pose, side->shoulder), outwards, arm) ||
        !Along(At(pose, side->wrist) - elbow, outwards, arm) ||
        !Along(At(pose, side->hip) - knee, up, leg) ||
        !Along(knee - At(pose, side->ankle), up, leg)) {
      return false;
    }
  }
  return true;
}

// How fast each upper arm turns from one frame to the next (degrees per second, about an axis in
// the file's frame).
std::array<Vec3, 2> ArmSpeeds(const RigMotion& motion, const RigPoints& points, int frame) {
  const PosedRig from = PoseRig(motion.rig, motion.frames[frame]);
  const PosedRig to = PoseRig(motion.rig, motion.frames[frame + 1]);
  std::array<Vec3, 2> speeds;
  for (int s = 0; s < 2; ++s) {
    const RigPoints::Side& side = s == 0 ? points.left : points.right;
    const Vec3 before = At(from, side.elbow) - At(from, side.shoulder);
    const Vec3 after = At(to, side.elbow) - At(to, side.shoulder);
    const Vec3 axis = before.cross(after);
    const double turn = std::atan2(axis.norm(), before.dot(after)) / kDegree / motion.frame_time;
    speeds[s] = axis.norm() > 0 ? Vec3(turn * axis.normalized()) : Vec3::Zero();
  }
  return speeds;
}

double ArmSpeed(const RigMotion& motion, const RigPoints& points, int frame) {
  const auto speeds = ArmSpeeds(motion, points, frame);
  return std::max(speeds[0].norm(), speeds[1].norm());
}

}  // namespace

std::vector<int> TPoseFrames(const RigMotion& motion, const RigPoints& points, const Vec3& up) {
  constexpr double kArm = 20, kLeg = 15, kRoughArm = 45, kRoughLeg = 25;  // degrees
  constexpr double kLeap = 1500;  // degrees per second, faster than an arm is lifted or lowered
  const auto pose = [&](int frame) { return PoseRig(motion.rig, motion.frames[frame]); };
  const int count = motion.num_frames();
  std::vector<int> frames;
  while (static_cast<int>(frames.size()) < count &&
         IsTPose(pose(static_cast<int>(frames.size())), points, up, kArm, kLeg)) {
    frames.push_back(static_cast<int>(frames.size()));
  }
  if (static_cast<int>(frames.size()) == count && count > 1) frames.clear();
  if (frames.empty() && count > 1 && IsTPose(pose(0), points, up, kRoughArm, kRoughLeg) &&
      ArmSpeed(motion, points, 0) > kLeap) {
    frames.push_back(0);
  }
  return frames;
}

void NoteTPose(const RigMotion& motion, const RigPoints& points, const OptionWords& words,
               RigFacts* facts) {
  constexpr int kMostHasty = 5, kMostSwing = 4;
  constexpr double kHasty = 500, kSwing = 0.05;  // degrees per second; share of the leap's speed
  if (facts->t_pose_frames.empty() || motion.num_frames() == 1) return;
  const int after = facts->t_pose_frames.back() + 1;
  const int last = motion.num_frames() - 1;
  int start = after;
  while (start < last && start < after + kMostHasty && ArmSpeed(motion, points, start) > kHasty) {
    ++start;
  }
  if (start > after) {
    const auto leap = ArmSpeeds(motion, points, after - 1);
    const int settled = std::min(last, start + kMostSwing);
    for (int frame = start; frame < settled; ++frame) {
      const auto speeds = ArmSpeeds(motion, points, frame);
      for (int s = 0; s < 2; ++s) {
        if (speeds[s].dot(leap[s]) < -kSwing * leap[s].squaredNorm()) start = frame + 1;
      }
    }
  }
  facts->notes.push_back(
      fmt::format("the clip begins in a T-pose, the motion at frame {0}: {1} {0} leaves it out",
                  start, words.skip_frames));
}

}  // namespace retarget::io
