// How near two segments come to each other while their ends move.
#pragma once

#include <array>

#include "solver/proof/motion_bound.h"

namespace retarget::solver {

// Floating point must not certify what is not so. Places are known to better than 1e-12 m per
// metre; every distance that is certified holds with this much to spare.
inline constexpr double kLengthMargin = 1e-9;  // m

using MovingSegment = std::array<const MovingPoint*, 2>;

// Distance of two segments at one instant and the unit direction across, from the second to the
// first.
struct Gap {
  double distance = 0;
  Vec3 across = Vec3::UnitY();
};

// A distance (m) that the segments keep over the whole stretch; may be negative, which says
// nothing. `gap0` and `gap1` are those at its ends, `carried` as in RelativeSpeed. The better of
//  - the two cones: with m the largest relative speed of their ends, and points between the ends
//    moving no faster, d >= (d0 + d1 - m) / 2;
//  - a turning plane: for n(s) = (1 - s) n0 + s n1, of length at most one, and the straight paths
//    v(s) = x(s) - y(s) between ends of one and of the other, d >= min over the four pairs and s of
//    n(s).v(s), a quadratic, less how far both stray from their straight paths.
// The second is exact to second order in the length of the stretch. Margin included.
double GapBound(const MovingSegment& p, const MovingSegment& q, const Gap& gap0, const Gap& gap1,
                double carried);

// The same of a point and a segment, by the cones; `d0` and `d1` are the distances at the ends.
double PointGapBound(double d0, double d1, double speed);

// Distance of a point to the segment a->b (m).
double PointSegmentDistance(const Vec3& point, const Vec3& a, const Vec3& b);

// Smallest and largest distance of two moving points (m), margin included: the straight paths give
// both but for how far the points stray.
double LeastDistance(const MovingPoint& p, const MovingPoint& q);
double LargestDistance(const MovingPoint& p, const MovingPoint& q);

}  // namespace retarget::solver
