// Distance of two segments, the axes of capsules.
#pragma once

#include "model/geometry/types.h"

namespace retarget {

// Closest points p = a + s (b - a) and q = c + t (d - c), s and t in [0, 1].
struct ClosestPoints {
  double s = 0, t = 0;
  double distance = 0;         // m
  Vec3 normal = Vec3::Zero();  // unit, from q to p; across both segments where they meet
};

// Closest points of the segments a->b and c->d, degenerate ones included (Lumelsky 1985, in the
// clamping form of Ericson, "Real-Time Collision Detection", 2005, section 5.1.9).
ClosestPoints ClosestPointsOfSegments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Depth by which two capsules overlap: sum of the radii less the distance of the axes (m).
inline double CapsuleDepth(const ClosestPoints& closest, double radius_1, double radius_2) {
  return radius_1 + radius_2 - closest.distance;
}

}  // namespace retarget
