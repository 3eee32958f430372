#include "solver/proof/gli_bound.h"

#include <algorithm>
#include <limits>

#include "solver/proof/gap_bound.h"

namespace retarget::solver {
namespace {

// Adds one end against the segments of the other path, times 4 pi.
void AddEnd(const MovingPoint& end, const std::vector<const MovingPoint*>& line, double carried,
            GliChange* sum) {
  double speed_before = RelativeSpeed(end, *line[0], carried);
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const MovingPoint &p = *line[i], &q = *line[i + 1];
    const double speed_after = RelativeSpeed(end, q, carried);
    const double m = std::max(speed_before, speed_after);
    speed_before = speed_after;
    const double d0 = PointSegmentDistance(end.at0, p.at0, q.at0);
    const double d1 = PointSegmentDistance(end.at1, p.at1, q.at1);
    const double d = PointGapBound(d0, d1, m);
    if (d <= 0) {
      sum->slope = sum->bend = std::numeric_limits<double>::infinity();
      return;
    }
    const double l = LargestDistance(p, q), d2 = d * d;
    const double a = end.bend + std::max(p.bend, q.bend);
    const double w = RelativeSpeed(p, q, 0);
    const double seen = std::min(2 / d, l / d2);
    sum->slope += m * seen;
    sum->bend += a * seen + m * w * std::min(1 / d2, kPi / (d * l)) +
                 2 * m * m * std::min(2 / d2, l / (d2 * d));
  }
}

}  // namespace

GliChange BoundGliChange(const std::vector<const MovingPoint*>& p,
                         const std::vector<const MovingPoint*>& q, double carried) {
  GliChange sum;
  for (const MovingPoint* end : {p.front(), p.back()}) AddEnd(*end, q, carried, &sum);
  for (const MovingPoint* end : {q.front(), q.back()}) AddEnd(*end, p, carried, &sum);
  return {sum.slope / (4 * kPi), sum.bend / (4 * kPi)};
}

double GliBound(double g0, double g1, const GliChange& change) {
  const double cones = 0.5 * (g0 + g1 - change.slope);
  return std::max(cones, std::min(g0, g1) - change.bend / 8) - kGliMargin;
}

}  // namespace retarget::solver
