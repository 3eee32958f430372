#include "io/gltf/character.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "io/text/quoted.h"
#include "model/geometry/types.h"

namespace retarget::io {
namespace {

std::string Label(const std::string& name, const char* kind, int index) {
  return name.empty() ? fmt::format("{} {}", kind, index)
                      : fmt::format("{} {} \"{}\"", kind, index, Printable(name));
}

// The character of each skin, as the index of its first skin. Skins that share a joint are of one
// character, and so is a skin whose joints hang below another's.
std::vector<int> GroupSkins(const LoadedGltf& gltf, const std::string& name) {
  const tinygltf::Model& model = gltf.model;
  std::vector<int> group(model.skins.size());
  std::iota(group.begin(), group.end(), 0);
  const auto merge = [&](int a, int b) {
    const int from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
    if (from != to) std::replace(group.begin(), group.end(), from, to);
  };
  std::vector<int> skin_of_node(model.nodes.size(), -1), top(model.nodes.size(), -1);
  for (const int n : gltf.order) top[n] = gltf.parent[n] < 0 ? n : top[gltf.parent[n]];
  for (size_t s = 0; s < model.skins.size(); ++s) {
    const std::vector<int>& joints = model.skins[s].joints;
    for (const int joint : joints) {
      if (skin_of_node[joint] >= 0) merge(skin_of_node[joint], static_cast<int>(s));
      skin_of_node[joint] = static_cast<int>(s);
      if (top[joint] != top[joints[0]]) {
        throw InputError(fmt::format("{}: skins[{}]: its joints have no common root", name, s));
      }
    }
  }
  for (const int n : gltf.order) {
    if (gltf.parent[n] < 0 || skin_of_node[gltf.parent[n]] < 0) continue;
    if (skin_of_node[n] >= 0) merge(skin_of_node[n], skin_of_node[gltf.parent[n]]);
    skin_of_node[n] = skin_of_node[gltf.parent[n]];
  }
  return group;
}

// Of a skin: the joint that carries the others.
int TopJoint(const LoadedGltf& gltf, int skin) {
  const std::vector<int>& joints = gltf.model.skins[skin].joints;
  for (const int n : gltf.order) {
    if (std::find(joints.begin(), joints.end(), n) != joints.end()) return n;
  }
  return -1;
}

// "#figure=0 (Hips), #figure=1 (B_Hips)".
std::string FigureList(const LoadedGltf& gltf, const std::vector<int>& group) {
  std::string list;
  int number = 0;
  for (const int first : std::set<int>(group.begin(), group.end())) {
    const int top = TopJoint(gltf, first);
    list += fmt::format("{}#figure={}", number > 0 ? ", " : "", number);
    if (top >= 0) list += " (" + Printable(gltf.model.nodes[top].name) + ")";
    if (++number == 12) return list + ", ...";
  }
  return list;
}

int GroupOfFigure(const LoadedGltf& gltf, const std::vector<int>& group, const std::string& figure,
                  const std::string& name) {
  for (size_t s = 0; s < group.size(); ++s) {
    const int top = TopJoint(gltf, static_cast<int>(s));
    if (gltf.model.skins[s].name == figure || (top >= 0 && gltf.model.nodes[top].name == figure)) {
      return group[s];
    }
  }
  int number = 0;
  for (const int first : std::set<int>(group.begin(), group.end())) {
    if (std::to_string(number++) == figure) return first;
  }
  throw InputError(fmt::format("{}: no figure \"{}\", expected one of {}", name, Printable(figure),
                               FigureList(gltf, group)));
}

}  // namespace

std::vector<int> CharacterSkins(const LoadedGltf& gltf, const GltfSelect& select,
                                const std::vector<int>& humanoid, const std::string& name) {
  const std::vector<tinygltf::Skin>& skins = gltf.model.skins;
  const std::vector<int> group = GroupSkins(gltf, name);
  int wanted = -1;
  std::string list;
  std::set<int> groups(group.begin(), group.end());
  for (size_t s = 0; s < skins.size(); ++s) {
    list += (s > 0 ? ", " : "") + Label(skins[s].name, "skin", static_cast<int>(s));
    if (s == 11 && skins.size() > 12) {
      list += ", ...";
      break;
    }
  }
  if (!select.skin.empty()) {
    for (size_t s = 0; s < skins.size() && wanted < 0; ++s) {
      if (skins[s].name == select.skin) wanted = group[s];
    }
    for (size_t s = 0; s < skins.size() && wanted < 0; ++s) {
      if (std::to_string(s) == select.skin) wanted = group[s];
    }
    if (wanted < 0) {
      throw InputError(
          fmt::format("{}: no skin \"{}\", expected {}", name, Printable(select.skin),
                      skins.empty() ? "none: the file has no skin" : "one of " + list));
    }
  } else if (groups.size() == 1) {
    wanted = *groups.begin();
  } else if (groups.size() > 1 && !select.figure.empty()) {
    wanted = GroupOfFigure(gltf, group, select.figure, name);
  } else if (groups.size() > 1) {
    for (size_t s = 0; s < skins.size() && wanted < 0; ++s) {
      for (const int joint : skins[s].joints) {
        if (std::find(humanoid.begin(), humanoid.end(), joint) != humanoid.end()) wanted = group[s];
      }
    }
    if (wanted < 0) {
      throw InputError(fmt::format("{}: {} characters, select one by its skin: {}; or as {}", name,
                                   groups.size(), list, FigureList(gltf, group)));
    }
  }
  std::vector<int> out;
  for (size_t s = 0; s < skins.size(); ++s) {
    if (wanted >= 0 && group[s] == wanted) out.push_back(static_cast<int>(s));
  }
  return out;
}

}  // namespace retarget::io
