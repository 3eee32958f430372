// Levenberg-Marquardt on the frame-banded normal equations. Steps are shortened and damped per
// frame: where one would carry a limb too far, or through a limb, or into a contact that the linear
// model did not see, those frames are held back and the rest of the clip goes on.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/body/pass_through.h"
#include "solver/optimizer/banded.h"
#include "solver/optimizer/normal_equations.h"
#include "solver/optimizer/stage.h"
#include "solver/optimizer/stage_end.h"
#include "solver/problem/clock.h"
#include "solver/problem/parallel.h"
#include "solver/problem/time_guard.h"

namespace retarget::solver {
namespace {

// Damping, times diag(J^T J). After a whole step it follows the gain ratio by Nielsen's rule
// ("Damping parameter in Marquardt's method", 1999), the factor clamped on both sides.
constexpr double kLeastDamping = 1e-9;
constexpr double kMostDamping = 1e5;  // only a cliff (a pass-through) lies ahead: no way on
constexpr double kEase = 0.2, kStiffen = 2.0;
constexpr double kStiffenRejected = 5;  // where no share of the step would do
constexpr int kMostRejections = 12;     // in a row
// The damping of a frame that was held back falls to this part with every whole step after it.
constexpr double kForget = 0.25;

// Shares of a step, per frame. What the guard forbids is left with a margin, since the way is
// curved: a step that is too long is cut to kWithinLimit of the limit. Where in its way a limb went
// through a limb is not known, and how much of a step that costs more is good is not either: those
// are cut by a bit more than half, the costly ones further, as their whole frame is at fault.
constexpr int kShortenings = 6;  // trials of one step
constexpr double kWithinLimit = 0.9;
constexpr double kTunnelled = 0.4;
constexpr double kCostly = 0.3;
constexpr double kToBlame = 0.1;      // a frame with this part of the worst frame's rise is costly
constexpr double kShareSlope = 0.12;  // change from frame to frame: held back in about 8 frames

// A step counts as free, and can show convergence, where so much of it was taken on average and the
// damping does not hold it short either.
constexpr double kFreeShare = 0.9;
constexpr double kFreeDamping = 0.1;

class BandedStage {
 public:
  BandedStage(const StageContext& context, SolveResult* result)
      : context_(context),
        problem_(*context.problem),
        scene_(problem_.scene()),
        result_(result),
        threads_(NumThreads(problem_.settings().solve.threads)),
        frames_(static_cast<size_t>(std::max(threads_, 2))),
        rows_(frames_.size()),
        spans_(AnchorSpans(scene_)),
        system_(scene_.num_frames(), spans_, problem_.smoothness().weight().array().square()),
        accepted_(static_cast<size_t>(scene_.num_frames())),
        trial_(accepted_.size()),
        accepted_terms_(accepted_.size()),
        trial_terms_(accepted_.size()),
        accepted_cost_(accepted_.size()),
        trial_cost_(accepted_.size()),
        displacement_(accepted_.size()),
        tunnelled_(accepted_.size()),
        frame_damping_(VecX::Ones(scene_.num_frames())) {}

