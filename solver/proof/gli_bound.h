// How much the GLI of two paths can change over a stretch of time (the tag's lemma).
//
// While no segment of one path meets one of the other, the direction from one path to the other
// maps the product of both onto the unit sphere, and GLI is the area of that map over 4 pi. A
// closed form's area changes through the boundary of the product alone: through the four path ENDS
// seen against the other path; inner points cancel. An end e that moves with velocity v relative to
// the points of a segment of length l at distance d or more sweeps at most
//   |v| int h / r^3 ds <= |v| min(2 / d, l / d^2)        (h the distance to the segment's line)
// of that sphere per unit of time, so with m the largest speed of the end relative to the segment's
// two ends
//   |GLI'| <= L = 1 / (4 pi) sum over ends and segments of m min(2 / d, l / d^2).
// Its derivative again, with a the largest relative acceleration and w the largest speed of the
// segment's ends relative to each other (the integrand's three factors in turn):
//   |GLI''| <= K = 1 / (4 pi) sum of a min(2 / d, l / d^2) + m w min(1 / d^2, pi / (d l))
//                              + 2 m^2 min(2 / d^2, l / d^3).
#pragma once

#include <vector>

#include "solver/proof/motion_bound.h"

namespace retarget::solver {

// GLI of two paths is evaluated to about 1e-12 turns unless they touch; this is spare (turns).
inline constexpr double kGliMargin = 1e-9;

// Over a stretch of time: L (turns) and K (turns); infinite where an end may touch the other path.
struct GliChange {
  double slope = 0, bend = 0;
};

// Holds only where no segment of p meets one of q. `carried` as in RelativeSpeed.
GliChange BoundGliChange(const std::vector<const MovingPoint*>& p,
                         const std::vector<const MovingPoint*>& q, double carried);

// What s GLI stays above over the stretch, g0 and g1 its values at the ends: the larger of
//   (g0 + g1 - L) / 2   and   min(g0, g1) - K / 8.
// Margin included.
double GliBound(double g0, double g1, const GliChange& change);

}  // namespace retarget::solver
