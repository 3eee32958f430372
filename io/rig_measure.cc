#include "io/rig_measure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "io/recognise.h"
#include "model/body.h"

namespace retarget {
namespace {

constexpr int kSamples = 48;  // frames that lengths and axes are measured in

double LegLength(const std::vector<PosedRig>& poses, const JointMap::Side& side) {
  return MedianDistance(poses, side.hip, side.knee) + MedianDistance(poses, side.knee, side.ankle);
}

// The pose that stands most upright: neck and ankles farthest apart.
const PosedRig& StandingPose(const std::vector<PosedRig>& poses, const JointMap& map) {
  return *std::max_element(poses.begin(), poses.end(), [&](const PosedRig& a, const PosedRig& b) {
    const auto height = [&](const PosedRig& pose) {
      return (pose.position[NeckNode(map)] - MidAnkle(pose, map)).squaredNorm();
    };
    return height(a) < height(b);
  });
}

// How far the hips are below the root, along the trunk of the standing figure. May be negative.
double HipDrop(const std::vector<PosedRig>& poses, const JointMap& map) {
  const auto& p = StandingPose(poses, map).position;
  const Vec3 hips = (p[map.left.hip] + p[map.right.hip]) / 2;
  return (p[map.root] - hips).dot((p[NeckNode(map)] - p[map.root]).normalized());
}

double AnkleToRoot(const std::vector<PosedRig>& poses, const JointMap& map) {
  return (LegLength(poses, map.left) + LegLength(poses, map.right)) / 2 + HipDrop(poses, map);
}

// Head joint to vertex in file units; 0 where the file does not say.
double HeadLength(const RigMotion& motion, const std::vector<PosedRig>& poses,
                  const JointMap& map) {
  if (map.head_top >= 0) return MedianDistance(poses, map.head, map.head_top);
  const auto& end_site = motion.rig.joints[map.head].end_site;
  return end_site ? end_site->norm() : 0;
}

}  // namespace

std::vector<PosedRig> SamplePoses(const RigMotion& motion) {
  const int count = std::min(kSamples, motion.num_frames());
  std::vector<PosedRig> poses;
  for (int s = 0; s < count; ++s) {
    const int frame =
        count == 1 ? 0 : static_cast<int>(int64_t{s} * (motion.num_frames() - 1) / (count - 1));
    poses.push_back(PoseRig(motion.rig, motion.frames[frame]));
  }
  return poses;
}

int NeckNode(const JointMap& map) { return map.neck.empty() ? map.head : map.neck.front(); }

Vec3 MidAnkle(const PosedRig& pose, const JointMap& map) {
  return (pose.position[map.left.ankle] + pose.position[map.right.ankle]) / 2;
}

double MedianDistance(const std::vector<PosedRig>& poses, int a, int b) {
  std::vector<double> lengths;
  for (const PosedRig& pose : poses)
    lengths.push_back((pose.position[a] - pose.position[b]).norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

int ChestBone(const std::vector<PosedRig>& poses, const JointMap& map) {
  constexpr double kApart = 0.04;  // of the height from ankle to head joint
  if (map.spine.empty()) return -1;
  const int neck = NeckNode(map);
  const double height = AnkleToRoot(poses, map) + MedianDistance(poses, map.root, neck) +
                        MedianDistance(poses, neck, map.head);
  for (size_t n = map.spine.size(); n-- > 0;) {
    const int bone = map.spine[n];
    if (MedianDistance(poses, bone, neck) >= kApart * height &&
        MedianDistance(poses, bone, map.root) >= kApart * height) {
      return bone;
    }
  }
  return map.spine.back();
}

double RigStature(const RigMotion& motion, const std::vector<PosedRig>& poses,
                  const JointMap& map) {
  const int neck = NeckNode(map);
  const int chest = ChestBone(poses, map);
  const double root_to_neck =
      chest < 0 ? MedianDistance(poses, map.root, neck)
                : MedianDistance(poses, map.root, chest) + MedianDistance(poses, chest, neck);
  const double ankle_to_head =
      AnkleToRoot(poses, map) + root_to_neck + MedianDistance(poses, neck, map.head);
  const double head = HeadLength(motion, poses, map);
  if (head > 1e-3 * ankle_to_head) return (ankle_to_head + head) / (1 - kAnkleHeight);
  return ankle_to_head / (1 - kAnkleHeight - kHeadLength);
}

int ChestBone(const RigMotion& motion, const JointMap& map) {
  return ChestBone(SamplePoses(motion), map);
}

}  // namespace retarget
