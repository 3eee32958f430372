#include "solver/metrics/diagnosis_cause.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace retarget::solver {
namespace {

constexpr double kFlatGli = 0.05;  // turns per rad or m
constexpr double kDeep = 0.01;     // m

double WeightIn(const Settings& settings, const std::string& term) {
  double weight = 0;
  VisitSettings(settings, [&](const std::string& key, const auto& value, auto&&...) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      if (key == "weights." + term) weight = value;
    }
  });
  return weight;
}
double UsualWeight(const std::string& term) { return WeightIn(Settings{}, term); }

class CauseFinder {
 public:
  CauseFinder(const DiagnosisCase& c, Diagnosis* diagnosis)
      : c_(c), settings_(c.problem.settings()), diagnosis_(*diagnosis), check_(diagnosis->check) {}

  void Run() {
    const Opposition& o = diagnosis_.opposition;
    if (BeyondWeights() || FindContradiction(c_, &diagnosis_)) return;
    if (o.opposed() && o.shares[0].term == term_) return Set(Cause::kSameTerm);
    if (IsFlat()) return Set(Cause::kFlatTangle);
    if (Weight(term_) < 0.5 * UsualWeight(term_)) {
      Set(Cause::kLowWeight);
      return SuggestDefault(term_);
    }
    if (!o.settled()) return Set(Cause::kNotSettled);
    Set(o.opposed() ? Cause::kOpposed : Cause::kUnopposed);
    SuggestWeight();
  }

 private:
  void Set(Cause cause) { diagnosis_.cause = cause; }
  double Weight(const std::string& term) const { return WeightIn(settings_, term); }
  const TangleTarget& Tag() const { return c_.subject.tangles[static_cast<size_t>(check_.item)]; }

  void SuggestDefault(const std::string& term) {
    diagnosis_.suggestion = {"weights." + term, UsualWeight(term), Weight(term), true};
  }

  // Causes that no weighing of terms against each other can mend.
  bool BeyondWeights() {
    diagnosis_.pass_throughs = static_cast<int>(c_.metrics.pass_throughs.size());
    if (check_.kind == RequirementKind::kPassThroughs) {
      Set(Cause::kPassThrough);
    } else if (check_.kind == RequirementKind::kPoseError ||
               check_.kind == RequirementKind::kTrunkTilt ||
               check_.kind == RequirementKind::kFloating) {
      Set(Cause::kUnlike);
    } else if (term_.empty()) {
      Set(Cause::kNoTerm);
    } else if (check_.kind == RequirementKind::kTangle && Tag().target <= check_.limit) {
      LowTarget();
    } else if (Weight(term_) == 0) {
      Set(Cause::kNoWeight);
      SuggestDefault(term_);
    } else if (diagnosis_.opposition.pull == 0) {
      Set(Cause::kBetweenFrames);
    } else {
      return false;
    }
    return true;
  }

  // A tag that cannot rise above the requirement, since it does not aim there.
  void LowTarget() {
    if (std::abs(Tag().tag.tangle.gli) <= check_.limit) return Set(Cause::kLooseTemplate);
    Set(Cause::kLowTarget);
    const double margin = std::min(0.5, 1.1 * check_.limit - kTangleThreshold);
    diagnosis_.suggestion = {"tangle.margin", margin, settings_.tangle.margin, false};
  }

  // A tag whose gradient has vanished: its paths are far apart.
  bool IsFlat() {
    if (check_.kind != RequirementKind::kTangle) return false;
    const double weight = Weight(term_);
    const double missing = std::max(Tag().target - check_.value, 1e-6);
    diagnosis_.gli_slope = diagnosis_.opposition.pull / (weight * weight * missing);
    return diagnosis_.gli_slope < kFlatGli;
  }

  // An opponent's weight that is far too large back to its default, else more of its own.
  void SuggestWeight() {
    for (const Opposition::Share& s : diagnosis_.opposition.shares) {
      if (s.share < kCountingShare || Weight(s.term) <= 2 * UsualWeight(s.term)) continue;
      return SuggestDefault(s.term);
    }
    diagnosis_.suggestion = {"weights." + term_, MoreWeight(), Weight(term_), false};
  }

  // How much the weight of the requirement's own term would have to grow: against a steady force
  // the residual falls with the square of the weight.
  double MoreWeight() const {
    double ratio = check_.value / std::max(check_.limit, 1e-6);
    if (check_.kind == RequirementKind::kTangle) {
      ratio = (Tag().target - check_.value) / (Tag().target - check_.limit);
    }
    if (check_.kind == RequirementKind::kPenetrationOver1cm) {
      ratio = c_.metrics.penetration_m / kDeep;
    }
    const double more =
        Weight(term_) * std::clamp(1.5 * std::sqrt(std::max(ratio, 0.0)), 2.0, 10.0);
    const double digit = std::pow(10.0, std::floor(std::log10(more)) - 1);
    return digit * std::ceil(more / digit);
  }

  const DiagnosisCase& c_;
  const Settings& settings_;
  Diagnosis& diagnosis_;
  const RequirementCheck& check_;
  const std::string term_ = TermOf(check_.kind);
};

}  // namespace

void FindCause(const DiagnosisCase& c, Diagnosis* diagnosis) { CauseFinder(c, diagnosis).Run(); }

}  // namespace retarget::solver
