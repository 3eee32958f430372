// The spacetime solve: the whole clip of both figures as one nonlinear least-squares problem.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/problem/problem.h"

namespace retarget::solver {

// One accepted iteration.
struct Iteration {
  int stage = 0;
  int index = 0;
  double cost = 0;
  double step_m = 0;        // furthest node
  double smallest_gli = 0;  // s GLI over all tags and frames (turns)
  double deepest_penetration_m = 0;
  double hold_error_m = 0;
  double seconds = 0;  // since the start of the solve
  // Shares of the cost by term (weighted as in this stage), in the order of Problem::CostByTerm.
  std::vector<double> term_cost;
};

enum class SolveStatus { kConverged, kIterationLimit, kTimeLimit, kInterrupted };

struct SolveResult {
  Unknowns unknowns;
  SolveStatus status = SolveStatus::kConverged;
  // The last stage ended because no step was acceptable (only a pass-through led on, or the model
  // failed), not because nothing was left to gain.
  bool stalled = false;
  double initial_cost = 0, cost = 0;
  double seconds = 0;
  int iterations = 0;  // accepted
  int linear_solves = 0;
  Backend backend = Backend::kBanded;
  std::vector<Iteration> history;
};

// Called after each iteration; false stops the solve, which then returns the best so far.
using Progress = std::function<bool(const Iteration&)>;

// Solves from `start` in the stages and with the back end of the problem's settings. Throws
// InputError where the stages do not end with 1.
SolveResult SolveSpacetime(const Problem& problem, const Unknowns& start, const Progress& progress);
// The same in stages of one's own, which end with 1.
SolveResult SolveSpacetime(const Problem& problem, const Unknowns& start,
                           const std::vector<double>& stages, const Progress& progress);

}  // namespace retarget::solver
