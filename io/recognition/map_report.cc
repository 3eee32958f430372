// MapTable and MapJson of io/recognition/recognise.h.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "io/recognition/map_joints.h"
#include "io/recognition/recognise.h"
#include "io/text/quoted.h"

namespace retarget::io {
namespace {

std::vector<bool> MappedJoints(const RigMotion& motion, const JointMap& map) {
  std::vector<bool> mapped(motion.rig.joints.size(), false);
  const auto mark = [&](int joint) {
    if (joint >= 0) mapped[joint] = true;
  };
  for (const auto& [name, joint] : NamedJoints(map, ChestBone(motion, map))) mark(joint);
  for (int joint : map.spine) mark(joint);
  for (int joint : map.neck) mark(joint);
  return mapped;
}

std::vector<std::string> UnmappedNames(const RigMotion& motion, const JointMap& map) {
  const std::vector<bool> mapped = MappedJoints(motion, map);
  std::vector<std::string> names;
  for (size_t j = 0; j < mapped.size(); ++j) {
    if (!mapped[j]) names.push_back(motion.rig.joints[j].name);
  }
  return names;
}

std::string BoneList(const RigMotion& motion, const std::vector<int>& bones) {
  std::string out;
  for (int bone : bones) {
    out += (out.empty() ? "" : ", ") + Printable(motion.rig.joints[bone].name);
  }
  return out;
}

std::string List(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + Printable(name);
  return out;
}

double Degrees(double angle) { return std::round(angle / kDegree * 10) / 10 + 0.0; }

}  // namespace

std::string MapTable(const RigFacts& facts, const RigMotion& motion,
                     const std::vector<std::string>& figures) {
  std::string out;
  const auto row = [&](std::string_view key, const std::string& value) {
    if (!value.empty()) out += fmt::format("{:<16}{}\n", key, value);
  };
  std::string listed;
  for (size_t n = 0; n < figures.size(); ++n) {
    listed += fmt::format("{}{} {}", n > 0 ? ", " : "", n, Printable(figures[n]));
  }
  row("figures", listed);
  row("profile", facts.map.profile);
  row("confidence", fmt::format("{:.2f}", facts.confidence));
  row("units", fmt::format("{} ({:.6g} m)", facts.unit_name, facts.metres_per_unit));
  row("up", std::string(1, facts.up));
  row("facing", fmt::format("{:.0f} degrees about up from +Z, standing", Degrees(facts.facing)));
  row("stature", fmt::format("{:.2f} m", facts.stature));
  row("frames", fmt::format("{} at {:.6g} per second", motion.num_frames(), 1 / motion.frame_time));
  const auto& t_pose = facts.t_pose_frames;
  row("T-pose", t_pose.empty()       ? ""
                : t_pose.size() == 1 ? fmt::format("frame {}", t_pose.front())
                                     : fmt::format("frames {}-{}", t_pose.front(), t_pose.back()));
  for (const auto& [name, joint] : NamedJoints(facts.map, ChestBone(motion, facts.map))) {
    if (joint >= 0) row(name, Printable(motion.rig.joints[joint].name));
  }
  row("spine bones", BoneList(motion, facts.map.spine));
  row("neck bones", BoneList(motion, facts.map.neck));
  row("virtual", List(facts.virtual_joints));
  row("unmapped", List(UnmappedNames(motion, facts.map)));
  for (const std::string& note : facts.notes) row("note", note);
  return out;
}

std::string MapJson(const RigFacts& facts, const RigMotion& motion,
                    const std::vector<std::string>& figures) {
  nlohmann::ordered_json json;
  json["profile"] = facts.map.profile;
  json["confidence"] = std::round(facts.confidence * 1e3) / 1e3;
  json["units"] = facts.metres_per_unit;
  json["unit_name"] = facts.unit_name;
  json["up"] = std::string(1, facts.up);
  json["facing_deg"] = Degrees(facts.facing);
  json["stature_m"] = std::round(facts.stature * 1e4) / 1e4;
  json["frames"] = motion.num_frames();
  json["fps"] = std::round(1e6 / motion.frame_time) / 1e6;
  json["joints"] = nlohmann::ordered_json::object();
  for (const auto& [name, joint] : NamedJoints(facts.map, ChestBone(motion, facts.map))) {
    if (joint >= 0) json["joints"][name] = motion.rig.joints[joint].name;
  }
  json["virtual"] = facts.virtual_joints;
  json["unmapped"] = UnmappedNames(motion, facts.map);
  json["t_pose_frames"] = facts.t_pose_frames;
  json["notes"] = facts.notes;
  json["figures"] = figures;
  // Names need not be UTF-8; what is not is replaced.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace retarget::io
