// Recognition; rig_measure.cc, rig_units.cc, t_pose.cc and map_report.cc do its parts.
#include "io/recognise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/joint_profiles.h"
#include "io/printable.h"
#include "io/rig_measure.h"
#include "io/rig_units.h"
#include "io/t_pose.h"

namespace retarget {
namespace {

// --- Which joint is which ---

std::string Quoted(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) {
    out += (out.empty() ? "'" : ", '") + Printable(name) + "'";
  }
  return out;
}

[[noreturn]] void RefuseFigure(const Rig& rig, const NameMatch& match, const std::string& file) {
  if (match.missing.empty()) {
    throw InputError(fmt::format("{}: no human figure: its names follow '{}', but {}", file,
                                 match.map.profile, Printable(match.misplaced.front())));
  }
  constexpr size_t kShown = 4;
  std::string missing, nearest;
  for (size_t n = 0; n < std::min(kShown, match.missing.size()); ++n) {
    missing += (n > 0 ? ", " : "") + match.missing[n];
  }
  if (match.missing.size() > kShown) {
    missing += fmt::format(" and {} more", match.missing.size() - kShown);
  }
  throw InputError(
      fmt::format("{}: no human figure: nothing plays {} (nearest convention '{}'); "
                  "the names nearest to {} are {}",
                  file, missing, match.map.profile, match.missing.front(),
                  Quoted(NearestNames(rig, match.missing.front(), match.map.profile))));
}

JointMap FindJoints(const RigMotion& motion, const std::vector<PosedRig>& poses,
                    const std::string& file, std::vector<std::string>* notes) {
  NameMatch match = MatchBestProfile(motion.rig);
  if (match.complete()) return match.map;
  std::optional<JointMap> map = MatchShape(motion.rig, poses);
  if (!map) RefuseFigure(motion.rig, match, file);
  notes->push_back("the joint names follow no known convention: joints were told by shape alone");
  return *map;
}

// --- Notes on the figure ---

void NoteUnequalSides(const std::vector<PosedRig>& poses, RigFacts* facts) {
  using Side = JointMap::Side;
  constexpr double kUnequal = 0.15;
  const std::tuple<const char*, int Side::*, int Side::*> bones[] = {
      {"upper arms", &Side::shoulder, &Side::elbow},
      {"forearms", &Side::elbow, &Side::wrist},
      {"thighs", &Side::hip, &Side::knee},
      {"shins", &Side::knee, &Side::ankle}};
  const JointMap& map = facts->map;
  for (const auto& [name, from, to] : bones) {
    const double left = MedianDistance(poses, map.left.*from, map.left.*to);
    const double right = MedianDistance(poses, map.right.*from, map.right.*to);
    if (std::abs(left - right) <= kUnequal * std::max(left, right)) continue;
    facts->notes.push_back(fmt::format("left and right {} differ: {:.3f} m and {:.3f} m", name,
                                       left * facts->metres_per_unit,
                                       right * facts->metres_per_unit));
  }
}

// Where the foot points, from the toe joint or the ankle's End Site; zero where neither is there.
Vec3 FootDirection(const Rig& rig, const PosedRig& pose, const JointMap::Side& side) {
  if (side.toe >= 0) return pose.position[side.toe] - pose.position[side.ankle];
  return pose.rotation[side.ankle] * rig.joints[side.ankle].end_site.value_or(Vec3::Zero());
}

// Left must be left of where the feet point, else the file may be mirrored or its names exchanged.
void NoteMirroring(const Rig& rig, const std::vector<PosedRig>& poses, RigFacts* facts) {
  const JointMap& map = facts->map;
  int right_way = 0, wrong_way = 0;
  for (const PosedRig& pose : poses) {
    const Vec3 forward = FootDirection(rig, pose, map.left) + FootDirection(rig, pose, map.right);
    const Vec3 across = pose.position[map.left.hip] - pose.position[map.right.hip];
    const double left = UpAxis(*facts).cross(forward).dot(across);
    if (left > 0) ++right_way;
    if (left < 0) ++wrong_way;
  }
  if (wrong_way > 4 * right_way) {
    facts->notes.push_back("left and right look exchanged: the file may be mirrored");
  }
}

}  // namespace

RigFacts Recognise(const RigMotion& motion, const RecogniseOptions& options,
                   const std::string& file_name) {
  if (motion.frames.empty() || motion.rig.joints.empty()) {
    throw InputError(file_name + ": no frames of any joint, expected a motion");
  }
  const std::vector<PosedRig> poses = SamplePoses(motion);
  RigFacts facts;
  facts.map = FindJoints(motion, poses, file_name, &facts.notes);
  FindUnit(RigStature(motion, poses, facts.map), options, file_name, &facts);
  FindUp(poses, options, file_name, &facts);
  NoteUnequalSides(poses, &facts);
  NoteMirroring(motion.rig, poses, &facts);
  facts.t_pose_frames = TPoseFrames(motion, facts);
  NoteTPose(motion, &facts);
  return facts;
}

}  // namespace retarget
