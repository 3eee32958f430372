// A motion with left and right exchanged, on the same rig.
#pragma once

#include <vector>

#include "model/rig/rig.h"

namespace retarget {

// Which joint plays each joint's part on the other side, itself where there is none: by the map,
// and for joints that it does not name (fingers, helpers) by names that differ in left and right
// alone.
std::vector<int> Counterparts(const Rig& rig, const JointMap& map);

// The motion as a mirror at x = 0 shows it: every joint turns in the world as its counterpart does
// in the mirror, beyond its own rest pose. Exact on a rig that is its own mirror image; on any
// other bones keep their own lengths.
RigMotion Mirrored(const RigMotion& motion, const std::vector<int>& counterparts);

}  // namespace retarget
