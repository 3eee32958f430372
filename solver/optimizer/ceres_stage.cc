// The terms in Ceres Solver. One file, though a long one, so that a single source includes Ceres
// (its headers are the slowest to compile) and nothing else can come to depend on it. Every joint
// edit is a parameter block of three, every anchor one of two; clips are solved by conjugate
// gradients on the normal equations with a block Jacobi preconditioner, single frames by dense
// Cholesky.
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "model/body/pass_through.h"
#include "solver/optimizer/stage.h"
#include "solver/optimizer/stage_end.h"
#include "solver/problem/clock.h"
#include "solver/problem/parallel.h"
#include "solver/problem/time_guard.h"

namespace retarget::solver {
namespace {

constexpr int kBlock = 3;  // of a joint's edit
constexpr int kAnchor = 2;
constexpr double kFreeRadius = 1e3;  // of the trust region, over diag(J^T J)
constexpr double kStill = 1e-3;      // m: a frame that moved less cannot have gone through a limb

// All frames, worked out once per evaluation point.
class FrameCache : public ceres::EvaluationCallback {
 public:
  FrameCache(const StageContext& context, const Unknowns& unknowns, int threads)
      : context_(context),
        scene_(context.problem->scene()),
        unknowns_(unknowns),
        threads_(threads),
        frames_(static_cast<size_t>(scene_.num_frames())),
        accepted_(frames_.size()) {}

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_point) override {
    if (!new_point && (!evaluate_jacobians || has_dexp_)) return;
    ParallelFor(scene_.num_frames(), threads_,
                [&](int t, int) { frames_[t].Set(scene_, unknowns_, t, evaluate_jacobians); });
    has_dexp_ = evaluate_jacobians;
    if (evaluate_jacobians) {
      Accept();  // derivatives are asked for at accepted points only
    } else {
      sound_ = !guarding_ || IsSound();
    }
  }

  const Frame& frame(int t) const { return frames_[static_cast<size_t>(t)]; }
  // False where the trial step carries a limb too far or through a limb.
  bool sound() const { return sound_; }
  double last_step_m() const { return last_step_m_; }

 private:
  void Accept() {
    double moved = 0;
    for (size_t t = 0; t < frames_.size(); ++t) {
      const NodePositions now = {frames_[t].posed[0].node, frames_[t].posed[1].node};
      if (guarding_) moved = std::max(moved, LargestDisplacement(accepted_[t], now));
      accepted_[t] = now;
    }
    accepted_through_ =
        FramesThatGoThrough(scene_, unknowns_.edit, accepted_, context_.refuse_dips, threads_);
    last_step_m_ = moved;
    guarding_ = true;
    sound_ = true;
  }

  bool IsSound() const {
    const SolveSettings& settings = context_.problem->settings().solve;
    std::vector<char> bad(frames_.size(), 0);
    std::vector<NodePositions> nodes(frames_.size());
    ParallelFor(scene_.num_frames(), threads_, [&](int t, int) {
      nodes[t] = {frames_[t].posed[0].node, frames_[t].posed[1].node};
      const NodePositions& now = nodes[t];
      const double moved = LargestDisplacement(accepted_[t], now);
      bad[t] = moved > settings.step_limit_m ||
               (moved > kStill && LargestGliJump(scene_.body, accepted_[t], now, kGuardReach).size >
                                      settings.gli_jump);
    });
    const std::vector<char> through =
        FramesThatGoThrough(scene_, unknowns_.edit, nodes, context_.refuse_dips, threads_);
    for (size_t t = 0; t < through.size(); ++t) bad[t] |= through[t] && !accepted_through_[t];
    return std::count(bad.begin(), bad.end(), 0) == static_cast<long>(bad.size());
  }