  SolveStatus Run() {
    const SolveSettings& settings = problem_.settings().solve;
    double cost = EvaluateTrial(result_->unknowns);
    Accept();
    double damping = settings.initial_damping;
    result_->stalled = false;
    StageEnd end(context_.tolerance, cost, scene_.num_frames() == 1);
    int rejected = 0;  // linear solves in a row without a sound step
    for (int iterations = 0; iterations < context_.iterations_left;) {
      if (context_.seconds_left > 0 && SecondsNow() - context_.started > context_.seconds_left) {
        return SolveStatus::kTimeLimit;
      }
      Unknowns next;
      double next_cost = cost;
      if (!SolveLinear(result_->unknowns, damping) || !Backtrack(cost, &next, &next_cost)) {
        damping *= kStiffenRejected;
        if (++rejected > kMostRejections || damping > kMostDamping) {
          result_->stalled = true;
          return SolveStatus::kConverged;
        }
        continue;
      }
      rejected = 0;
      ++iterations;
      ++result_->iterations;
      const bool whole = step_length_.minCoeff() == 1;
      if (whole) {
        const double gain = (cost - next_cost) / std::max(PredictedDecrease(damping), 1e-300);
        damping *= std::clamp(1 - std::pow(2 * gain - 1, 3), kEase, kStiffen);
        damping = std::max(damping, kLeastDamping);
      }
      // Frames whose step was shortened are damped in the next one, the others less and less.
      frame_damping_ = (kForget * frame_damping_).cwiseMax(step_length_.array().pow(-2).matrix());
      Iteration iteration;
      iteration.step_m = *std::max_element(displacement_.begin(), displacement_.end());
      result_->unknowns = std::move(next);
      cost = next_cost;
      Accept();
      if (!Report(cost, &iteration)) return SolveStatus::kInterrupted;
      const bool free = step_length_.mean() > kFreeShare && damping < kFreeDamping;
      if (end.Add(cost, free)) return SolveStatus::kConverged;
    }
    return SolveStatus::kIterationLimit;
  }

 private:
  void Assemble(const Unknowns& x, int t, int thread, FrameBlock* block) {
    frames_[thread].Set(scene_, x, t, true);
    problem_.EvaluateFrame(frames_[thread], context_.contact_factor, true, &rows_[thread]);
    FillBlock(problem_, rows_[thread], x.edit, t, block);
  }

  bool SolveLinear(const Unknowns& x, double damping) {
    ++result_->linear_solves;
    return system_.Solve(
        [&](int t, int thread, FrameBlock* block) { Assemble(x, t, thread, block); },
        damping * frame_damping_, threads_, &step_);
  }

  // What the linear model gains by the whole step: with (H + damping D) s = -g,
  // -g.s - s.H s / 2, and s.H s = -g.s - damping s.D s.
  double PredictedDecrease(double damping) const {
    double slope = -step_.anchors.cwiseProduct(step_.anchor_gradient).sum(), damped = 0;
    for (int t = 0; t < scene_.num_frames(); ++t) {
      const auto s = step_.frames.col(t).array();
      slope -= (s * step_.gradient.col(t).array()).sum();
      damped += damping * frame_damping_[t] * (s * s * step_.diagonal.col(t).array()).sum();
    }
    return 0.5 * (slope + damped);
  }

  // Finds the share of the step that each frame can take: no node too far, no limb through a limb,
  // be it from the last iterate or from the frame before, and less cost in all. Frames that cannot
  // take all of it are held back with their neighbours, evenly, and the rest of the clip goes on.
  // False where no share will do.
  bool Backtrack(double cost, Unknowns* next, double* next_cost) {
    const double limit = problem_.settings().solve.step_limit_m;
    const int n = scene_.num_frames();
    step_length_ = VecX::Ones(n);
    for (int attempt = 0; attempt < kShortenings; ++attempt) {
      *next = result_->unknowns;
      next->edit += step_.frames * step_length_.asDiagonal();
      for (size_t k = 0; k < spans_.size(); ++k) {
        const int first = spans_[k].first, length = spans_[k].last - first + 1;
        next->anchor.col(k) += step_length_.segment(first, length).mean() * step_.anchors.col(k);
      }
      *next_cost = EvaluateTrial(*next);
      VecX factor = VecX::Ones(n);
      for (int t = 0; t < n; ++t) {
        if (displacement_[t] > limit) factor[t] = kWithinLimit * limit / displacement_[t];
        if (tunnelled_[t]) factor[t] = std::min(factor[t], kTunnelled);
      }
      for (int t = 0; t + 1 < n; ++t) {
        if (!trial_through_[t] || accepted_through_[t]) continue;
        for (const int side : {t, t + 1}) factor[side] = std::min(factor[side], kTunnelled);
      }
      const bool sound = factor.minCoeff() == 1;
      if (sound) {
        if (*next_cost < cost) return true;
        // The frames that cost more than before hold the others back: shorten those.
        double worst = 0;
        for (int t = 0; t < n; ++t) worst = std::max(worst, trial_cost_[t] - accepted_cost_[t]);
        for (int t = 0; t < n; ++t) {
          if (trial_cost_[t] - accepted_cost_[t] > kToBlame * worst) factor[t] = kCostly;
        }
      }
      step_length_ = step_length_.cwiseProduct(factor);
      for (int t = 1; t < n; ++t)
        step_length_[t] = std::min(step_length_[t], step_length_[t - 1] + kShareSlope);
      for (int t = n - 2; t >= 0; --t)
        step_length_[t] = std::min(step_length_[t], step_length_[t + 1] + kShareSlope);
    }
    return false;
  }

