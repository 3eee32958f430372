// What a solved scene must show, checked against its metrics.
#pragma once

#include <string>
#include <vector>

#include "model/settings.h"
#include "solver/metrics/metrics.h"
#include "solver/metrics/term_gradient.h"

namespace retarget::solver {

inline constexpr const char* kDeepFrames = "penetration over 1 cm";  // a requirement's name

// A requirement and whether it is met; `where` names frame and limb of the worst.
struct RequirementCheck {
  std::string name;
  double value = 0, limit = 0;
  std::string unit;
  bool met = true;
  std::string where;
  std::string term = {};             // that works for it; empty: none does
  int item = -1;                     // tag or hold, from 0
  int frame = -1;                    // of the worst; -1: none
  std::vector<LimbNode> limbs = {};  // concerned in the worst
};
bool AllMet(const std::vector<RequirementCheck>& checks);
std::vector<RequirementCheck> CheckRequirements(const MeasureSubject& subject,
                                                const Metrics& metrics,
                                                const Requirements& requirements);

}  // namespace retarget::solver
