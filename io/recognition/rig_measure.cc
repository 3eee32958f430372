#include "io/recognition/rig_measure.h"

#include <algorithm>

#include "io/recognition/recognise.h"
#include "model/body/body.h"

namespace retarget::io {
namespace {

double LegLength(const RigMeasure& f, const RigPoints::Side& side) {
  return MedianDistance(f.poses, side.hip, side.knee) +
         MedianDistance(f.poses, side.knee, side.ankle);
}

// How far the hips are below the root, along the trunk of the standing figure. May be negative.
double HipDrop(const RigMeasure& f) {
  const PosedRig& pose = StandingPose(f);
  const RigPoints& p = f.points;
  const Vec3 hips = (At(pose, p.left.hip) + At(pose, p.right.hip)) / 2;
  const Vec3 trunk = At(pose, p.neck) - At(pose, p.root);
  return trunk.norm() > 0 ? (At(pose, p.root) - hips).dot(trunk.normalized()) : 0;
}

}  // namespace

RigMeasure::RigMeasure(const RigMotion& motion, const JointMap& joint_map)
    : rig(&motion.rig),
      map(joint_map),
      poses(SamplePoses(motion)),
      points(FindPoints(motion.rig, poses, map, FindChestBone(motion.rig, poses, map))) {}

Vec3 MidAnkle(const PosedRig& pose, const RigPoints& points) {
  return (At(pose, points.left.ankle) + At(pose, points.right.ankle)) / 2;
}

const PosedRig& StandingPose(const RigMeasure& figure) {
  const auto height = [&](const PosedRig& pose) {
    return (At(pose, figure.points.neck) - MidAnkle(pose, figure.points)).squaredNorm();
  };
  return *std::max_element(
      figure.poses.begin(), figure.poses.end(),
      [&](const PosedRig& a, const PosedRig& b) { return height(a) < height(b); });
}

double FigureHeight(const RigMeasure& f) {
  const RigPoints& p = f.points;
  const double ankle_to_root = (LegLength(f, p.left) + LegLength(f, p.right)) / 2 + HipDrop(f);
  const double ankle_to_head = ankle_to_root + MedianDistance(f.poses, p.root, p.chest) +
                               MedianDistance(f.poses, p.chest, p.neck) +
                               MedianDistance(f.poses, p.neck, p.head);
  const double head =
      p.head_top.known() ? MedianDistance(f.poses, p.head, p.head_top) : 0;  // joint to vertex
  if (head > 1e-3 * ankle_to_head) return (ankle_to_head + head) / (1 - kAnkleHeight);
  return ankle_to_head / (1 - kAnkleHeight - kHeadLength);
}

Vec3 FeetDirection(const PosedRig& pose, const RigPoints& points) {
  Vec3 sum = Vec3::Zero();
  for (const RigPoints::Side* side : {&points.left, &points.right}) {
    if (side->toe.known()) sum += At(pose, side->toe) - At(pose, side->ankle);
  }
  return sum;
}

int ChestBone(const RigMotion& motion, const JointMap& map) {
  return FindChestBone(motion.rig, SamplePoses(motion), map);
}

}  // namespace retarget::io
