#include "tools/proof/scene_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/measured_scene.h"
#include "tools/report/requirement_json.h"
#include "tools/report/requirement_text.h"

namespace retarget::proof {
namespace {

using Kind = solver::RequirementKind;

solver::RequirementCheck CheckOf(const solver::Statement& s) {
  return {.kind = s.kind, .item = s.item, .figure = s.figure, .limit = s.limit};
}

std::string Names(const std::vector<solver::LimbNode>& limbs, const std::array<Body, 2>& body) {
  std::string out;
  for (const solver::LimbNode& limb : limbs) {
    out += (out.empty() ? "" : ", ") + report::LimbName(limb, body);
  }
  return out;
}

// Of one statement, where it is unambiguous: "a (left_hand, right_hand) x b (neck, root)".
std::string LimbsText(const solver::Statement& s, const solver::Finding& finding,
                      const std::array<Body, 2>& body) {
  const std::vector<solver::LimbNode>& l = finding.limbs;
  if (s.kind == Kind::kTangle && l.size() == 4) return report::TagText(l, body);
  return Names(l, body);
}

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace

solver::Proof ProveScene(const io::SceneMotion& scene, const solver::MetricsContext& subject,
                         const Requirements& limits) {
  const KeyedMotion motion = scene.Keyed();
  const std::array<std::vector<int>, 2> nodes = report::SceneNodes(scene, subject.body);
  return solver::Prove({motion, nodes, subject, limits});
}

std::string NameOf(const solver::Statement& statement) {
  return report::NameOf(CheckOf(statement));
}

std::string FindingSentence(const solver::Proof& proof, const solver::Finding& finding,
                            const solver::MetricsContext& subject) {
  const solver::Statement& s = proof.statements[finding.statement];
  const std::string limbs = LimbsText(s, finding, subject.body);
  if (s.kind == Kind::kPassThroughs) {
    return fmt::format("{} at {:.4f} s: the axes of {} meet (within {:.2g} m)", NameOf(s),
                       finding.time_s, limbs, std::max(0.0, finding.value));
  }
  return fmt::format("{} {} at {:.4f} s: {}, {:.4g} {}, required {} {:.4g}", NameOf(s),
                     finding.lost ? "lost" : "not decided", finding.time_s, limbs, finding.value,
                     report::UnitOf(s.kind), s.kind == Kind::kTangle ? ">" : "<=", s.limit);
}

std::string ProofSentence(const solver::Proof& proof, const solver::MetricsContext& subject) {
  const std::string work = fmt::format("{} intervals, {} stretches, halved {} times at most",
                                       proof.intervals.size(), proof.evaluations, proof.depth);
  if (proof.proved()) {
    // What is proved, and no more: other requirements are defined on frames (docs/proof.md).
    return fmt::format(
        "proved for all t: {}nothing passes through; overlap, holds, planted feet, floor and "
        "lengths "
        "keep their limits ({})",
        subject.tangles.empty() ? "" : "no tag is lost, ", work);
  }
  std::string out = "not proved: " + FindingSentence(proof, proof.findings[0], subject);
  if (proof.findings.size() > 1) out += fmt::format(" (the first of {})", proof.findings.size());
  return out;
}

Json StatementsJson(const solver::Proof& proof) {
  Json out = Json::array();
  for (const solver::Statement& s : proof.statements) {
    Json one = {{"name", NameOf(s)}};
    solver::RequirementCheck check{.kind = s.kind, .item = s.item, .figure = s.figure};
    report::AddPlace(check, &one);
    one.erase("frame");
    one["unit"] = report::UnitOf(s.kind);
    one["limit"] = s.limit;
    one["proved"] = s.proved;
    one["bound"] = s.proved ? NumberOrNull(s.bound) : Json(nullptr);
    one["value"] = NumberOrNull(s.value);
    out.push_back(one);
  }
  return out;
}

Json FindingsJson(const solver::Proof& proof, const solver::MetricsContext& subject) {
  Json out = Json::array();
  for (const solver::Finding& finding : proof.findings) {
    const solver::Statement& s = proof.statements[finding.statement];
    Json one = {{"name", NameOf(s)}, {"lost", finding.lost}, {"time_s", finding.time_s}};
    solver::RequirementCheck check = CheckOf(s);
    check.frame = finding.frame;
    report::AddPlace(check, &one);
    one["value"] = finding.value;
    one["worst"] = finding.worst;
    one["worst_s"] = finding.worst_s;
    one["unit"] = s.kind == Kind::kPassThroughs ? "m" : report::UnitOf(s.kind);
    one["intervals"] = finding.intervals;
    one["limbs"] = report::LimbsJson(finding.limbs, subject.body);
    one["sentence"] = FindingSentence(proof, finding, subject);
    out.push_back(one);
  }
  return out;
}

Json ProofJson(const solver::Proof& proof, const solver::MetricsContext& subject) {
  Json open = Json::array();
  for (size_t k = 0; k < proof.intervals.size(); ++k) {
    const std::vector<double>& bound = proof.intervals[k].bound;
    if (std::any_of(bound.begin(), bound.end(), [](double b) { return !std::isfinite(b); })) {
      open.push_back(k);
    }
  }
  return {{"proved", proof.proved()},
          {"sentence", ProofSentence(proof, subject)},
          {"intervals", proof.intervals.size()},
          {"evaluations", proof.evaluations},
          {"depth", proof.depth},
          {"findings", FindingsJson(proof, subject)},
          {"open", open}};
}

}  // namespace retarget::proof
