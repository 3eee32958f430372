// What is right and wrong with a template posture: `retarget template --check` and the posing
// session ask the same.
#pragma once

#include <string>
#include <vector>

#include "solver/metrics/requirements.h"
#include "solver/start/fit_template.h"
#include "tools/report/report.h"

namespace retarget::api {

struct TemplateCheck {
  solver::TemplateTangles tangles;
  solver::Metrics metrics;
  std::vector<solver::RequirementCheck> checks;
  std::vector<std::string> warnings;  // weak tags and the like
  bool met() const { return solver::AllMet(checks); }
};
// With the tags and against the requirements of these settings.
TemplateCheck CheckTemplate(const TemplatePosture& posture, const Settings& settings = {});
// What is to be said of weak tags.
std::vector<std::string> TagWarnings(const TemplatePosture& posture, const std::vector<Tag>& tags);

// What is to be said of joints that a posture bends this much further than people can (degrees).
inline constexpr double kBeyondLimitDeg = 1;
std::vector<std::string> LimitWarnings(const TemplatePosture& posture);

report::Json TangleJson(const Body& a, const Body& b, const Tangle& tangle);
// Of every hand: {"from": {"figure", "node", "along"}, "to": {...}}, `along` a share of the
// segment.
report::Json ContactsJson(const std::array<Body, 2>& body,
                          const std::vector<HandContact>& contacts);

}  // namespace retarget::api
