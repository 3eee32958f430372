// One frame of a problem, solved by itself: Levenberg-Marquardt on its dense normal equations. No
// step moves a node too far or takes a limb through a limb of the other body. The quasi-static
// start is made of it. Posing is a clip of one frame to the spacetime solve instead (pose_solve.h):
// the shipped templates were made by that and are reproduced to the last digit.
#pragma once

#include <vector>

#include "model/body/pass_through.h"
#include "solver/problem/problem.h"

namespace retarget::solver {

struct FrameSolveOptions {
  int max_iterations = 8;
  double step_limit_m = 0.05;
  double gli_jump = 0.4;             // turns; a larger jump of a segment pair rejects the step
  double guard_reach = kGuardReach;  // m (LargestGliJump)
  double relative_decrease = 1e-3;   // of the cost: an iteration that gains less is the last
};

// A contact whose anchor still goes where its node is.
struct FreeAnchor {
  int anchor = 0;  // column of Unknowns::anchor
  int figure = 0, node = 0;
};

struct FrameTask {
  int t = 0;
  // Where not 0, the edit x stays near another one: cost 1/2 |follow_weight (x - follow)|^2.
  double follow_weight = 0;
  VecX follow = {};
  // Places from which no limb may come through a limb either, and the frame that has them; null:
  // none.
  const NodePositions* also_from = nullptr;
  int also_from_frame = -1;
  std::vector<FreeAnchor> free_anchors = {};
};

struct FrameSolved {
  NodePositions node;
  double cost = 0;
  int iterations = 0;  // accepted steps
};

// Solves frame task.t from the edit it has in `x`, and leaves the best there.
FrameSolved SolveFrame(const Problem& problem, const FrameTask& task,
                       const FrameSolveOptions& options, Unknowns* x);

}  // namespace retarget::solver
