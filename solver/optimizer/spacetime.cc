#include "solver/optimizer/spacetime.h"

#include "model/body/path.h"
#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"
#include "solver/optimizer/stage.h"
#include "solver/problem/clock.h"
#include "solver/problem/parallel.h"
#include "solver/problem/terms/penetration.h"

namespace retarget::solver {

void MeasureIteration(const Problem& problem, const Unknowns& unknowns, int threads,
                      Iteration* iteration) {
  const Scene& scene = problem.scene();
  const size_t n = static_cast<size_t>(scene.num_frames());
  std::vector<double> gli(n, 1e9), depth(n, 0), hold(n, 0);
  std::vector<Frame> frames(static_cast<size_t>(threads));
  std::vector<std::array<std::vector<int>, 2>> paths;
  for (const TangleTarget& held : scene.tangles) {
    paths.push_back(
        {NodesOn(scene.body[0], held.tag.tangle.a), NodesOn(scene.body[1], held.tag.tangle.b)});
  }
  std::vector<Rows> rows(static_cast<size_t>(threads));
  const Penetration penetration;
  ParallelFor(scene.num_frames(), threads, [&](int t, int thread) {
    Frame& frame = frames[thread];
    frame.Set(scene, unknowns, t, false);
    for (size_t k = 0; k < paths.size(); ++k) {
      const double value = PolylineGli(PointsOn(frame.posed[0].node, paths[k][0]),
                                       PointsOn(frame.posed[1].node, paths[k][1]));
      gli[t] = std::min(gli[t], scene.tangles[k].sign * value);
    }
    rows[thread].Reset(frame, false);
    penetration.Evaluate(frame, &rows[thread]);
    for (const double r : rows[thread].residual()) depth[t] = std::max(depth[t], r);
    for (const Hold& h : scene.holds) {
      hold[t] = std::max(hold[t], (HoldPosition(h.from, scene.body, frame.posed) -
                                   HoldPosition(h.to, scene.body, frame.posed))
                                      .norm());
    }
  });
  iteration->smallest_gli = *std::min_element(gli.begin(), gli.end());
  iteration->deepest_penetration_m = *std::max_element(depth.begin(), depth.end());
  iteration->hold_error_m = *std::max_element(hold.begin(), hold.end());
}

namespace {

// Solves the stages one after the other, each warm started, from result->unknowns.
void SolveStages(const Problem& problem, const std::vector<double>& stages, double started,
                 const Progress& progress, SolveResult* result) {
  const SolveSettings& settings = problem.settings().solve;
  for (size_t s = 0; s < stages.size(); ++s) {
    const bool last = s + 1 == stages.size();
    const StageContext context{&problem,
                               stages[s],
                               stages.size() == 1,
                               last ? settings.polish_decrease : settings.relative_decrease,
                               settings.max_iterations - result->iterations,
                               settings.max_seconds,
                               static_cast<int>(s),
                               started,
                               &progress};
    result->status = settings.backend == Backend::kBanded ? SolveStageBanded(context, result)
                                                          : SolveStageCeres(context, result);
    if (result->status != SolveStatus::kConverged) return;
  }
}

}  // namespace

SolveResult SolveSpacetime(const Problem& problem, const Unknowns& start,
                           const Progress& progress) {
  const std::vector<double>& stages = problem.settings().solve.stages;
  CheckStages(stages);
  return SolveSpacetime(problem, start, stages, progress);
}

SolveResult SolveSpacetime(const Problem& problem, const Unknowns& start,
                           const std::vector<double>& stages, const Progress& progress) {
  const int threads = NumThreads(problem.settings().solve.threads);
  const double started = SecondsNow();
  SolveResult result;
  result.unknowns = start;
  result.backend = problem.settings().solve.backend;
  result.initial_cost = problem.Cost(start, 1, threads);
  SolveStages(problem, stages, started, progress, &result);
  result.cost = problem.Cost(result.unknowns, 1, threads);
  // Weak contacts may lead away from a start that was better already: then full contacts from
  // there.
  if (result.cost > result.initial_cost && result.status == SolveStatus::kConverged) {
    result.unknowns = start;
    SolveStages(problem, {1}, started, progress, &result);
    result.cost = problem.Cost(result.unknowns, 1, threads);
  }
  result.seconds = SecondsNow() - started;
  return result;
}

}  // namespace retarget::solver
