// Frames of a capture that cannot be true: a marker lost or swapped for a moment, a calibration
// pose before the motion. A joint gets there faster than a person can move it.
#pragma once

#include <string>
#include <vector>

#include "model/rig/rig.h"

namespace retarget {

// A run of frames that stand apart from the motion on both sides (at the clip's ends: from the one
// side there is), or the place where two motions were cut together.
struct JumpRun {
  int first = 0, last = 0;  // frames that stand apart; of a cut the frame after it, last < first
  int joint = 0;            // the rig's joint that moves fastest there
  double speed = 0;         // rad/s
  bool is_cut() const { return last < first; }
};

// Over the joints of the map, in their parents' frames. Sorted by frame.
std::vector<JumpRun> FindJumps(const RigMotion& motion, const JointMap& map);

// Puts in place of the runs (cuts left out) what lies between their neighbours: linear in
// translations, spherical-linear in rotations; at the clip's ends the nearest good frame.
void RepairJumps(const std::vector<JumpRun>& runs, RigMotion* motion);

}  // namespace retarget
