// The guard against tunnelling: a step in which a limb moves too far, or goes through a limb, is
// seen here, frame by frame. A pass-through makes the GLI of two segments jump by one with a
// continuous gradient, so no descent method notices it by itself.
#pragma once

#include <array>
#include <vector>

#include "model/body/body.h"
#include "model/geometry/types.h"

namespace retarget {

// Node positions of both figures in one frame (m).
using NodePositions = std::array<std::vector<Vec3>, 2>;

// Pairs of segments further apart than this cannot meet within one step of the solve (m).
inline constexpr double kGuardReach = 0.25;

struct GliJump {
  double size = 0;             // turns
  int node_a = 0, node_b = 0;  // the segments, by outer node
};

// Largest change of GLI from one posture to another, over segment pairs and over a segment with two
// consecutive segments of the other body (turns). Pairs further apart than `reach` (m) in the first
// posture are left out; pass infinity for none.
GliJump LargestGliJump(const std::array<Body, 2>& body, const NodePositions& before,
                       const NodePositions& after, double reach);

// How far the fastest node moved (m).
double LargestDisplacement(const NodePositions& before, const NodePositions& after);

}  // namespace retarget
