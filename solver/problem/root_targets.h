// Where a figure belongs that follows its partner instead of its own clip: the capture's motion,
// relative to where the template puts the figure on the partner,
//   X_partner,T^-1 X_T X_clip(t0)^-1 X_clip(t),  X in SE(3), t0 the template's frame
#pragma once

#include <array>
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

// Where the roots' edits are counted from (Scene::base), so that they stay small however far a
// figure is turned: for figures with clips of their own, where RootDriftCorrection puts them; for a
// follower, turned as its partner's clip turns.
std::array<std::vector<RootShift>, 2> EditBase(const Scene& scene);

}  // namespace retarget::solver
