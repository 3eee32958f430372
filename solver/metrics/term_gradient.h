// What every part of the objective asks of a few frames: the gradient of its weighted cost. Where
// the solve has settled, all pulls on a coordinate add up to zero.
#pragma once

#include <string>
#include <vector>

#include "solver/problem/problem.h"

namespace retarget::solver {

// A hold, a tag or a planted foot pulls by itself; the other terms as a whole.
struct TermGradient {
  std::string term;  // YAML key
  int item = -1;     // part of it (PartKind): hold, tag, or anchor; -1: the whole term
  VecX gradient;     // [frames * coordinates], of 1/2 sum (w r)^2
};

// Pulls on `coordinates` (of a frame) in the frames [first, last). Terms without weight and parts
// that are absent there are left out.
std::vector<TermGradient> TermGradients(const Problem& problem, const Unknowns& unknowns, int first,
                                        int last, const std::vector<int>& coordinates);

// Coordinates that can move a node: the root's translation and all joints from the root to the
// node. Sorted; locked joints are left out.
struct LimbNode {
  int figure = 0, node = 0;
};
std::vector<int> CoordinatesOf(const Scene& scene, const std::vector<LimbNode>& limbs);

}  // namespace retarget::solver
