// What one iteration of the banded solve spends its time on.
#pragma once

#include "solver/problem/problem.h"

namespace retarget {

// Cpu time of one thread unless said, ms per frame; each the least of several repetitions.
struct IterationSplit {
  // Of the linear solve.
  double terms_ms = 0;               // poses, rows and their derivatives
  double normal_equations_ms = 0;    // J^T J and J^T r of a frame
  double factorisation_ms = 0;       // elimination and back substitution
  double linear_two_threads_ms = 0;  // all three, wall clock of two threads
  // Of the trial of a step.
  double cost_ms = 0;   // poses and rows without derivatives
  double guard_ms = 0;  // GLI of the near segment pairs, before and after
  // Of the line that is told after it.
  double report_ms = 0;
  double rows = 0;  // J's, per frame
};

// Takes the iteration apart at `x`, with the public parts that the solver itself is made of.
IterationSplit MeasureIterationSplit(const solver::Problem& problem, const solver::Unknowns& x);

// What eliminating a frame of `n` coordinates costs at least, in flops. The coupling of a frame
// with the next but one is diagonal, so its part of L is triangular:
//   L_tt n^3/3; L of t+1 n^3, of t+2 n^3/3; update of (t+1, t+1) n^3, (t+2, t+1) n^3, (t+2, t+2)
//   n^3/3.
inline double LeastFlops(int n) { return 4.0 * n * n * n; }

// The same with both couplings taken as dense: partial Cholesky of n of 3n unknowns.
inline double DenseFlops(int n) { return 19.0 / 3 * n * n * n; }

}  // namespace retarget
