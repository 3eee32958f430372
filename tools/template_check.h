// What is right and wrong with a template posture: `retarget template --check` and the posing
// session ask the same.
#pragma once

#include <string>
#include <vector>

#include "solver/fit_template.h"
#include "solver/requirements.h"
#include "tools/report.h"

namespace retarget {

struct TemplateCheck {
  TemplateTangles tangles;
  Metrics metrics;
  std::vector<RequirementCheck> checks;
  std::vector<std::string> warnings;  // weak tags and the like
  bool met() const { return AllMet(checks); }
};
TemplateCheck CheckTemplate(const TemplatePosture& posture);

// "a (left_hand, right_hand) x b (neck, root)".
std::string TangleLine(const Body& a, const Body& b, const Tangle& tangle);
Json TangleJson(const Body& a, const Body& b, const Tangle& tangle);

}  // namespace retarget
