#include "solver/proof/gli_bound.h"

#include <algorithm>
#include <limits>

#include "solver/proof/gap_bound.h"

namespace retarget::solver {
namespace {

// One end against the segments of the other path, times 4 pi.
double EndChange(const MovingPoint& end, const std::vector<const MovingPoint*>& line,
                 double carried) {
  double sum = 0;
  double speed_before = RelativeSpeed(end, *line[0], carried);
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const MovingPoint &a = *line[i], &b = *line[i + 1];
    const double speed_after = RelativeSpeed(end, b, carried);
    const double speed = std::max(speed_before, speed_after);
    speed_before = speed_after;
    const double d0 = PointSegmentDistance(end.at0, a.at0, b.at0);
    const double d1 = PointSegmentDistance(end.at1, a.at1, b.at1);
    const double d = PointGapBound(d0, d1, speed);
    if (d <= 0) return std::numeric_limits<double>::infinity();
    sum += speed * std::min(2 / d, LargestDistance(a, b) / (d * d));
  }
  return sum;
}

}  // namespace

double GliChangeBound(const std::vector<const MovingPoint*>& p,
                      const std::vector<const MovingPoint*>& q, double carried) {
  const double sum = EndChange(*p.front(), q, carried) + EndChange(*p.back(), q, carried) +
                     EndChange(*q.front(), p, carried) + EndChange(*q.back(), p, carried);
  return sum / (4 * kPi);
}

double GliBound(double g0, double g1, double change) {
  return 0.5 * (g0 + g1 - change) - kGliMargin;
}

}  // namespace retarget::solver
