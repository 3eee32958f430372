// What follows from a body's capsules alone.
#pragma once

#include <utility>
#include <vector>

#include "model/body/body.h"

namespace retarget {

// The widest capsule that touches each node (m).
std::vector<double> NodeRadii(const Body& body);

// Pairs of segments (by outer node, i < j) of a body that share no node and are not joined by one
// segment: those whose overlap counts as self-penetration.
std::vector<std::pair<int, int>> SelfPairs(const Body& body);

}  // namespace retarget
