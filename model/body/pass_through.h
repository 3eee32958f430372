// The guard against tunnelling: a step in which a limb moves too far, or goes through a limb, is
// seen here, frame by frame. A pass-through makes the GLI of two segments jump by one with a
// continuous gradient, so no descent method notices it by itself.
#pragma once

#include <array>
#include <vector>

#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/geometry/types.h"

namespace retarget {

// Node positions of both figures in one frame (m).
using NodePositions = std::array<std::vector<Vec3>, 2>;

// A larger change of GLI between two neighbouring instants is a pass-through (turns): it changes by
// one where a limb goes through a limb, and by far less where limbs move past each other.
inline constexpr double kPassThroughGli = 0.5;

// A deeper dip between two frames (Way): the limbs are on different sides of each other in these
// frames, and came there past an open end (m).
inline constexpr double kLargestDip = 0.015;

// How far apart two segments may be and still meet on the way from one posture to the next (m).
// Within one step of the solve: two nodes that each move by solve.step_limit_m meet from 0.2 m.
inline constexpr double kGuardReach = 0.25;
// In the quasi-static start, whose steps are half as long, and whose frames follow each other in
// steps of that order.
inline constexpr double kStartGuardReach = 0.2;
// Between instants of a finished motion, of which nothing bounds the steps.
inline constexpr double kMotionReach = 0.6;

struct GliJump {
  double size = 0;             // turns
  int node_a = 0, node_b = 0;  // the segments, by outer node
};

// Largest change of GLI from one posture to another, over segment pairs and over a segment with two
// consecutive segments of the other body (turns). Pairs further apart than `reach` (m) in the first
// posture are left out; pass infinity for none.
GliJump LargestGliJump(const std::array<Body, 2>& body, const NodePositions& before,
                       const NodePositions& after, double reach);

// Whether segments of the two bodies may touch on the way from one frame of a motion to the next:
// they are no further apart than they move against each other, and no less quick than a dip of
// kLargestDip takes. Cheap, where nothing is near or nothing is quick.
bool MayMeetOnTheWay(const std::array<Body, 2>& body, const NodePositions& before,
                     const NodePositions& after);

// What happens on the way from one frame of a motion to the next (Interpolate), at four instants.
struct Way {
  GliJump jump;      // largest change of GLI from one instant to the next
  double dip_m = 0;  // by how much two capsules get deeper than they are in either frame, or than
                     // touching
  bool IsClear() const;
};
Way WayBetween(const std::array<Body, 2>& body, const std::array<Pose, 2>& from,
               const std::array<Pose, 2>& to);

// How far the fastest node moved (m).
double LargestDisplacement(const NodePositions& before, const NodePositions& after);

}  // namespace retarget
