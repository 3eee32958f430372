// What is to be seen of a posture while it is made.
#pragma once

#include <string>
#include <vector>

#include "solver/optimizer/pose_solve.h"
#include "tools/report/report.h"

namespace retarget::posing {

// Two capsules that overlap, of one figure or of both.
struct LimbOverlap {
  solver::LimbPair limbs;
  double depth = 0;           // m
  Vec3 place = Vec3::Zero();  // m, in the middle of what both fill
};
// Deepest first; those within a figure over pairs at least two segments apart.
std::vector<LimbOverlap> OverlapsOf(const TemplatePosture& posture);

// |GLI| of every segment of a against every segment of b (turns); entry (i, j) belongs to the
// segments that end at nodes i + 1 and j + 1.
MatX GliTableOf(const TemplatePosture& posture);

// How far a joint lies beyond each of its limits (rad; negative: within).
std::vector<double> BeyondLimits(const TemplatePosture& posture, int figure, int link);

// The checks of `template --check`, and where bodies overlap by over 1 cm.
std::vector<std::string> WarningsOf(const TemplatePosture& posture, const Settings& settings = {});

// All of it: tags {a, b, gli, to_half, rho, group_size, requested, weak, can_slip}, those that the
// posture lists first, then those that are found; literal_tangles, overlaps, requirements,
// warnings, gli_table, beyond_limits_deg. `tags`, where given, receives all of them.
report::Json QueriesJson(const TemplatePosture& posture, std::vector<Tag>* tags = nullptr,
                         const Settings& settings = {});

// During a drag: tags, overlaps and warnings alone. Finding tags takes some 15 ms, so those that
// were found before it are measured anew (0.1 ms); what is tangled newly shows at its end.
report::Json LiveQueriesJson(const TemplatePosture& posture, const std::vector<Tag>& tags);
std::vector<Tag> Remeasured(const std::vector<Tag>& tags, const TemplatePosture& posture);

}  // namespace retarget::posing
