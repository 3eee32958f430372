// What a solved scene must show, checked against its metrics.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "model/settings.h"
#include "solver/metrics/metrics.h"
#include "solver/metrics/term_gradient.h"

namespace retarget::solver {

// What is required, and in which unit its value and limit are.
enum class RequirementKind {
  kTangle,              // turns, of a tag: s GLI stays above the limit
  kPassThroughs,        // count
  kPenetration,         // m, between the bodies
  kPenetrationOver1cm,  // % of frames
  kFootDrift,           // m, of a figure
  kFootTravel,          // m, of a figure: over the floor, outside contacts
  kFootAcceleration,    // m/s^2, of a figure: where contacts begin and end
  kFloor,               // m, of a figure
  kHold,                // m, of a hold
  kSegmentLength,       // %, of a figure as it is written
  kWriteBack,           // m, of a figure's own rig as it is written
  // What no result may ask of a person (plausible.*), of a figure:
  kPoseError,   // m, from its clip
  kTrunkTilt,   // deg, from its clip, of a figure that is not carried
  kFloating,    // m, likewise
  kJointLimit,  // deg, beyond a joint's range
  kJerk         // times its own clip's
};

// YAML key of the term that works for a requirement; empty where none does.
std::string TermOf(RequirementKind kind);

// A requirement, whether it is met, and where it is worst.
struct RequirementCheck {
  RequirementKind kind = RequirementKind::kTangle;
  int item = -1;     // tag or hold, from 0; -1: it is about neither
  int figure = -1;   // 0 or 1; -1: about both
  double value = 0;  // NaN: there was nothing to judge
  double limit = 0;
  bool met = true;  // also where there was nothing to judge
  bool judged() const { return !std::isnan(value); }
  int frame = -1;                    // of the worst; -1: none
  std::vector<LimbNode> limbs = {};  // concerned in the worst
  std::string file = {};             // that a write-back was read from, where it was
  std::optional<double> bound = {};  // proved for every instant (solver/proof); nothing: it is not
};
bool AllMet(const std::vector<RequirementCheck>& checks);

// Of the motion.
std::vector<RequirementCheck> CheckRequirements(const MetricsContext& subject,
                                                const Metrics& metrics,
                                                const Requirements& requirements);

// Of what is written: `write_back_m` is the distance of each figure's own rig to the scene.
std::vector<RequirementCheck> CheckWritten(const Metrics& metrics,
                                           const std::array<double, 2>& write_back_m,
                                           const Requirements& requirements);

}  // namespace retarget::solver
