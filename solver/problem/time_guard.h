// Whether a limb goes through a limb from one frame of a motion to the next. Steps of the solve
// keep every frame on its side of what it winds about; where the open end of a limb slips past in
// one frame and not in the next, no step did anything wrong, and yet the motion goes through.
#pragma once

#include <vector>

#include "model/body/pass_through.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

// Between frames t and t + 1 of the edited motion (LargestGliJumpBetween).
bool GoesThroughAfter(const Scene& scene, const Unknowns& unknowns, int t);

// The same of every frame but the last, from the node places of all: cheap where nothing is near.
std::vector<char> GoesThrough(const Scene& scene, const Unknowns& unknowns,
                              const std::vector<NodePositions>& nodes, int threads);

}  // namespace retarget::solver