  const StageContext& context_;
  const Scene& scene_;
  const Unknowns& unknowns_;
  int threads_;
  std::vector<Frame> frames_;
  std::vector<NodePositions> accepted_;
  std::vector<char> accepted_through_;  // on the way to the next frame
  bool guarding_ = false, sound_ = true, has_dexp_ = false;
  double last_step_m_ = 0;
};

// The hinge and point rows of one term in one frame. Ceres wants a fixed number of residuals,
// hinges come and go: the rows go into Term::row_slots slots. Should there be more, the last slot
// takes the root of the remaining sum of squares, which keeps cost and gradient exact. Parameters:
// the frame's blocks, then anchors.
class TermCostFunction : public ceres::CostFunction {
 public:
  TermCostFunction(const FrameCache* cache, const Term* term, int t, double weight, int slots,
                   std::vector<int> anchors)
      : cache_(cache), term_(term), t_(t), weight_(weight), anchors_(std::move(anchors)) {
    set_num_residuals(slots);
    blocks_ = cache->frame(t).scene ? cache->frame(t).scene->num_coordinates() / kBlock : 0;
    mutable_parameter_block_sizes()->assign(static_cast<size_t>(blocks_), kBlock);
    mutable_parameter_block_sizes()->resize(static_cast<size_t>(blocks_) + anchors_.size(),
                                            kAnchor);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!jacobians && !cache_->sound()) return false;
    thread_local Rows rows;
    rows.Reset(cache_->frame(t_), jacobians != nullptr);
    term_->Evaluate(cache_->frame(t_), &rows);
    rows.Scale(0, 0, weight_);
    const int slots = num_residuals();
    std::fill(residuals, residuals + slots, 0.0);
    if (jacobians) Clear(jacobians);
    std::vector<int> order(static_cast<size_t>(rows.num_rows()));
    std::iota(order.begin(), order.end(), 0);
    const auto size = [&](int r) { return std::abs(rows.residual()[r]); };
    const int kept = rows.num_rows() <= slots ? rows.num_rows() : slots - 1;
    if (kept < rows.num_rows()) {
      std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return size(i) > size(j); });
    }
    double rest = 0;
    for (size_t k = static_cast<size_t>(kept); k < order.size(); ++k)
      rest += size(order[k]) * size(order[k]);
    rest = std::sqrt(rest);
    for (size_t k = 0; k < order.size(); ++k) {
      const int row = order[k];
      const bool own_slot = static_cast<int>(k) < kept;
      const int slot = own_slot ? static_cast<int>(k) : kept;
      if (own_slot) residuals[slot] = rows.residual()[row];
      if (jacobians) {
        AddRow(rows, row, slot, own_slot ? 1 : rows.residual()[row] / std::max(rest, 1e-300),
               jacobians);
      }
    }
    if (kept < rows.num_rows()) residuals[kept] = rest;
    return true;
  }

 private:
  void Clear(double** jacobians) const {
    for (size_t b = 0; b < parameter_block_sizes().size(); ++b) {
      const int size = parameter_block_sizes()[b] * num_residuals();
      if (jacobians[b]) std::fill(jacobians[b], jacobians[b] + size, 0.0);
    }
  }

  void AddRow(const Rows& rows, int row, int slot, double factor, double** jacobians) const {
    for (int b = 0; b < blocks_; ++b) {
      if (!jacobians[b]) continue;
      for (int k = 0; k < kBlock; ++k) {
        jacobians[b][kBlock * slot + k] += factor * rows.jacobian()(row, kBlock * b + k);
      }
    }
    for (const Rows::AnchorEntry& e : rows.anchors()) {
      if (e.row != row) continue;
      const auto at = std::find(anchors_.begin(), anchors_.end(), e.anchor);
      double* j = jacobians[blocks_ + (at - anchors_.begin())];
      if (j) j[kAnchor * slot + e.component] += factor * e.value;
    }
  }

  const FrameCache* cache_;
  const Term* term_;
  int t_;
  double weight_;
  std::vector<int> anchors_;
  int blocks_ = 0;
};

// w x for one block: the tracking rows.
class LinearCost : public ceres::SizedCostFunction<kBlock, kBlock> {
 public:
  explicit LinearCost(const Vec3& weight) : weight_(weight) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (int k = 0; k < kBlock; ++k) residuals[k] = weight_[k] * x[0][k];
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> j(jacobians[0]);
      j = weight_.asDiagonal();
    }
    return true;
  }

 private:
  Vec3 weight_;
};

