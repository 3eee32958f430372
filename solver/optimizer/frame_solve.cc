#include "solver/optimizer/frame_solve.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "solver/optimizer/kernels.h"
#include "solver/optimizer/normal_equations.h"
#include "solver/problem/time_guard.h"

namespace retarget::solver {
namespace {

// Damping, times diag(J^T J). It starts almost undamped, as a frame starts near its neighbour's
// solution; below the least it changes no step any more.
constexpr double kInitialDamping = 1e-3;
constexpr double kLeastDamping = 1e-4;
constexpr double kEase = 0.2;     // after a step
constexpr double kStiffen = 10;   // where no share of the step would do
constexpr int kMostAttempts = 9;  // dampings of one step, up to 1e4 and more: then only a cliff (a
                                  // pass-through) lies ahead
// Shares of one step. A step beyond the limit is cut to just within it, so that the curvature of
// the way does not carry it out again; any other is cut as a backtracking line search does.
constexpr int kMostShares = 3;
constexpr double kWithinLimit = 0.95;
constexpr double kShorten = 0.3;
// Keeps the factorisation sound where no row reads a coordinate.
constexpr double kLeastDiagonal = 1e-12;

class FrameSolver {
 public:
  FrameSolver(const Problem& problem, const FrameTask& task, const FrameSolveOptions& options,
              Unknowns* x)
      : problem_(problem), task_(task), options_(options), x_(x) {}

  FrameSolved Run() {
    at_.node = NodesNow();
    at_.cost = Cost();
    while (at_.iterations < options_.max_iterations) {
      const double before = at_.cost;
      Linearise();
      if (!Advance()) break;
      ++at_.iterations;
      if ((before - at_.cost) / before < options_.relative_decrease) break;
    }
    SetFrame(false);  // free anchors stay where the frame ended
    return std::move(at_);
  }

 private:
  auto edit() { return x_->edit.col(task_.t); }

  // One iteration from the linearisation at hand. False where no damping gives a step.
  bool Advance() {
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      if (TakeShareOf(Step())) {
        damping_ = std::max(damping_ * kEase, kLeastDamping);
        return true;
      }
      damping_ *= kStiffen;
    }
    return false;
  }

  // Takes the first share of the step that the guard lets through and that lowers the cost.
  bool TakeShareOf(const VecX& step) {
    const VecX before = edit();
    double share = 1;
    for (int trial = 0; trial < kMostShares; ++trial) {
      edit() = before + share * step;
      NodePositions now = NodesNow();
      const double length = LargestDisplacement(at_.node, now);
      if (length > options_.step_limit_m) {
        share *= kWithinLimit * options_.step_limit_m / length;
        continue;
      }
      const bool sound = IsSound(now);
      const double cost = sound ? Cost() : 0;
      if (sound && cost < at_.cost) {
        at_.cost = cost;
        at_.node = std::move(now);
        return true;
      }
      share *= kShorten;
    }
    edit() = before;
    return false;
  }

  bool IsSound(const NodePositions& now) const {
    const Scene& scene = problem_.scene();
    const auto sound_from = [&](const NodePositions& from) {
      return LargestGliJump(scene.body, from, now, options_.guard_reach).size <= options_.gli_jump;
    };
    if (!sound_from(at_.node)) return false;
    if (!task_.also_from) return true;
    return sound_from(*task_.also_from) &&
           !(MayMeetOnTheWay(scene.body, *task_.also_from, now) &&
             !WayBetween(scene, x_->edit, task_.also_from_frame, task_.t).IsClear());
  }

  NodePositions NodesNow() {
    frame_.Set(problem_.scene(), *x_, task_.t, false);
    return {frame_.posed[0].node, frame_.posed[1].node};
  }

  // Works out the frame; free anchors go where their feet are.
  void SetFrame(bool derivatives) {
    frame_.Set(problem_.scene(), *x_, task_.t, derivatives);
    for (const FreeAnchor& free : task_.free_anchors) {
      const Vec3& foot = frame_.posed[free.figure].node[free.node];
      x_->anchor.col(free.anchor) << foot.x(), foot.z();
    }
  }

  double Cost() {
    SetFrame(false);
    problem_.EvaluateFrame(frame_, 1, false, &rows_);
    const double w = task_.follow_weight;
    if (w == 0) return rows_.HalfSquares();
    return rows_.HalfSquares() + 0.5 * w * w * (edit() - task_.follow).squaredNorm();
  }

  void Linearise() {
    SetFrame(true);
    problem_.EvaluateFrame(frame_, 1, true, &rows_);
    NormalEquations(rows_, &hessian_, &gradient_);
    const double w2 = task_.follow_weight * task_.follow_weight;
    if (w2 == 0) return;
    hessian_.diagonal().array() += w2;
    gradient_ += w2 * (edit() - task_.follow);
  }

  VecX Step() {
    const int n = static_cast<int>(gradient_.size());
    factor_ = hessian_;
    factor_.diagonal() += damping_ * hessian_.diagonal();
    factor_.diagonal().array() += kLeastDiagonal;
    VecX step = -gradient_;
    PartialCholesky(factor_.data(), n, n, n, 0, step.data());
    factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(step);
    return step;
  }

  const Problem& problem_;
  const FrameTask& task_;
  const FrameSolveOptions& options_;
  Unknowns* x_;
  FrameSolved at_;  // the accepted iterate
  double damping_ = kInitialDamping;
  Frame frame_;
  Rows rows_;
  MatX hessian_, factor_;
  VecX gradient_;
};

}  // namespace

FrameSolved SolveFrame(const Problem& problem, const FrameTask& task,
                       const FrameSolveOptions& options, Unknowns* x) {
  return FrameSolver(problem, task, options, x).Run();
}

}  // namespace retarget::solver
