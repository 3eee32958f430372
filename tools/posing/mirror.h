// Left and right, and a and b, exchanged. Exact: doing it twice gives the very same numbers.
#pragma once

#include "tools/posing/state.h"

namespace retarget::posing {

// Through the world's plane x = 0: every GLI changes its sign. Photo and camera stay.
PoseState MirroredScene(const PoseState& state);
// Left and right of one figure in its root's frame; the root stays. Pins of the figure go to the
// other side's nodes, their places are left to the caller.
PoseState MirroredFigure(const PoseState& state, int figure);
// a is b and b is a.
PoseState Swapped(const PoseState& state);
// One side's joints mirrored onto the other.
PoseState WithSideCopied(const PoseState& state, int figure, bool from_left);

}  // namespace retarget::posing