// w (x(t-1) - 2 x(t) + x(t+1) + b) for one block.
class SmoothCost : public ceres::SizedCostFunction<kBlock, kBlock, kBlock, kBlock> {
 public:
  SmoothCost(const Vec3& weight, const Vec3& base) : weight_(weight), base_(base) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (int k = 0; k < kBlock; ++k) {
      residuals[k] = weight_[k] * (x[0][k] - 2 * x[1][k] + x[2][k] + base_[k]);
    }
    if (!jacobians) return true;
    for (int p = 0; p < 3; ++p) {
      if (!jacobians[p]) continue;
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> j(jacobians[p]);
      j = (p == 1 ? -2.0 : 1.0) * weight_.asDiagonal().toDenseMatrix();
    }
    return true;
  }

 private:
  Vec3 weight_, base_;
};

class StageCallback : public ceres::IterationCallback {
 public:
  StageCallback(const StageContext& context, const FrameCache& cache, int threads,
                SolveResult* result)
      : context_(context), cache_(cache), threads_(threads), result_(result) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    ++result_->linear_solves;
    if (context_.seconds_left > 0 && SecondsNow() - context_.started > context_.seconds_left) {
      status = SolveStatus::kTimeLimit;
      return ceres::SOLVER_ABORT;
    }
    if (!summary.step_is_successful) return ceres::SOLVER_CONTINUE;
    ++result_->iterations;
    Iteration iteration;
    iteration.stage = context_.stage;
    iteration.index = result_->iterations;
    iteration.cost = summary.cost;
    iteration.step_m = cache_.last_step_m();
    iteration.term_cost =
        context_.problem->TermCosts(result_->unknowns, context_.contact_factor, threads_);
    MeasureIteration(*context_.problem, result_->unknowns, threads_, &iteration);
    iteration.seconds = SecondsNow() - context_.started;
    result_->history.push_back(iteration);
    if (*context_.progress && !(*context_.progress)(iteration)) {
      status = SolveStatus::kInterrupted;
      return ceres::SOLVER_ABORT;
    }
    if (!end_) {
      end_.emplace(context_.tolerance, summary.cost + summary.cost_change,
                   context_.problem->scene().num_frames() == 1);
    }
    const bool free = summary.trust_region_radius > kFreeRadius;
    return end_->Add(summary.cost, free) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                         : ceres::SOLVER_CONTINUE;
  }

  SolveStatus status = SolveStatus::kConverged;

 private:
  const StageContext& context_;
  const FrameCache& cache_;
  int threads_;
  SolveResult* result_;
  std::optional<StageEnd> end_;
};

class CeresStage {
 public:
  CeresStage(const StageContext& context, SolveResult* result)
      : context_(context),
        scene_(context.problem->scene()),
        result_(result),
        threads_(NumThreads(context.problem->settings().solve.threads)),
        cache_(context, result->unknowns, threads_),
        problem_(Options(&cache_)) {
    cache_.PrepareForEvaluation(true, true);
    AddParameters();
    AddTerms();
    AddSmoothness();
  }

  SolveStatus Run() {
    ceres::Solver::Options options;
    const bool clip = scene_.num_frames() > 1;
    options.linear_solver_type = clip ? ceres::CGNR : ceres::DENSE_NORMAL_CHOLESKY;
    options.preconditioner_type = ceres::JACOBI;
    options.eta = 0.1;
    options.num_threads = threads_;
    options.max_num_iterations = context_.iterations_left;
    options.initial_trust_region_radius = 1;
    options.max_num_consecutive_invalid_steps = 50;
    options.function_tolerance = 1e-12;
    options.gradient_tolerance = 1e-10;
    options.parameter_tolerance = 1e-12;
    options.update_state_every_iteration = true;
    options.logging_type = ceres::SILENT;
    StageCallback callback(context_, cache_, threads_, result_);
    options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    result_->stalled = summary.termination_type == ceres::FAILURE;
    if (callback.status != SolveStatus::kConverged) return callback.status;
    return result_->iterations >= context_.iterations_left &&
                   summary.termination_type == ceres::NO_CONVERGENCE
               ? SolveStatus::kIterationLimit
               : SolveStatus::kConverged;
  }

