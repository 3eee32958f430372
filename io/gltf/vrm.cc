#include "io/gltf/vrm.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "io/text/quoted.h"

namespace retarget::io {
namespace {

using nlohmann::json;

const json* Member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto it = object.find(key);
  return it == object.end() ? nullptr : &*it;
}

}  // namespace

VrmBones ReadVrmBones(const std::string& extensions, int num_nodes, const std::string& name) {
  const json document = json::parse(extensions);
  VrmBones out;
  std::set<int> taken;
  const auto add = [&](const std::string& extension, const std::string& bone, const json* node) {
    const auto fail = [&](const std::string& what) {
      throw InputError(
          fmt::format("{}: {}: bone \"{}\": {}", name, extension, Printable(bone), what));
    };
    if (node == nullptr || !node->is_number_unsigned() ||
        node->get<std::uint64_t>() >= static_cast<std::uint64_t>(num_nodes)) {
      fail(fmt::format("expected one of {} nodes", num_nodes));
    }
    const int index = node->get<int>();
    if (!out.node.emplace(bone, index).second) fail("it is there twice");
    if (!taken.insert(index).second) fail(fmt::format("node {} is another bone already", index));
  };
  for (const char* key : {"VRMC_vrm", "VRMC_vrm_animation", "VRM"}) {
    const json* extension = Member(document, key);
    const json* humanoid = extension ? Member(*extension, "humanoid") : nullptr;
    const json* bones = humanoid ? Member(*humanoid, "humanBones") : nullptr;
    if (bones == nullptr) continue;
    out.is_animation = key == std::string_view("VRMC_vrm_animation");
    if (bones->is_object()) {
      for (const auto& [bone, value] : bones->items()) add(key, bone, Member(value, "node"));
    } else if (bones->is_array()) {
      out.faces_minus_z = true;
      for (const json& value : *bones) {
        const json* bone = Member(value, "bone");
        const json* node = Member(value, "node");
        // Exporters write -1 for a bone that the model does not have.
        if (node != nullptr && node->is_number_integer() && node->get<std::int64_t>() == -1) {
          continue;
        }
        add(key, bone && bone->is_string() ? bone->get<std::string>() : "", node);
      }
    }
    break;
  }
  return out;
}

JointMap MapOfVrmBones(const VrmBones& bones, const std::vector<int>& joint_of_node) {
  const auto joint = [&](const std::string& bone) {
    const auto it = bones.node.find(bone);
    return it == bones.node.end() ? -1 : joint_of_node[static_cast<size_t>(it->second)];
  };
  JointMap map;
  map.profile = "vrm";
  map.root = joint("hips");
  for (const char* bone : {"spine", "chest", "upperChest"}) {
    if (joint(bone) >= 0) map.spine.push_back(joint(bone));
  }
  if (joint("neck") >= 0) map.neck.push_back(joint("neck"));
  map.head = joint("head");
  for (const std::string side : {"left", "right"}) {
    JointMap::Side& s = side == "left" ? map.left : map.right;
    s.clavicle = joint(side + "Shoulder");
    s.shoulder = joint(side + "UpperArm");
    s.elbow = joint(side + "LowerArm");
    s.wrist = joint(side + "Hand");
    s.hand = joint(side + "MiddleProximal");
    s.hip = joint(side + "UpperLeg");
    s.knee = joint(side + "LowerLeg");
    s.ankle = joint(side + "Foot");
    s.toe = joint(side + "Toes");
  }
  return map;
}

}  // namespace retarget::io
