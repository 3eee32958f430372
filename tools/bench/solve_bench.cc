// Whole solves of the shipped example at growing length: time, memory, cost of a linear solve.
// Usage: solve_bench [frames ...]   (default: 100 300 1000 3000; ceres up to 300)
// Wall-clock figures suffer from whatever else the machine does; cpu seconds and ratios much less.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "solver/optimizer/kernels.h"
#include "solver/problem/parallel.h"
#include "tools/bench/example.h"
#include "tools/bench/in_child.h"
#include "tools/bench/iteration_split.h"
#include "tools/bench/multiply.h"

namespace retarget {
namespace {

constexpr int kMostCeresFrames = 300;  // it is there for the comparison, which longer ones repeat
constexpr double kMegabyte = 1e6;

struct Run {
  int frames = 0;
  bool banded = true;
  double start_s = 0, solve_s = 0, cpu_s = 0;  // cpu: of start and solve, all threads
  int iterations = 0, linear_solves = 0;
  double peak_bytes = 0;
  double cost = 0;
  solver::SolveStatus status = solver::SolveStatus::kConverged;

  double LinearMs() const { return 1e3 * solve_s / frames / linear_solves; }
  double CpuMs() const { return 1e3 * cpu_s / frames / linear_solves; }
  const char* backend() const { return banded ? "banded" : "ceres"; }
};

double CpuSeconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

rusage Usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

Run SolveExample(int frames, bool banded) {
  Settings settings;
  settings.solve.backend = banded ? Backend::kBanded : Backend::kCeres;
  const solver::RetargetInput input = LoadExample(RETARGET_EXAMPLE_DIR, frames);
  const double cpu_before = CpuSeconds(Usage());
  const solver::RetargetResult result = solver::Retarget(input, settings, {});
  Run run;
  run.frames = frames;
  run.banded = banded;
  run.cpu_s = CpuSeconds(Usage()) - cpu_before;
  run.start_s = result.start_seconds;
  run.solve_s = result.solve.seconds;
  run.iterations = result.solve.iterations;
  run.linear_solves = result.solve.linear_solves;
  run.cost = result.solve.cost;
  run.status = result.solve.status;
  run.peak_bytes = 1024.0 * static_cast<double>(Usage().ru_maxrss);
  return run;
}

void PrintHead() {
  fmt::print("{:>6} {:>7} {:>8} {:>8} {:>8} {:>9} {:>5} {:>7} {:>9} {:>9} {:>8} {:>10}\n", "frames",
             "backend", "start s", "solve s", "cpu s", "frames/s", "iter", "linear", "ms/f/lin",
             "cpu ms", "peak MB", "cost");
}

void PrintRun(const Run& r) {
  fmt::print(
      "{:>6} {:>7} {:>8.2f} {:>8.2f} {:>8.2f} {:>9.1f} {:>5} {:>7} {:>9.3f} {:>9.3f} {:>8.1f} "
      "{:>10.4f}{}\n",
      r.frames, r.backend(), r.start_s, r.solve_s, r.cpu_s, r.frames / r.solve_s, r.iterations,
      r.linear_solves, r.LinearMs(), r.CpuMs(), r.peak_bytes / kMegabyte, r.cost,
      r.status == solver::SolveStatus::kConverged ? "" : "  not converged");
}

// Growth from the 300-frame run (or else the shortest) to the longest.
void PrintGrowth(const std::vector<Run>& runs) {
  const Run* from = nullptr;
  const Run* to = nullptr;
  for (const Run& r : runs) {
    if (!r.banded) continue;
    if (!from || r.frames == 300) from = &r;
    to = &r;
  }
  if (!from || from->frames >= to->frames) return;
  const double added = to->frames - from->frames;
  fmt::print(
      "\n{} against {} frames, banded, per frame: solve {:.2f}x, cpu {:.2f}x; per frame and "
      "linear solve: {:.2f}x, cpu {:.2f}x\n",
      to->frames, from->frames, to->solve_s / from->solve_s * from->frames / to->frames,
      to->cpu_s / from->cpu_s * from->frames / to->frames, to->LinearMs() / from->LinearMs(),
      to->CpuMs() / from->CpuMs());
  fmt::print("memory between them: {:.3f} MB/frame\n",
             (to->peak_bytes - from->peak_bytes) / kMegabyte / added);
}

void PrintBackends(const std::vector<Run>& runs) {
  for (const Run& b : runs) {
    for (const Run& c : runs) {
      if (!b.banded || c.banded || b.frames != c.frames) continue;
      fmt::print(
          "{} frames, ceres to banded: solve time {:.2f}x, cpu {:.2f}x, memory {:.2f}x, "
          "cost {:.4f}x\n",
          b.frames, c.solve_s / b.solve_s, c.cpu_s / b.cpu_s, c.peak_bytes / b.peak_bytes,
          c.cost / b.cost);
    }
  }
}

struct SplitRun {
  IterationSplit split;
  double multiply_rate = 0;
  int n = 0;
};

// At the solution, where the hinges that matter are the active ones.
SplitRun SplitExample(int frames) {
  const Settings settings;
  const solver::RetargetResult result =
      solver::Retarget(LoadExample(RETARGET_EXAMPLE_DIR, frames), settings, {});
  const solver::Problem problem(result.scene, settings);
  SplitRun run;
  run.split = MeasureIterationSplit(problem, result.solve.unknowns);
  run.multiply_rate = MeasureMultiplyRate();
  run.n = result.scene.num_coordinates();
  return run;
}

void PrintSplit(const SplitRun& run, int frames) {
  const IterationSplit& s = run.split;
  const double linear = s.terms_ms + s.normal_equations_ms + s.factorisation_ms;
  fmt::print("\none iteration at the solution of {} frames, cpu ms per frame, best of several:\n",
             frames);
  fmt::print("  terms with derivatives  {:.4f}  ({:.0f} rows)\n", s.terms_ms, s.rows);
  fmt::print("  normal equations        {:.4f}\n", s.normal_equations_ms);
  fmt::print("  factorisation           {:.4f}\n", s.factorisation_ms);
  fmt::print("  linear solve in all     {:.4f}, by the clock in two threads {:.4f} ({:.2f}x)\n",
             linear, s.linear_two_threads_ms, linear / s.linear_two_threads_ms);
  fmt::print("  trial: cost             {:.4f}\n", s.cost_ms);
  fmt::print("  trial: guard            {:.4f}\n", s.guard_ms);
  fmt::print("  report of the iteration {:.4f}\n", s.report_ms);
  const auto bound = [&](const char* name, double flops) {
    const double ms = 1e3 * flops / run.multiply_rate;
    fmt::print("  {:<23} {:.1f} Mflop = {:.4f} ms; factorisation takes {:.2f}x\n", name,
               1e-6 * flops, ms, s.factorisation_ms / ms);
  };
  fmt::print("dense multiply ({}): {:.1f} GFLOP/s\n", solver::KernelName(),
             1e-9 * run.multiply_rate);
  bound("flop bound, least", LeastFlops(run.n));
  bound("flop bound, dense front", DenseFlops(run.n));
}

int RunAll(std::vector<int> lengths) {
  if (lengths.empty()) lengths = {100, 300, 1000, 3000};
  fmt::print("kernels {}, {} threads\n", solver::KernelName(), solver::NumThreads(0));
  PrintHead();
  std::vector<Run> runs;
  for (const int frames : lengths) {
    for (const bool banded : {true, false}) {
      if (!banded && frames > kMostCeresFrames) continue;
      runs.push_back(InChild([&] { return SolveExample(frames, banded); }));
      PrintRun(runs.back());
    }
  }
  PrintGrowth(runs);
  PrintBackends(runs);
  const int split_frames = std::min(300, lengths.back());
  PrintSplit(InChild([&] { return SplitExample(split_frames); }), split_frames);
  return 0;
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) {
  std::vector<int> lengths;
  for (int i = 1; i < argc; ++i) {
    lengths.push_back(std::atoi(argv[i]));
    if (lengths.back() < 3) {
      fmt::print(stderr, "usage: solve_bench [frames ...], each at least 3\n");
      return 2;
    }
  }
  try {
    return retarget::RunAll(lengths);
  } catch (const std::exception& error) {
    fmt::print(stderr, "solve_bench: {}\n", error.what());
    return 1;
  }
}
