// From the rows of a frame to its normal equations: what every second-order step is made of.
#pragma once

#include <vector>

#include "solver/optimizer/banded.h"
#include "solver/problem/problem.h"

namespace retarget::solver {

// J^T J (lower triangle) [n x n] and J^T r [n] of one frame's rows, anchors left out.
void NormalEquations(const Rows& rows, MatX* hessian, VecX* gradient);

// The block of frame t in the clip's system: its rows with their anchors, and the gradient of the
// smoothness terms (whose second derivatives the system knows).
void FillBlock(const Problem& problem, const Rows& rows, const MatX& edit, int t,
               FrameBlock* block);

// The frames of every anchor of a scene, in the order of Unknowns::anchor.
std::vector<AnchorSpan> AnchorSpans(const Scene& scene);

}  // namespace retarget::solver
