// Requirements in report.json, written and read back.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/metrics/requirements.h"
#include "tools/report/report.h"

namespace retarget::report {

Json ChecksJson(const std::vector<solver::RequirementCheck>& checks,
                const std::array<Body, 2>& body);
// [{figure: "a", node: "left_hand"}].
Json LimbsJson(const std::vector<solver::LimbNode>& limbs, const std::array<Body, 2>& body);
// kind, item, figure and frame of a check; null for what it has not.
void AddPlace(const solver::RequirementCheck& check, Json* to);

// One requirement of a report. What the report lacks keeps its default.
struct ReadRequirement {
  std::optional<solver::RequirementKind> kind;  // nothing: of another version
  int item = -1, figure = -1, frame = -1;       // -1: none
  double value = std::numeric_limits<double>::quiet_NaN();
  double limit = std::numeric_limits<double>::quiet_NaN();
  bool met = true;
  std::string name, unit, where;

  bool Is(solver::RequirementKind k) const { return kind == k; }
};
// Both throw nlohmann::json::exception where that is no list of requirements.
// Older reports have no `kind`: there it is taken from the name, and the frame from `where`.
ReadRequirement RequirementFromJson(const Json& check);
std::vector<ReadRequirement> RequirementsOf(const Json& report);

// The limit of the first requirement of that kind, and of that figure and item where they are
// given (not -1); NaN where there is none.
double LimitOf(const std::vector<ReadRequirement>& requirements, solver::RequirementKind kind,
               int figure = -1, int item = -1);

}  // namespace retarget::report
