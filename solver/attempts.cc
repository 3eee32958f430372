#include "solver/attempts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

#include "solver/metrics/metrics.h"
#include "solver/metrics/requirements.h"
#include "solver/problem/clock.h"
#include "solver/problem/parallel.h"
#include "solver/start/quasi_static.h"
#include "solver/start/start.h"

namespace retarget::solver {
namespace {

// Share of weights.foot_swing where feet are the only ones to miss.
constexpr double kSofter = 0.25;

// A solve, and what it shows.
struct Attempt {
  SolveResult solve;
  Metrics metrics;
  int missed = 0;                  // requirements
  bool feet_alone = false;         // all of those are about free feet
  std::vector<std::string> worse;  // than the baseline in these
  double worse_by = 0;             // sum of what that is over what is allowed, as shares of it
  std::string remedy;              // what was done about what the first solve showed
};

// One that was interrupted has not been measured.
bool Better(const Attempt& a, const Attempt& b) {
  const auto rank = [](const Attempt& x) {
    const bool interrupted = x.solve.status == SolveStatus::kInterrupted;
    const bool unfinished = x.solve.status != SolveStatus::kConverged;
    return std::tuple(interrupted, x.worse.size(), x.metrics.pass_throughs.size(), x.worse_by,
                      unfinished, x.missed, x.solve.cost);
  };
  return rank(a) < rank(b);
}

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (size_t k = 0; k < names.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  }
  return text;
}

class Attempts {
 public:
  Attempts(const Problem& problem, const Progress& progress, RetargetResult* result)
      : problem_(problem),
        scene_(problem.scene()),
        progress_(progress),
        result_(result),
        subject_(MetricsContextOf(scene_)) {}

  void Run() {
    StartChoice& choice = result_->start;
    choice.requested = problem_.settings().solve.start;
    const SimulationResult& simulation = result_->simulation;
    const bool usable = simulation.status == SimulationStatus::kCompleted;
    const bool try_simulated = choice.requested != Start::kTemplate && usable;
    const bool try_template = choice.requested != Start::kSimulated || !usable;
    choice.reason = choice.requested == Start::kTemplate || usable
                        ? "as asked for"
                        : "the simulation cannot be a start: " + simulation.message;
    if (try_simulated) Take(Start::kSimulated, From(Start::kSimulated));
    if (try_template && !interrupted_) {
      Attempt attempt = From(Start::kTemplate);
      if (try_simulated) choice.reason = "the cheaper of both";
      if (!try_simulated || attempt.solve.cost < best_.solve.cost) {
        Take(Start::kTemplate, std::move(attempt));
      }
    }
    if (!best_.worse.empty()) TryOthers();
    if (!best_.remedy.empty()) result_->warnings.push_back(best_.remedy);
    best_.solve.seconds = seconds_;  // all were needed
    if (interrupted_) best_.solve.status = SolveStatus::kInterrupted;
    result_->solve = std::move(best_.solve);
  }

 private:
  void Take(Start start, Attempt attempt) {
    result_->start.used = start;
    best_ = std::move(attempt);
  }

  // The other starts, while the result is worse than the baseline.
  void TryOthers() {
    const auto attempt = [&](Start start, const char* name, const auto& solve) {
      if (!MayGoOn() || best_.worse.empty()) return;
      const std::vector<std::string> worse = best_.worse;
      Attempt other = solve();
      const bool better = Better(other, best_);
      result_->warnings.push_back("the solve was worse than the simulated baseline in " +
                                  Listed(worse) + ": the clip was solved again from " + name +
                                  (better ? ", which is kept" : ", which is no better"));
      if (!better) return;
      result_->start.reason = "the first solve was worse than the baseline";
      Take(start, std::move(other));
    };
    if (!result_->start.template_cost) {
      attempt(Start::kTemplate, "the template", [&] { return From(Start::kTemplate); });
    }
    const bool whole = result_->simulation.frames_simulated == scene_.num_frames();
    if (whole && !result_->start.simulated_cost) {
      attempt(Start::kSimulated, "the simulated motion",
              [&] { return Solve(UnknownsFromPoses(scene_, result_->simulation.motion), {1}); });
    }
    if (best_.worse.empty() || interrupted_) return;
    result_->warnings.push_back("the result is worse than the simulated baseline in " +
                                Listed(best_.worse));
  }

  // Solves from a start, and again where that shows what steps cannot mend.
  Attempt From(Start start) {
    const double started = SecondsNow();
    const Unknowns guess = start == Start::kSimulated
                               ? UnknownsFromPoses(scene_, result_->simulation.motion)
                               : TemplateStart(problem_);
    result_->start_seconds += SecondsNow() - started;
    const std::vector<double>& stages = problem_.settings().solve.stages;
    Attempt best = Cured(Solve(guess, stages));
    if (best.missed > 0 && stages.size() > 1 && MayGoOn()) {
      // While contacts were weak a limb may have come to lie on the wrong side, and the guard lets
      // it not back through: full contacts from the start keep it where it was.
      Attempt full = Cured(Solve(guess, {1}));
      if (Better(full, best)) best = std::move(full);
    }
    if (best.feet_alone && MayGoOn()) {
      Attempt softer = WithSofterFeet(best, guess);
      const bool fewer = !interrupted_ && softer.missed < best.missed && softer.worse.empty();
      if (fewer) best = std::move(softer);
    }
    (start == Start::kSimulated ? result_->start.simulated_cost : result_->start.template_cost) =
        best.solve.cost;
    return best;
  }

