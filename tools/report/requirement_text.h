// Requirements by name and in words.
#pragma once

#include <array>
#include <string>

#include "solver/metrics/requirements.h"

namespace retarget::report {

// "penetration_over_1cm": as report.json has it.
const char* KindName(solver::RequirementKind kind);
// "tangle 1", "foot drift a".
std::string NameOf(const solver::RequirementCheck& check);
// "turns", "m", "%", "% of frames"; empty for counts.
const char* UnitOf(solver::RequirementKind kind);
// "frame 12, a left_elbow in b neck"; empty where there is no one place.
std::string WorstPlace(const solver::RequirementCheck& check, const std::array<Body, 2>& body);
// Of the four limbs that a requirement or a finding about a tag names: "a (left_hand, right_hand) x
// b (neck, root)".
std::string TagText(const std::vector<solver::LimbNode>& limbs, const std::array<Body, 2>& body);
// "a left_hand"
std::string LimbName(const solver::LimbNode& limb, const std::array<Body, 2>& body);

}  // namespace retarget::report
