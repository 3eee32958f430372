#include "tools/api/template_check.h"

#include <fmt/format.h>

#include <cmath>

#include "model/body/joint_limit.h"
#include "solver/start/weak_tags.h"

namespace retarget::api {
namespace {
// Hands that hold further off (m) are seen not to: the hold keeps the posture's distance.
constexpr double kHovers = 0.02;
}  // namespace

report::Json ContactsJson(const std::array<Body, 2>& body,
                          const std::vector<HandContact>& contacts) {
  report::Json out = report::Json::array();
  for (const HandContact& c : contacts) {
    const auto end = [&](int f, int node, double along) {
      return report::Json{
          {"figure", report::kFigure[f]}, {"node", body[f].nodes[node].name}, {"along", along}};
    };
    out.push_back(
        {{"from", end(c.figure, c.hand, c.along)}, {"to", end(1 - c.figure, c.to, c.to_along)}});
  }
  return out;
}

report::Json TangleJson(const Body& a, const Body& b, const Tangle& t) {
  return {{"a", {a.nodes[t.a.from].name, a.nodes[t.a.to].name}},
          {"b", {b.nodes[t.b.from].name, b.nodes[t.b.to].name}},
          {"gli", t.gli}};
}

std::vector<std::string> TagWarnings(const TemplatePosture& posture, const std::vector<Tag>& tags) {
  std::vector<std::string> warnings;
  for (const Tag& tag : tags) {
    const std::string line = TangleText(posture.body[0], posture.body[1], tag.tangle);
    if (solver::IsWeak(tag)) {
      warnings.push_back(fmt::format("{} is weak: |GLI| {:.2f} is under {}", line,
                                     std::abs(tag.tangle.gli), solver::kWeakGli));
    }
    if (solver::IsEasilyLost(tag)) {
      warnings.push_back(fmt::format("{} is easily lost: robustness radius {:.2f} is under {}",
                                     line, tag.rho, solver::kEasilyLostRho));
    }
  }
  if (tags.empty()) {
    warnings.push_back("nothing is tangled in this posture");
  }
  return warnings;
}

std::vector<std::string> LimitWarnings(const TemplatePosture& posture) {
  std::vector<std::string> warnings;
  for (int f = 0; f < 2; ++f) {
    const Body& body = posture.body[f];
    for (int l = 1; l < body.num_links(); ++l) {
      const double beyond = FurthestBeyondLimit(body, l, posture.pose[f]) / kDegree;
      if (beyond < kBeyondLimitDeg) continue;
      warnings.push_back(fmt::format("{}'s {} is bent {:.0f} degrees beyond its range of motion",
                                     report::kFigure[f], body.links[l].name, beyond));
    }
  }
  return warnings;
}

TemplateCheck CheckTemplate(const TemplatePosture& posture, const Settings& settings) {
  TemplateCheck check;
  check.tangles = solver::FindTemplateTangles(posture, settings.tangle);
  solver::Scene scene;
  scene.body = posture.body;
  scene.tangles = solver::TangleTargets(check.tangles.tags, posture, settings.tangle.margin);
  scene.holds = posture.holds;
  scene.hand_contacts = HandContactsOf(posture, settings.hand_contact.reach_m);
  for (int f = 0; f < 2; ++f) scene.source[f].frames = {posture.pose[f]};
  const solver::MetricsContext subject = solver::MetricsContextOf(scene);
  const solver::MotionView view = solver::ViewOf(scene.body, scene.source);
  check.metrics = solver::Measure(subject, view, view);
  check.checks = solver::CheckRequirements(subject, check.metrics, settings.requirements);
  check.warnings = TagWarnings(posture, check.tangles.tags);
  const std::vector<std::string> limits = LimitWarnings(posture);
  check.warnings.insert(check.warnings.end(), limits.begin(), limits.end());
  for (int f = 0; f < 2; ++f) {
    const double gap = check.metrics.figure[f].holding_hand_gap_m;
    if (!(gap > kHovers)) continue;
    check.warnings.push_back(
        fmt::format("a hand of {} holds {:.1f} cm off the surface of what it holds",
                    report::kFigure[f], 100 * gap));
  }
  return check;
}

}  // namespace retarget::api
