// Lengths of a rig over some poses of its motion. Inner part of io/recognise.h.
#pragma once

#include <vector>

#include "model/rig.h"

namespace retarget {

// Poses evenly over the motion, first and last frame included: what lengths and axes are measured
// in. At least one frame.
std::vector<PosedRig> SamplePoses(const RigMotion& motion);

// The joint at the body's neck node: the first neck bone, else the head.
int NeckNode(const JointMap& map);

Vec3 MidAnkle(const PosedRig& pose, const JointMap& map);

// Distance of two joints (file units): the median over the poses, since position channels may
// stretch bones.
double MedianDistance(const std::vector<PosedRig>& poses, int a, int b);

// The same as ChestBone(motion, map) of io/recognise.h.
int ChestBone(const std::vector<PosedRig>& poses, const JointMap& map);

// Ground to vertex of the straightened figure, in file units.
double RigStature(const RigMotion& motion, const std::vector<PosedRig>& poses, const JointMap& map);

}  // namespace retarget
