// How fast and how crooked the points of a keyed motion can move between two keys.
//
// Between two keys every node turns in its parent at a constant rate w (rad per interval; slerp)
// and its translation is linear. For a point at the end of a chain of bones b_1, b_2, ..., where
// bone i is turned by all nodes above it, W_i the sum of their rates and N_i the product of the
// norms of their stretches (1 in a scene of this program):
//   |p'|  <= sum_i N_i (W_i |b_i| + |b_i'|)              speed, m per interval
//   |p''| <= sum_i N_i (W_i^2 |b_i| + 2 W_i |b_i'|)      bend, m per interval squared
// The product of k rotations with constant rates has a second derivative of at most W^2, whatever
// their axes, and a root's own translation is linear and so adds nothing to the bend.
#pragma once

#include <vector>

#include "model/rig/keyed_motion.h"

namespace retarget::solver {

// Bounds over one key interval. [nodes of the motion]
struct MotionBounds {
  std::vector<double> speed;    // of the node's origin, without its topmost node's translation
  std::vector<double> bend;     // of the node's origin
  std::vector<double> turn;     // of the node's frame: sum of its rates and those above (rad)
  std::vector<double> stretch;  // norm of the node's frame
  std::vector<Vec3> carried;    // step of the topmost node above it (m)
};

// Of the nodes `order` (ascending, with all that they hang from) from key `key` to the next.
void BoundMotion(const KeyedMotion& motion, const std::vector<int>& order, int key,
                 MotionBounds* out);

// A point's places at the ends of a stretch of time, and its bounds over that stretch.
struct MovingPoint {
  Vec3 at0 = Vec3::Zero(), at1 = Vec3::Zero();
  double speed = 0, bend = 0;  // m, m per stretch squared
  // How far it strays from the straight line between its places.
  double stray() const { return bend / 8; }
};

// Largest speed of one point as seen from another (m per stretch): the smaller of what the bounds
// say, `carried` the difference of the steps that carry them, and of what the places say, since no
// velocity differs from its mean by more than half the bend.
double RelativeSpeed(const MovingPoint& p, const MovingPoint& q, double carried);

// Angle of the shorter arc between two unit quaternions (rad).
double ArcBetween(const Quat& p, const Quat& q);

}  // namespace retarget::solver
