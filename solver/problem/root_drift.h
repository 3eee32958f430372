// Where the roots of two figures should go whose clips part by drifting: one walks faster than the
// other, or along another curve. Each clip was captured alone, so its place in the world is
// nobody's intention; how it moves from moment to moment is.
#pragma once

#include <array>
#include <vector>

#include "solver/problem/scene.h"

namespace retarget::solver {

// Shifts of each figure's placed root, per frame, under which the two keep the template's distance
// and headings but for what comes and goes within about a second, and for 10 cm and 0.25 rad, which
// the limbs can bear. The rest is shared between the figures as they travel, so that one who stands
// stays where he is. No shift at the frame that is laid into the template, where a figure follows
// its partner, or where no tag ties the two.
std::array<std::vector<RootShift>, 2> RootDriftCorrection(const Scene& scene);

// How far a figure has turned from its place in the template, about the vertical and per frame
// (rad), followed beyond pi; between -pi and pi at the frame that is laid into the template.
std::vector<double> HeadingsOf(const Scene& scene, int figure);

}  // namespace retarget::solver
