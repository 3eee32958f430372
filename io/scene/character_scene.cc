#include "io/scene/character_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <set>

#include "io/gltf/copy.h"

namespace retarget::io {
namespace {

using nlohmann::json;

constexpr const char* kMotionName = "retargeted";  // of the animation in between

// Copies the channels of an animation that move kept nodes. `keys` is the accessor of the key
// times, the source's own where it is -1.
void CopyChannels(const json& from, const std::vector<int>& new_node, int keys, GltfCopier* copier,
                  json* to) {
  for (json channel : from["channels"]) {
    json& target = channel["target"];
    const int node = target.contains("node") ? new_node[target["node"].get<size_t>()] : -1;
    if (node < 0 || target["path"] == "scale") continue;
    target["node"] = node;
    json sampler = from["samplers"][channel["sampler"].get<size_t>()];
    sampler["input"] = keys >= 0 ? keys : copier->CopyAccessor(sampler["input"]);
    sampler["output"] = copier->CopyAccessor(sampler["output"]);
    channel["sampler"] = (*to)["samplers"].size();
    (*to)["channels"].push_back(std::move(channel));
    (*to)["samplers"].push_back(std::move(sampler));
  }
}

// The scene without the meshes of some figures becomes the target. Returns the accessor of the key
// times.
int CopyScene(const GltfSource& scene, const std::set<std::string>& hidden_nodes,
              GltfTarget* target) {
  const json& nodes = scene.document["nodes"];
  std::vector<bool> kept(nodes.size());
  for (size_t n = 0; n < kept.size(); ++n) {
    kept[n] = !hidden_nodes.contains(nodes[n].value("name", ""));
  }
  GltfCopier copier(scene, target);
  const std::vector<int> new_node = copier.CopyNodes(kept);
  target->document["asset"] = scene.document["asset"];
  target->document["scene"] = 0;
  json roots = json::array();
  for (const json& root : scene.document["scenes"][0]["nodes"]) {
    const int node = new_node[root.get<size_t>()];
    if (node >= 0) roots.push_back(node);
  }
  target->document["scenes"][0]["nodes"] = std::move(roots);
  const json& animation = scene.document["animations"][0];
  json copy = {{"channels", json::array()}, {"samplers", json::array()}};
  if (animation.contains("name")) copy["name"] = animation["name"];
  CopyChannels(animation, new_node, -1, &copier, &copy);
  const int keys = copy["samplers"][0]["input"];
  target->document["animations"][0] = std::move(copy);
  return keys;
}

// Which nodes of a file its default scene shows: those below the scene's roots, or all where the
// file has no scene or shows the character in another one. [nodes]
std::vector<bool> ShownNodes(const GltfSource& source, int character_node) {
  std::vector<bool> shown(source.gltf.parent.size(), false);
  const json scenes = source.document.value("scenes", json::array());
  const json index = source.document.value("scene", json(0));
  const size_t scene = index.is_number_unsigned() ? index.get<size_t>() : 0;
  if (scenes.is_array() && scene < scenes.size() && scenes[scene].is_object()) {
    for (const json& root : scenes[scene].value("nodes", json::array())) {
      if (root.is_number_unsigned() && root.get<size_t>() < shown.size()) {
        shown[root.get<size_t>()] = true;
      }
    }
  }
  for (const int n : source.gltf.order) {
    if (source.gltf.parent[n] >= 0) shown[n] = shown[n] || shown[source.gltf.parent[n]];
  }
  if (!shown[character_node]) shown.assign(shown.size(), true);
  return shown;
}

// What of a file belongs to its selected character: the joints and what hangs from them, the meshes
// of its skins, and all that these hang from. Meshes of anybody else are erased. [nodes]
std::vector<bool> CharacterNodes(const GltfClip& clip, GltfSource* source) {
  const LoadedGltf& gltf = source->gltf;
  const std::vector<bool> shown = ShownNodes(*source, clip.joints[0].node);
  std::vector<bool> kept(gltf.parent.size(), false), below(kept);
  for (const GltfJoint& joint : clip.joints) below[joint.node] = true;
  bool has_mesh = false;
  for (const int n : gltf.order) {
    if (gltf.parent[n] >= 0) below[n] = below[n] || below[gltf.parent[n]];
    const tinygltf::Node& node = gltf.model.nodes[n];
    const bool own_skin =
        std::find(clip.skins.begin(), clip.skins.end(), node.skin) != clip.skins.end();
    const bool own_mesh = node.mesh >= 0 && (node.skin >= 0 ? own_skin && shown[n] : below[n]);
    kept[n] = below[n] || own_mesh;
    has_mesh = has_mesh || own_mesh;
    if (own_mesh) continue;
    json& object = source->document["nodes"][n];
    for (const char* key : {"mesh", "skin", "weights"}) object.erase(key);
  }
  if (!has_mesh) throw InputError(clip.name + ": no mesh of the character, expected one to show");
  for (auto it = gltf.order.rbegin(); it != gltf.order.rend(); ++it) {
    if (kept[*it] && gltf.parent[*it] >= 0) kept[gltf.parent[*it]] = true;
  }
  return kept;
}

// Gives the kept nodes unique names that begin with `prefix`.
void NameNodes(const GltfClip& clip, const std::string& prefix, const std::vector<bool>& kept,
               json* nodes) {
  std::set<std::string> taken;
  std::vector<bool> named(kept.size(), false);
  for (size_t j = 0; j < clip.joints.size(); ++j) {
    const std::string& name = clip.motion.rig.joints[j].name;
    (*nodes)[clip.joints[j].node]["name"] = prefix + name;
    named[clip.joints[j].node] = true;
    taken.insert(name);
  }
  for (size_t n = 0; n < kept.size(); ++n) {
    if (!kept[n] || named[n]) continue;
    std::string name = (*nodes)[n].value("name", "");
    if (name.empty() || taken.contains(name)) {
      name = fmt::format("{}_{}", name.empty() ? "node" : name, n);
    }
    while (!taken.insert(name).second) name += "_";
    (*nodes)[n]["name"] = prefix + name;
  }
}

// Attribution goes along with what it is about.
void AddCopyright(const json& from, json* asset) {
  const auto line = from.find("copyright");
  if (line == from.end() || !line->is_string() || line->get<std::string>().empty()) return;
  std::string all = asset->value("copyright", "");
  const std::string own = *line;
  if (all.find(own) != std::string::npos) return;
  (*asset)["copyright"] = all.empty() ? own : all + "; " + own;
}

void AddCharacter(const SceneCharacter& character, const std::string& prefix, int keys,
                  GltfTarget* target, std::vector<std::string>* notes) {
  const GltfClip& clip = *character.clip;
  GltfSource source(FormatGltf(clip, *character.motion, 0, kMotionName), clip.name, clip.folder);
  const std::vector<bool> kept = CharacterNodes(clip, &source);
  json& nodes = source.document["nodes"];
  NameNodes(clip, prefix, kept, &nodes);
  for (const GltfJoint& joint : clip.joints) {
    if (joint.scale == joint.rest_scale) continue;
    nodes[joint.node]["scale"] = {joint.scale.x(), joint.scale.y(), joint.scale.z()};
  }
  GltfCopier copier(source, target);
  const std::vector<int> new_node = copier.CopyNodes(kept);
  json& document = target->document;
  for (size_t n = 0; n < kept.size(); ++n) {
    if (kept[n] && source.gltf.parent[n] < 0) document["scenes"][0]["nodes"].push_back(new_node[n]);
  }
  const json& animations = source.document["animations"];
  const auto motion = std::find_if(animations.begin(), animations.end(), [](const json& a) {
    return a.contains("name") && a["name"] == kMotionName;
  });
  CopyChannels(*motion, new_node, keys, &copier, &document["animations"][0]);
  AddCopyright(source.document["asset"], &document["asset"]);
  if (notes == nullptr) return;
  notes->insert(notes->end(), copier.missing().begin(), copier.missing().end());
  if (!copier.left_out().empty()) {
    notes->push_back(fmt::format("{}: extensions left out of the scene: {}", clip.name,
                                 fmt::join(copier.left_out(), ", ")));
  }
}

}  // namespace

std::string FormatCharacterScene(const std::string& scene_glb,
                                 const std::array<const SceneCharacter*, 2>& characters,
                                 std::vector<std::string>* notes) {
  constexpr const char* kFigures[] = {"a", "b"};
  const GltfSource scene(scene_glb, "the scene", "");
  std::set<std::string> hidden;
  for (int f = 0; f < 2; ++f) {
    if (characters[f] != nullptr) hidden.insert(std::string(kFigures[f]) + " mesh");
  }
  GltfTarget target;
  const int keys = CopyScene(scene, hidden, &target);
  for (int f = 0; f < 2; ++f) {
    if (characters[f] == nullptr) continue;
    assert(target.document["accessors"][keys]["count"] == characters[f]->motion->num_frames());
    AddCharacter(*characters[f], std::string(kFigures[f]) + " character/", keys, &target, notes);
  }
  return target.Finish();
}

}  // namespace retarget::io
