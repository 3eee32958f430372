// How much the GLI of two paths can change over a stretch of time (the tag's lemma).
//
// While no segment of one path meets one of the other, the direction from one path to the other
// maps the product of both onto the unit sphere, and GLI is the area of that map over 4 pi. A closed
// form's area changes through the boundary of the product alone: through the four path ENDS seen
// against the other path; inner points cancel. An end e that moves with velocity v relative to the
// points of a segment of length l at distance d or more sweeps at most
//   |v| int h / r^3 ds <= |v| min(2 / d, l / d^2)        (h the distance to the segment's line)
// of that sphere per unit of time, so
//   |d GLI / ds| <= 1 / (4 pi) sum over ends and segments of m min(2 / d, l / d^2),
// m the largest relative speed of the end and the segment's two ends.
#pragma once

#include <vector>

#include "solver/proof/motion_bound.h"

namespace retarget::solver {

// GLI of two paths is evaluated to about 1e-12 turns unless they touch; this is spare (turns).
inline constexpr double kGliMargin = 1e-9;

// L: the largest change of GLI (turns) over the stretch; infinite where an end may touch the other
// path. Holds only where no segment of p meets one of q. `carried` as in RelativeSpeed.
double GliChangeBound(const std::vector<const MovingPoint*>& p,
                      const std::vector<const MovingPoint*>& q, double carried);

// s GLI >= (g0 + g1) / 2 - L / 2 over the stretch, g0 and g1 its values at the ends. Margin included.
double GliBound(double g0, double g1, double change);

}  // namespace retarget::solver
