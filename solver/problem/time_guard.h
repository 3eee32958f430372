// Whether a limb goes through a limb, or dips into one, from one frame of a motion to the next.
// Steps of the solve keep every frame on its side of what it winds about; where the open end of a
// limb slips past in one frame and not in the next, no step did anything wrong, and yet the motion
// goes through.
#pragma once

#include <vector>

#include "model/body/pass_through.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

// From one frame of the edited motion to another.
Way WayBetween(const Scene& scene, const MatX& edit, int from, int to);

// Whether a limb goes through a limb from every frame to the next, by the node places of all: cheap
// where nothing is near. Dips count too where `dips` says so; while contacts are weak they come and
// go.
std::vector<char> FramesThatGoThrough(const Scene& scene, const MatX& edit,
                                      const std::vector<NodePositions>& nodes, bool dips,
                                      int threads);

}  // namespace retarget::solver
