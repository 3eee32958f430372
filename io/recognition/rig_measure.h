// Lengths and directions of a figure over some poses of its motion. Inner part of
// io/recognition/recognise.h.
#pragma once

#include <vector>

#include "model/rig/points.h"
#include "model/rig/rig.h"

namespace retarget::io {

// A mapped rig with the poses that it is measured in.
struct RigMeasure {
  RigMeasure(const RigMotion& motion, const JointMap& joint_map);

  const Rig* rig;  // of the motion
  JointMap map;
  std::vector<PosedRig> poses;
  RigPoints points;
};

Vec3 MidAnkle(const PosedRig& pose, const RigPoints& points);

// The pose that stands most upright: neck and ankles farthest apart.
const PosedRig& StandingPose(const RigMeasure& figure);

// Ground to vertex of the straightened figure, in file units.
double FigureHeight(const RigMeasure& figure);

// Where both feet point, by toe joints or the ends of the ankles; zero where neither is there.
Vec3 FeetDirection(const PosedRig& pose, const RigPoints& points);

}  // namespace retarget::io
