#include "tools/report/requirement_text.h"

#include <fmt/format.h>

#include "tools/report/report.h"

namespace retarget::report {
namespace {

using Kind = solver::RequirementKind;

// What a kind is called in names, where its number or figure follows.
const char* WordsOf(Kind kind) {
  switch (kind) {
    case Kind::kTangle:
      return "tangle";
    case Kind::kPassThroughs:
      return "pass-throughs";
    case Kind::kPenetration:
      return "penetration";
    case Kind::kPenetrationOver1cm:
      return "penetration over 1 cm";
    case Kind::kFootDrift:
      return "foot drift";
    case Kind::kFootTravel:
      return "foot travel";
    case Kind::kFootAcceleration:
      return "foot acceleration";
    case Kind::kFloor:
      return "floor";
    case Kind::kHold:
      return "hold";
    case Kind::kSegmentLength:
      return "segment lengths";
    case Kind::kWriteBack:
      return "write-back";
    case Kind::kPoseError:
      return "plausible.pose_error";
    case Kind::kTrunkTilt:
      return "plausible.trunk_tilt";
    case Kind::kFloating:
      return "plausible.floating";
    case Kind::kJointLimit:
      return "plausible.joint_limit";
    case Kind::kJerk:
      return "plausible.jerk";
  }
  return "";
}

}  // namespace

const char* KindName(Kind kind) {
  switch (kind) {
    case Kind::kTangle:
      return "tangle";
    case Kind::kPassThroughs:
      return "pass_throughs";
    case Kind::kPenetration:
      return "penetration";
    case Kind::kPenetrationOver1cm:
      return "penetration_over_1cm";
    case Kind::kFootDrift:
      return "foot_drift";
    case Kind::kFootTravel:
      return "foot_travel";
    case Kind::kFootAcceleration:
      return "foot_acceleration";
    case Kind::kFloor:
      return "floor";
    case Kind::kHold:
      return "hold";
    case Kind::kSegmentLength:
      return "segment_length";
    case Kind::kWriteBack:
      return "write_back";
    case Kind::kPoseError:
    case Kind::kTrunkTilt:
    case Kind::kFloating:
    case Kind::kJointLimit:
    case Kind::kJerk:
      return WordsOf(kind);
  }
  return "";
}

std::string NameOf(const solver::RequirementCheck& check) {
  const char* name = WordsOf(check.kind);
  if (check.item >= 0) return fmt::format("{} {}", name, check.item + 1);
  return check.figure < 0 ? name : fmt::format("{} {}", name, kFigure[check.figure]);
}

const char* UnitOf(Kind kind) {
  switch (kind) {
    case Kind::kTangle:
      return "turns";
    case Kind::kPassThroughs:
      return "";
    case Kind::kPenetrationOver1cm:
      return "% of frames";
    case Kind::kSegmentLength:
      return "%";
    case Kind::kPenetration:
    case Kind::kFootDrift:
    case Kind::kFootTravel:
    case Kind::kFloor:
    case Kind::kHold:
    case Kind::kWriteBack:
    case Kind::kPoseError:
    case Kind::kFloating:
      return "m";
    case Kind::kTrunkTilt:
    case Kind::kJointLimit:
      return "deg";
    case Kind::kJerk:
      return "x";
    case Kind::kFootAcceleration:
      return "m/s^2";
  }
  return "";
}

std::string WorstPlace(const solver::RequirementCheck& check, const std::array<Body, 2>& body) {
  const std::string frame = check.frame < 0 ? "" : fmt::format("frame {}", check.frame);
  const auto node = [&](size_t k) {
    return body[check.limbs[k].figure].nodes[check.limbs[k].node].name;
  };
  const auto pair = [&](const char* between) {
    return check.limbs.size() < 2
               ? frame
               : fmt::format("{}, a {} {} b {}", frame, node(0), between, node(1));
  };
  switch (check.kind) {
    case Kind::kTangle:
      return fmt::format("{}, {}", TagText(check.limbs, body), frame);
    case Kind::kPassThroughs:
      return pair("through");
    case Kind::kPenetration:
      return pair("in");
    case Kind::kFootTravel:
    case Kind::kFootAcceleration:
    case Kind::kPoseError:
    case Kind::kTrunkTilt:
    case Kind::kFloating:
    case Kind::kJointLimit:
    case Kind::kJerk:
      return check.limbs.empty() ? frame : fmt::format("{}, {}", frame, node(0));
    case Kind::kFootDrift:
    case Kind::kHold:
      return frame;
    case Kind::kWriteBack:
      return check.file;
    case Kind::kPenetrationOver1cm:
    case Kind::kFloor:
    case Kind::kSegmentLength:
      return "";
  }
  return "";
}

std::string TagText(const std::vector<solver::LimbNode>& limbs, const std::array<Body, 2>& body) {
  return TangleText(body[0], body[1],
                    {{limbs[0].node, limbs[1].node}, {limbs[2].node, limbs[3].node}});
}

std::string LimbName(const solver::LimbNode& limb, const std::array<Body, 2>& body) {
  return fmt::format("{} {}", kFigure[limb.figure], body[limb.figure].nodes[limb.node].name);
}

}  // namespace retarget::report
