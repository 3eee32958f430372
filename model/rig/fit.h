// Brings joints of a rig to given places by the least change of its frame: what a written motion
// needs whose rig does not bend just where the body does, or changes its lengths.
//
// Damped least norm, iterated (Levenberg 1944, Marquardt 1963): with residuals r of the targets and
// their Jacobian J by turns and shifts of standard deviations W^1/2, every step is
//   W J^T (J W J^T + lambda)^-1 r.
// A frame is fitted alone; the result is a smooth function of the frame, so that smooth motions
// stay smooth. Turns are those of bones in the world: what hangs below a bone keeps its orientation
// unless it has to turn itself. Below an uneven scale the Jacobian is that of the sheared rig.
#pragma once

#include <vector>

#include "model/rig/rig.h"

namespace retarget {

struct RigTarget {
  int joint = -1;
  Vec3 position = Vec3::Zero();  // world, file units and axes
};

// What a fit may change. [joints]
struct RigFreedom {
  std::vector<char> turns;   // its rotation, about the axes that the joint has
  std::vector<char> shifts;  // its translation
};

// Joints this near to their places (m) stay as they are: bending a straight chain by some degrees
// to shorten it by less is not worth it.
inline constexpr double kFitSlack = 0.0005;

// `frame` with the targets as near to their places as the rig can bring them, or within kFitSlack.
RigFrame FitFrame(const Rig& rig, const RigFreedom& freedom, const std::vector<RigTarget>& targets,
                  double metres_per_unit, const RigFrame& frame);

}  // namespace retarget