 private:
  static ceres::Problem::Options Options(FrameCache* cache) {
    ceres::Problem::Options options;
    options.evaluation_callback = cache;
    options.cost_function_ownership = ceres::TAKE_OWNERSHIP;
    return options;
  }

  double* BlockOf(int t, int b) { return result_->unknowns.edit.col(t).data() + kBlock * b; }
  double* AnchorBlock(int k) { return result_->unknowns.anchor.col(k).data(); }

  void AddParameters() {
    for (int t = 0; t < scene_.num_frames(); ++t) {
      for (int b = 0; b < scene_.num_coordinates() / kBlock; ++b) {
        problem_.AddParameterBlock(BlockOf(t, b), kBlock);
      }
      for (int f = 0; f < 2; ++f) {
        for (int l = 1; l < scene_.body[f].num_links(); ++l) {
          if (!scene_.body[f].links[l].locked) continue;
          problem_.SetParameterBlockConstant(
              BlockOf(t, scene_.FirstCoordinate(f) / kBlock + 1 + l));
        }
      }
    }
  }

  // Rows of every term in every frame: coordinate rows become LinearCost, the others slots.
  void AddTerms() {
    Rows rows;
    for (int t = 0; t < scene_.num_frames(); ++t) {
      VecX linear = VecX::Zero(scene_.num_coordinates());
      for (const WeightedTerm& weighted : context_.problem->terms()) {
        const double weight = weighted.StageWeight(context_.contact_factor);
        if (weight == 0) continue;
        const Term& term = *weighted.term;
        rows.Reset(cache_.frame(t), true);
        term.Evaluate(cache_.frame(t), &rows);
        for (const Rows::CoordinateRow& c : rows.coordinates()) {
          linear[c.coordinate] = std::hypot(linear[c.coordinate], weight * c.derivative);
        }
        AddTermSlots(term, t, weight, rows);
      }
      for (int b = 0; b < scene_.num_coordinates() / kBlock; ++b) {
        problem_.AddResidualBlock(new LinearCost(linear.segment<kBlock>(kBlock * b)), nullptr,
                                  BlockOf(t, b));
      }
    }
  }

  void AddTermSlots(const Term& term, int t, double weight, const Rows& rows) {
    const int slots = term.row_slots(cache_.frame(t));
    if (slots == 0) return;
    std::vector<int> anchors;
    for (const Rows::AnchorEntry& e : rows.anchors()) {
      const bool has = std::find(anchors.begin(), anchors.end(), e.anchor) != anchors.end();
      if (!has) anchors.push_back(e.anchor);
    }
    std::vector<double*> parameters;
    for (int b = 0; b < scene_.num_coordinates() / kBlock; ++b) parameters.push_back(BlockOf(t, b));
    for (const int k : anchors) parameters.push_back(AnchorBlock(k));
    problem_.AddResidualBlock(new TermCostFunction(&cache_, &term, t, weight, slots, anchors),
                              nullptr, parameters);
  }

  void AddSmoothness() {
    const Smoothness& smoothness = context_.problem->smoothness();
    for (int t = 1; t + 1 < scene_.num_frames(); ++t) {
      const VecX base = smoothness.BaseDifference(t);
      for (int b = 0; b < scene_.num_coordinates() / kBlock; ++b) {
        const int c = kBlock * b;
        problem_.AddResidualBlock(
            new SmoothCost(smoothness.weight().segment<kBlock>(c), base.segment<kBlock>(c)),
            nullptr, BlockOf(t - 1, b), BlockOf(t, b), BlockOf(t + 1, b));
      }
    }
  }

  const StageContext& context_;
  const Scene& scene_;
  SolveResult* result_;
  int threads_;
  FrameCache cache_;
  ceres::Problem problem_;
};

}  // namespace

SolveStatus SolveStageCeres(const StageContext& context, SolveResult* result) {
  return CeresStage(context, result).Run();
}

}  // namespace retarget::solver
