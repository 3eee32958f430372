#include "tools/bench/iteration_split.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "model/body/pass_through.h"
#include "solver/optimizer/banded.h"
#include "solver/optimizer/normal_equations.h"
#include "solver/optimizer/stage.h"
#include "solver/problem/clock.h"

namespace retarget {
namespace {

constexpr int kRepeats = 8;

// Of this thread: whole passes take longer than a time slice, so the wall clock of a busy machine
// would count others' work even in the best of them.
double CpuSecondsNow() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Fills the frames' blocks and counts the seconds.
class TimedAssembly {
 public:
  TimedAssembly(const solver::Problem& problem, const solver::Unknowns& x)
      : problem_(problem), x_(x) {}

  void Fill(int t, solver::FrameBlock* block) {
    const double started = CpuSecondsNow();
    frame_.Set(problem_.scene(), x_, t, true);
    problem_.EvaluateFrame(frame_, 1, true, &rows_);
    const double evaluated = CpuSecondsNow();
    solver::FillBlock(problem_, rows_, x_.edit, t, block);
    terms_s += evaluated - started;
    normal_equations_s += CpuSecondsNow() - evaluated;
    num_rows += rows_.num_rows();
  }

  double terms_s = 0, normal_equations_s = 0;
  long num_rows = 0;

 private:
  const solver::Problem& problem_;
  const solver::Unknowns& x_;
  solver::Frame frame_;
  solver::Rows rows_;
};

solver::BandedSystem SystemOf(const solver::Problem& problem) {
  return solver::BandedSystem(problem.scene().num_frames(), solver::AnchorSpans(problem.scene()),
                              problem.smoothness().weight().array().square());
}

// Least seconds of several runs of `work` by a clock, in ms per frame.
template <typename Work>
double LeastMs(int num_frames, double (*now)(), const Work& work) {
  double least = 1e300;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const double started = now();
    work();
    least = std::min(least, now() - started);
  }
  return 1e3 * least / num_frames;
}

void MeasureLinearSolve(const solver::Problem& problem, const solver::Unknowns& x,
                        IterationSplit* split) {
  const int n = problem.scene().num_frames();
  VecX damping = VecX::Constant(n, problem.settings().solve.initial_damping);
  solver::BandedSystem system = SystemOf(problem);
  solver::BandedStep step;
  const auto solve = [&](int threads) {
    std::array<TimedAssembly, 2> assembly = {TimedAssembly(problem, x), TimedAssembly(problem, x)};
    const double started = CpuSecondsNow();
    const bool solved = system.Solve(
        [&](int t, int thread, solver::FrameBlock* block) {
          assembly[static_cast<size_t>(threads > 1 ? thread : 0)].Fill(t, block);
        },
        damping, threads, &step);
    return std::tuple(solved, assembly[0], CpuSecondsNow() - started);
  };
  // As the solver does; how long a solve takes does not depend on it.
  while (!std::get<0>(solve(1))) {
    damping *= 5;
    if (damping[0] > 1e5)
      throw std::runtime_error("the normal equations are not positive definite");
  }
  const double to_ms = 1e3 / n;
  split->terms_ms = split->normal_equations_ms = split->factorisation_ms = 1e300;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const auto [solved, assembly, seconds] = solve(1);
    if (!solved) throw std::logic_error("the same system was solved before");
    const double rest = seconds - assembly.terms_s - assembly.normal_equations_s;
    split->terms_ms = std::min(split->terms_ms, to_ms * assembly.terms_s);
    split->normal_equations_ms =
        std::min(split->normal_equations_ms, to_ms * assembly.normal_equations_s);
    split->factorisation_ms = std::min(split->factorisation_ms, to_ms * rest);
    split->rows = static_cast<double>(assembly.num_rows) / n;
  }
  split->linear_two_threads_ms = LeastMs(n, solver::SecondsNow, [&] { solve(2); });
}

// The guard looks at every frame twice: as it was and as it would be.
void MeasureGuard(const solver::Scene& scene, const solver::Unknowns& x, IterationSplit* split) {
  std::vector<NodePositions> nodes;
  solver::Frame frame;
  for (int t = 0; t < scene.num_frames(); ++t) {
    frame.Set(scene, x, t, false);
    nodes.push_back({frame.posed[0].node, frame.posed[1].node});
  }
  double largest = 0;
  split->guard_ms = LeastMs(scene.num_frames(), CpuSecondsNow, [&] {
    for (size_t t = 0; t < nodes.size(); ++t) {
      largest += LargestGliJump(scene.body, nodes[t], nodes[t ? t - 1 : 0], kGuardReach).size;
    }
  });
  if (largest < 0) throw std::logic_error("a GLI jump is negative");  // keeps the loop alive
}

}  // namespace

IterationSplit MeasureIterationSplit(const solver::Problem& problem, const solver::Unknowns& x) {
  const int n = problem.scene().num_frames();
  IterationSplit split;
  MeasureLinearSolve(problem, x, &split);
  MeasureGuard(problem.scene(), x, &split);
  double cost = 0;
  split.cost_ms = LeastMs(n, CpuSecondsNow, [&] { cost += problem.Cost(x, 1, 1); });
  if (cost < 0) throw std::logic_error("a cost is negative");  // keeps the loop alive
  solver::Iteration iteration;
  split.report_ms =
      LeastMs(n, CpuSecondsNow, [&] { solver::MeasureIteration(problem, x, 1, &iteration); });
  return split;
}

}  // namespace retarget
