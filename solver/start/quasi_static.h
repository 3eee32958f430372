// A frame-by-frame pass over the clip: each frame is solved by itself from where the frame before
// it ended, with the terms of the spacetime problem and the same guard against pass-throughs. It
// starts in the template posture, so what is tangled there stays tangled, and no limb changes sides
// between frames. The result is the initial guess of the spacetime solve, which then makes the
// whole clip even.
#pragma once

#include "solver/problem/problem.h"

namespace retarget::solver {

// `start` holds the edit of the template's frame (scene.template_frame); the other frames are
// overwritten outwards from it. Planted feet are locked where their contact began in the pass. No
// node moves further than half of solve.step_limit_m in an iteration, and solve.gli_jump bounds the
// jump of a segment pair from iteration to iteration and from frame to frame.
Unknowns QuasiStaticPass(const Problem& problem, const Unknowns& start);

// Where a limb goes through a limb, or dips into one, from one frame to the next, the frames
// beyond, seen from the template's, are solved again one by one from the side that has kept it
// where it was, until one leads into the motion as it is. Returns how many frames were solved; the
// motion is to be made even after that.
int CurePassThroughs(const Problem& problem, Unknowns* x);

}  // namespace retarget::solver
