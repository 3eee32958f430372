// The contract of a back end: one stage of the spacetime solve.
#pragma once

#include "solver/optimizer/spacetime.h"

namespace retarget::solver {

struct StageContext {
  const Problem* problem;
  double contact_factor;  // of the weights of staged terms
  bool refuse_dips;       // from frame to frame, where contacts are never weak
  double tolerance;       // relative decrease, twice in a row ends the stage
  int iterations_left;
  double seconds_left;  // 0: no limit
  int stage;
  double started;  // SecondsNow() at the start of the solve
  const Progress* progress;
};

// Solve from result->unknowns, leave the best there, and add what was done to the other members.
SolveStatus SolveStageBanded(const StageContext& context, SolveResult* result);
SolveStatus SolveStageCeres(const StageContext& context, SolveResult* result);

// Fills the figures of an iteration that are measured from the motion.
void MeasureIteration(const Problem& problem, const Unknowns& unknowns, int threads,
                      Iteration* iteration);

}  // namespace retarget::solver