  // A foot that is led far along its captured path may be flung after its body: then once more with
  // less of that.
  Attempt WithSofterFeet(const Attempt& attempt, const Unknowns& guess) {
    Settings settings = problem_.settings();
    settings.weights.foot_swing *= kSofter;
    const Problem softer(scene_, settings);
    Attempt out = Solve(softer, guess, problem_.settings().solve.stages);
    out.solve.cost = problem_.Cost(out.solve.unknowns, 1, NumThreads(settings.solve.threads));
    char weight[32];
    std::snprintf(weight, sizeof weight, "%.3g", settings.weights.foot_swing);
    out.remedy =
        attempt.remedy + (attempt.remedy.empty() ? "" : "; ") +
        "free feet were flung or slid: the clip was solved again with weights.foot_swing " + weight;
    return out;
  }

  // The same without pass-throughs, as far as that can be.
  Attempt Cured(Attempt attempt) {
    const bool deep = attempt.metrics.deepest_m() > problem_.settings().requirements.penetration_m;
    if ((attempt.metrics.pass_throughs.empty() && !deep) || !MayGoOn()) return attempt;
    Unknowns x = attempt.solve.unknowns;
    const int frames = CurePassThroughs(problem_, &x);
    if (frames == 0) return attempt;
    Attempt cured = Solve(x, {1});
    if (!Better(cured, attempt)) return attempt;
    cured.remedy =
        "limbs went through limbs from frame to frame: " + std::to_string(frames) +
        " frames were solved again from the side of the template, and the clip once more";
    return cured;
  }

  Attempt Solve(const Unknowns& start, const std::vector<double>& stages) {
    return Solve(problem_, start, stages);
  }

  Attempt Solve(const Problem& problem, const Unknowns& start, const std::vector<double>& stages) {
    Attempt attempt;
    CheckStages(stages);
    attempt.solve = SolveSpacetime(problem, start, stages, progress_);
    seconds_ += attempt.solve.seconds;
    interrupted_ = attempt.solve.status == SolveStatus::kInterrupted;
    if (!MayGoOn()) return attempt;
    attempt.metrics = Measured(EditedClips(scene_, attempt.solve.unknowns));
    const std::vector<RequirementCheck> checks =
        CheckRequirements(subject_, attempt.metrics, problem_.settings().requirements);
    attempt.missed = static_cast<int>(std::count_if(
        checks.begin(), checks.end(), [](const RequirementCheck& c) { return !c.met; }));
    attempt.feet_alone = attempt.missed > 0 &&
                         std::all_of(checks.begin(), checks.end(), [](const RequirementCheck& c) {
                           return c.met || c.kind == RequirementKind::kFootTravel ||
                                  c.kind == RequirementKind::kFootAcceleration;
                         });
    if (attempt.missed > 0) CompareWithBaseline(&attempt);
    return attempt;
  }

  void CompareWithBaseline(Attempt* attempt) {
    const Metrics& m = attempt->metrics;
    if (!baseline_) baseline_ = Measured(result_->simulation.motion);
    const Requirements& required = problem_.settings().requirements;
    const auto worse = [&](const std::string& in, double by) {
      attempt->worse.push_back(in);
      attempt->worse_by += by;
    };
    for (size_t k = 0; k < m.tangles.size(); ++k) {
      const double enough = std::min(required.gli, baseline_->tangles[k].smallest());
      const double missing = enough - m.tangles[k].smallest();
      if (missing > 0) worse("tag " + std::to_string(k + 1), missing / kTangleThreshold);
    }
    if (static_cast<int>(m.pass_throughs.size()) >
        std::max(required.pass_throughs, static_cast<int>(baseline_->pass_throughs.size()))) {
      worse("pass-throughs", 0);
    }
    const double allowed = std::max(required.penetration_m, baseline_->deepest_m());
    const double deeper = m.deepest_m() - allowed;
    if (deeper > 0) worse("penetration", deeper / std::max(allowed, 1e-3));
  }

  Metrics Measured(const std::array<Clip, 2>& clips) const {
    return Measure(subject_, ViewOf(scene_.body, clips), ViewOf(scene_.body, scene_.source));
  }

  bool MayGoOn() const { return !interrupted_ && problem_.settings().solve.max_seconds <= 0; }

  const Problem& problem_;
  const Scene& scene_;
  const Progress& progress_;
  RetargetResult* result_;
  MetricsContext subject_;
  std::optional<Metrics> baseline_;
  Attempt best_;
  double seconds_ = 0;
  bool interrupted_ = false;
};

}  // namespace

void SolveInAttempts(const Problem& problem, const Progress& progress, RetargetResult* result) {
  Attempts(problem, progress, result).Run();
}

}  // namespace retarget::solver
