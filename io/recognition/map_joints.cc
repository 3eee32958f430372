#include "io/recognition/map_joints.h"

#include "io/recognition/recognise.h"

namespace retarget::io {

std::vector<std::pair<std::string, int>> NamedJoints(const JointMap& map, int chest_bone) {
  const bool waist = !map.spine.empty() && map.spine.front() != chest_bone;
  std::vector<std::pair<std::string, int>> out = {
      {"root", map.root},    {"waist", waist ? map.spine.front() : -1},
      {"chest", chest_bone}, {"neck", map.neck.empty() ? -1 : map.neck.front()},
      {"head", map.head},    {"head_top", map.head_top}};
  for (const auto& [prefix, side] : {std::pair("left_", &map.left), {"right_", &map.right}}) {
    for (const SidePart& part : kSideParts) {
      out.emplace_back(std::string(prefix) + part.name, side->*part.joint);
    }
  }
  return out;
}

std::vector<std::string> VirtualJoints(const RigMeasure& figure) {
  const RigPoint& chest = figure.points.chest;
  std::vector<std::string> names;
  for (const auto& [name, joint] : NamedJoints(figure.map, chest.is_joint() ? chest.joint : -1)) {
    const bool end = name == "head_top" || name.ends_with("_hand") || name.ends_with("_toe");
    if (joint < 0 && !end) names.push_back(name);
  }
  return names;
}

}  // namespace retarget::io
