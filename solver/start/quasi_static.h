// A frame-by-frame pass over the clip: each frame is solved by itself from where the frame before
// it ended, with the terms of the spacetime problem and the same guard against pass-throughs. It
// starts in the template posture, so what is tangled there stays tangled, and no limb changes sides
// between frames. The result is the initial guess of the spacetime solve, which then makes the
// whole clip even.
#pragma once

#include "solver/problem/problem.h"

namespace retarget::solver {

struct QuasiStaticOptions {
  int most_iterations = 8;     // per frame; ten times as many in the first
  double step_limit_m = 0.05;  // per iteration
  double gli_jump = 0.4;       // turns, between iterates and between frames
  double guard_reach = 0.2;    // m; pairs further apart cannot meet within a step
  double follow_weight = 3;    // 1/rad, 1/m: the edit stays near that of the frame before
};

// `start` holds the edit of the template's frame (scene.template_frame); the other frames are
// overwritten outwards from it. Planted feet are locked where their contact began in the pass.
Unknowns QuasiStaticPass(const Problem& problem, const Unknowns& start,
                         const QuasiStaticOptions& options = {});

}  // namespace retarget::solver
