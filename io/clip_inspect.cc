#include "io/clip_inspect.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/clip_file.h"
#include "io/gltf/container.h"
#include "io/text/quoted.h"

namespace retarget::io {
namespace {

constexpr size_t kMostNames = 20;

// Names of an array's items in a glTF document; the index where an item has none.
std::string NamesIn(const nlohmann::json& document, const char* key) {
  if (!document.contains(key)) return "none";
  std::string out = std::to_string(document.at(key).size());
  size_t k = 0;
  for (const auto& item : document.at(key)) {
    if (k == kMostNames) return out + ", ...";
    const std::string name = item.is_object() ? item.value("name", "") : "";
    out += fmt::format("{}{}{}", k == 0 ? ": " : ", ", k,
                       name.empty() ? "" : " \"" + Printable(name) + "\"");
    ++k;
  }
  return out;
}

void AddGltf(const GltfClip& clip, std::vector<NamedFact>* facts) {
  const auto document =
      nlohmann::json::parse(SplitGltf(clip.bytes, clip.name).json, nullptr, false);
  if (!document.is_object()) return;
  for (const char* key : {"animations", "skins", "meshes", "materials", "images"}) {
    facts->push_back({key, NamesIn(document, key)});
  }
  std::string extensions;
  for (const auto& extension : document.value("extensionsUsed", nlohmann::json::array())) {
    if (extension.is_string())
      extensions += (extensions.empty() ? "" : ", ") + extension.get<std::string>();
  }
  if (!extensions.empty()) facts->push_back({"extensions", Printable(extensions)});
}

// Of several animations none has to be chosen just to look.
ClipFile ReadToInspect(const std::string& text) {
  ClipPath path = ParseClipPath(text);
  try {
    return ReadClipFile(path);
  } catch (const InputError&) {
    if (!path.select.animation.empty() || !path.skeleton.empty()) throw;
    path.select.at_rest = true;
    return ReadClipFile(path);
  }
}

}  // namespace

std::vector<NamedFact> InspectClip(const std::string& text) {
  const ClipFile clip = ReadToInspect(text);
  const RigMotion& motion = clip.motion;
  std::vector<NamedFact> facts = {{"format", clip.format}};
  if (const auto* gltf = std::get_if<GltfClip>(&clip.original)) AddGltf(*gltf, &facts);
  facts.push_back({"bytes", std::to_string(clip.bytes.size())});
  facts.push_back({"joints", std::to_string(motion.rig.num_joints())});
  std::string roots;
  for (const RigJoint& joint : motion.rig.joints) {
    if (joint.parent < 0) roots += (roots.empty() ? "" : ", ") + Printable(joint.name);
  }
  facts.push_back({"roots", roots});
  std::string figures;
  for (const std::string& figure : clip.figures) {
    figures += (figures.empty() ? "" : ", ") + Printable(figure);
  }
  if (!figures.empty()) facts.push_back({"figures", figures});
  const auto count = [&](auto predicate) {
    return std::to_string(
        std::count_if(motion.rig.joints.begin(), motion.rig.joints.end(), predicate));
  };
  facts.push_back({"moving joints", count([](const RigJoint& j) { return j.translates; })});
  facts.push_back({"joints of few axes", count([](const RigJoint& j) { return !j.turns_freely; })});
  if (clip.has_motion) {
    facts.push_back({"frames", fmt::format("{} at {:.6g} per second, {:.3f} s", motion.num_frames(),
                                           1 / motion.frame_time,
                                           (motion.num_frames() - 1) * motion.frame_time)});
  } else {
    facts.push_back({"frames", "none read: a character at rest"});
  }
  for (const std::string& note : clip.notes) facts.push_back({"note", note});
  return facts;
}

}  // namespace retarget::io
