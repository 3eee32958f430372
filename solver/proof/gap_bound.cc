#include "solver/proof/gap_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace retarget::solver {
namespace {

// Least value over [0, 1] of the quadratic with Bernstein coefficients c0, c1, c2.
double LeastOfQuadratic(double c0, double c1, double c2) {
  const double end = std::min(c0, c2);
  const double curve = c0 - 2 * c1 + c2, fall = c0 - c1;
  if (c1 >= end || curve <= 0 || fall <= 0 || fall >= curve) return end;
  return c0 - fall * fall / curve;
}

double TurningPlane(const MovingSegment& p, const MovingSegment& q, const Gap& gap0,
                    const Gap& gap1) {
  double least = std::numeric_limits<double>::infinity();
  for (const MovingPoint* x : p) {
    for (const MovingPoint* y : q) {
      const Vec3 v0 = x->at0 - y->at0, v1 = x->at1 - y->at1;
      const double c0 = gap0.across.dot(v0), c2 = gap1.across.dot(v1);
      const double c1 = 0.5 * (gap0.across.dot(v1) + gap1.across.dot(v0));
      least = std::min(least, LeastOfQuadratic(c0, c1, c2) - x->stray() - y->stray());
    }
  }
  return least;
}

}  // namespace

double GapBound(const MovingSegment& p, const MovingSegment& q, const Gap& gap0, const Gap& gap1,
                double carried) {
  const double plane = TurningPlane(p, q, gap0, gap1);
  double speed = 0;
  for (const MovingPoint* x : p) {
    for (const MovingPoint* y : q) speed = std::max(speed, RelativeSpeed(*x, *y, carried));
  }
  return std::max(plane, 0.5 * (gap0.distance + gap1.distance - speed)) - kLengthMargin;
}

double PointGapBound(double d0, double d1, double speed) {
  return 0.5 * (d0 + d1 - speed) - kLengthMargin;
}

double PointSegmentDistance(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a, ap = point - a;
  const double along = ap.dot(ab), length2 = ab.squaredNorm();
  if (along <= 0) return ap.norm();
  if (along >= length2) return (point - b).norm();
  return (ap - along / length2 * ab).norm();
}

double LeastDistance(const MovingPoint& p, const MovingPoint& q) {
  const double straight = PointSegmentDistance(Vec3::Zero(), p.at0 - q.at0, p.at1 - q.at1);
  return straight - p.stray() - q.stray() - kLengthMargin;
}

double LargestDistance(const MovingPoint& p, const MovingPoint& q) {
  const double straight = std::max((p.at0 - q.at0).norm(), (p.at1 - q.at1).norm());
  return straight + p.stray() + q.stray() + kLengthMargin;
}

}  // namespace retarget::solver
