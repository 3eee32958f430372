// Where a figure belongs that follows its partner instead of its own clip: the capture's motion,
// relative to where the template puts the figure on the partner,
//   X_partner,T^-1 X_T X_clip(t0)^-1 X_clip(t),  X in SE(3), t0 the template's frame
#pragma once

#include <vector>

#include "solver/problem/scene.h"

namespace retarget::solver {

// Target of a follower's root in its partner's root frame.
struct RelativeRoot {
  Vec3 position;  // m
  Quat rotation;
};

// Of all frames; empty for a figure that follows its own clip.
std::vector<RelativeRoot> RelativeRootTargets(const Scene& scene, int figure);

}  // namespace retarget::solver