  // Cost of `x`. Also sets, per frame, the cost, how far the furthest node moved from the accepted
  // iterate (m), and whether a limb went through a limb.
  double EvaluateTrial(const Unknowns& x) {
    const double jump = problem_.settings().solve.gli_jump;
    ParallelFor(scene_.num_frames(), threads_, [&](int t, int thread) {
      Frame& frame = frames_[thread];
      frame.Set(scene_, x, t, false);
      trial_cost_[t] = problem_.FrameCost(frame, x.edit, context_.contact_factor, &rows_[thread],
                                          &trial_terms_[t]);
      for (int f = 0; f < 2; ++f) trial_[t][f] = frame.posed[f].node;
      if (accepted_[t][0].empty()) return;
      displacement_[t] = LargestDisplacement(accepted_[t], trial_[t]);
      tunnelled_[t] = LargestGliJump(scene_.body, accepted_[t], trial_[t], kGuardReach).size > jump;
    });
    trial_through_ = FramesThatGoThrough(scene_, x.edit, trial_, context_.refuse_dips, threads_);
    return std::accumulate(trial_cost_.begin(), trial_cost_.end(), 0.0);
  }

  void Accept() {
    std::swap(accepted_, trial_);
    trial_.resize(accepted_.size());
    accepted_cost_ = trial_cost_;
    accepted_through_ = trial_through_;
    std::swap(accepted_terms_, trial_terms_);
  }

  bool Report(double cost, Iteration* iteration) {
    iteration->stage = context_.stage;
    iteration->index = result_->iterations;
    iteration->cost = cost;
    iteration->term_cost.assign(accepted_terms_[0].size(), 0);
    for (const std::vector<double>& of_frame : accepted_terms_) {
      for (size_t k = 0; k < of_frame.size(); ++k) iteration->term_cost[k] += of_frame[k];
    }
    MeasureIteration(problem_, result_->unknowns, threads_, iteration);
    iteration->seconds = SecondsNow() - context_.started;
    result_->history.push_back(*iteration);
    return !*context_.progress || (*context_.progress)(*iteration);
  }

  const StageContext& context_;
  const Problem& problem_;
  const Scene& scene_;
  SolveResult* result_;
  int threads_;
  std::vector<Frame> frames_;  // per thread
  std::vector<Rows> rows_;
  std::vector<AnchorSpan> spans_;
  BandedSystem system_;
  BandedStep step_;
  std::vector<NodePositions> accepted_, trial_;
  std::vector<std::vector<double>> accepted_terms_, trial_terms_;  // costs, per frame and term
  std::vector<double> accepted_cost_, trial_cost_;
  std::vector<double> displacement_;                    // of the last trial, per frame (m)
  std::vector<char> tunnelled_;                         // from the accepted iterate, per frame
  std::vector<char> accepted_through_, trial_through_;  // on the way to the next frame
  VecX frame_damping_;                                  // factor of the damping, per frame
  VecX step_length_;                                    // of the last step, per frame
};

}  // namespace

SolveStatus SolveStageBanded(const StageContext& context, SolveResult* result) {
  return BandedStage(context, result).Run();
}

}  // namespace retarget::solver
