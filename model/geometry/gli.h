// The Gauss Linking Integral (GLI) of two straight segments, in closed form.
//
//   GLI(g1, g2) = 1/(4 pi) int int (dg1 x dg2 . (g1 - g2)) / |g1 - g2|^3      Ho and Komura 2007,
//   Eq. 1
//
// The separation g1 - g2 of two segments sweeps a planar parallelogram, so the integral is minus
// the signed solid angle of that parallelogram over 4 pi, and |GLI| < 1/2 for one pair. A segment
// a->b along +x and c->d along +y that passes above (larger z) gives a negative value.
#pragma once

#include <array>

#include "model/geometry/types.h"

namespace retarget {

// GLI (turns) of a->b with c->d. 0 for coplanar, touching and zero-length segments; finite always.
double SegmentGli(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

struct SegmentGliGradient {
  double value = 0;              // turns
  std::array<Vec3, 4> gradient;  // d value / d a, b, c, d (turns per metre)
};
SegmentGliGradient SegmentGliWithGradient(const Vec3& a, const Vec3& b, const Vec3& c,
                                          const Vec3& d);

// The edge vector e of a segment p->q seen from a point at the origin. It is the only building
// block of the gradient: with h_i = (e(p_{i-1}, p_i) + e(p_i, p_{i+1})) / (4 pi |p_i|) over the
// four corners p1 = a-c, p2 = b-c, p3 = b-d, p4 = a-d of the parallelogram,
//   d/da = h1 + h4,  d/db = h2 + h3,  d/dc = -(h1 + h2),  d/dd = -(h3 + h4).
// Zero where p and q are parallel.
Vec3 GliEdge(const Vec3& p, const Vec3& q);

}  // namespace retarget
