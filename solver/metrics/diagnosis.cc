#include "solver/metrics/diagnosis.h"

#include <algorithm>
#include <map>

#include "solver/metrics/diagnosis_cause.h"

namespace retarget::solver {
namespace {

// The part of the objective that works for a requirement.
bool WorksFor(const RequirementCheck& check, const Scene& scene, const TermGradient& part) {
  if (part.term != TermOf(check.kind)) return false;
  if (check.item >= 0) return part.item == check.item;
  if (check.kind != RequirementKind::kFootDrift) return true;
  const LimbNode& limb = check.limbs[0];
  const PlantedFoot foot = FootOfAnchor(scene, part.item);
  return foot.figure == limb.figure && foot.contact.node == limb.node;
}

}  // namespace

Opposition OppositionTo(const Problem& problem, const Unknowns& unknowns,
                        const RequirementCheck& check) {
  Opposition out;
  const Scene& scene = problem.scene();
  if (check.frame < 0 || check.limbs.empty()) return out;
  const int first = std::max(0, check.frame - kConflictReach);
  const int last = std::min(scene.num_frames(), check.frame + kConflictReach + 1);
  const std::vector<TermGradient> gradients =
      TermGradients(problem, unknowns, first, last, CoordinatesOf(scene, check.limbs));
  VecX own;
  for (const TermGradient& part : gradients) {
    if (!WorksFor(check, scene, part)) continue;
    own = own.size() == 0 ? part.gradient : VecX(own + part.gradient);
  }
  if (own.size() == 0 || own.isZero(0)) return out;
  out.pull = own.norm();
  const auto share_of = [&](const VecX& g) { return -g.dot(own) / own.squaredNorm(); };
  std::map<std::string, VecX> by_term;  // the others
  for (const TermGradient& part : gradients) {
    if (WorksFor(check, scene, part)) continue;
    const auto [at, is_new] = by_term.try_emplace(part.term, part.gradient);
    if (!is_new) at->second += part.gradient;
    out.unopposed -= share_of(part.gradient);
  }
  for (const auto& [term, gradient] : by_term) {
    if (gradient.isZero(0)) continue;
    out.shares.push_back(
        {term, share_of(gradient), gradient.dot(own) / (gradient.norm() * own.norm())});
  }
  if (out.shares.empty()) return out;
  std::stable_sort(out.shares.begin(), out.shares.end(),
                   [](const auto& s, const auto& t) { return s.share > t.share; });
  double most = 0;
  for (const TermGradient& part : gradients) {
    if (part.term != out.shares[0].term || part.item < 0 || WorksFor(check, scene, part)) continue;
    if (share_of(part.gradient) <= most) continue;
    most = share_of(part.gradient);
    out.item = part.item;
  }
  return out;
}

std::vector<std::string> Diagnosis::terms() const {
  std::vector<std::string> terms;
  if (!TermOf(check.kind).empty()) terms.push_back(TermOf(check.kind));
  if (opposition.opposed()) terms.push_back(opposition.shares[0].term);
  return terms;
}

std::vector<Diagnosis> Diagnose(const Problem& problem, const Unknowns& unknowns,
                                const MetricsContext& subject, const Metrics& metrics,
                                const std::vector<RequirementCheck>& checks) {
  std::vector<Diagnosis> diagnoses;
  for (const RequirementCheck& check : checks) {
    if (check.met) continue;
    // The share of deep frames says nothing that the deepest does not.
    const bool told = check.kind == RequirementKind::kPenetrationOver1cm && !diagnoses.empty() &&
                      diagnoses.back().check.kind == RequirementKind::kPenetration;
    if (told) continue;
    Diagnosis diagnosis;
    diagnosis.check = check;
    diagnosis.opposition = OppositionTo(problem, unknowns, check);
    const Opposition& o = diagnosis.opposition;
    if (o.item >= 0 && o.shares[0].term == "foot_lock") {
      diagnosis.opposing_foot = FootOfAnchor(problem.scene(), o.item);
    }
    FindCause({problem, unknowns, subject, metrics}, &diagnosis);
    diagnoses.push_back(diagnosis);
  }
  return diagnoses;
}

}  // namespace retarget::solver
