// Reading; map_write.cc writes.
#include "io/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "io/recognition/map_joints.h"
#include "io/recognition/recognise.h"
#include "io/text/nearest_name.h"
#include "io/text/quoted.h"
#include "io/text/yaml.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

constexpr size_t kNearestShown = 3;

class MapReader {
 public:
  explicit MapReader(const Rig& rig) : rig_(rig), joint_of_(rig.joints.size()) {}

  JointMap Read(const Value& joints) {
    std::vector<std::string> known = {"root", "spine", "neck", "head", "head_top"};
    for (const char* side : {"left_", "right_"}) {
      for (const SidePart& part : kSideParts) known.push_back(std::string(side) + part.name);
    }
    joints.CheckKeys(known);
    JointMap map;
    map.profile = "by hand";
    map.root = ReadJoint(joints, "root", true, -1);
    map.spine = ReadChain(joints, "spine", map.root);
    const int trunk = map.spine.empty() ? map.root : map.spine.back();
    map.neck = ReadChain(joints, "neck", trunk);
    const int neck = map.neck.empty() ? trunk : map.neck.back();
    map.head = ReadJoint(joints, "head", false, neck);
    map.head_top = ReadJoint(joints, "head_top", false, map.head >= 0 ? map.head : neck);
    map.left = ReadSide(joints, "left_", map.root);
    map.right = ReadSide(joints, "right_", map.root);
    return map;
  }

 private:
  JointMap::Side ReadSide(const Value& joints, const std::string& prefix, int root) {
    JointMap::Side side;
    int above = root;
    for (const SidePart& part : kSideParts) {
      if (part.joint == &JointMap::Side::hip) above = root;
      if (part.joint == &JointMap::Side::ankle) above = -1;  // feet may hang from a master bone
      int& joint = side.*part.joint;
      joint = ReadJoint(joints, prefix + part.name, part.required, above);
      if (joint >= 0) above = joint;
    }
    // Ends of a limb whose last joint is missing would hang from the wrong one.
    if (side.wrist < 0) side.hand = -1;
    if (side.ankle < 0) side.toe = -1;
    return side;
  }

  int ReadJoint(const Value& joints, const std::string& name, bool required, int above) {
    const auto value = joints.Find(name);
    if (!value) {
      if (required) joints.Require(name);
      return -1;
    }
    if (value->kind() == Value::Kind::kScalar && value->text() == "none") {
      if (required) value->Refuse("expected a bone, found none: this joint cannot be virtual");
      return -1;
    }
    return ReadBone(*value, above);
  }

  std::vector<int> ReadChain(const Value& joints, const std::string& name, int above) {
    std::vector<int> chain;
    const auto value = joints.Find(name);
    if (!value) return chain;
    if (value->kind() != Value::Kind::kList) {
      const int bone = ReadJoint(joints, name, false, above);
      if (bone >= 0) chain.push_back(bone);
      return chain;
    }
    for (const Value& item : value->Items()) {
      chain.push_back(ReadBone(item, above));
      above = chain.back();
    }
    return chain;
  }

  // A bone by name, or by "#12", its place in the file from 0; it must hang from `above`.
  int ReadBone(const Value& value, int above) {
    if (value.kind() != Value::Kind::kScalar) value.RefuseExpecting("the name of a bone");
    const int bone = value.text().starts_with("#") ? NumberedBone(value) : NamedBone(value);
    const auto b = static_cast<size_t>(bone);
    if (!joint_of_[b].empty()) {
      value.Refuse(fmt::format("{} plays {} already", Quoted(value.text()), joint_of_[b]));
    }
    joint_of_[b] = value.path();
    if (above >= 0 && (bone == above || !DescendsFrom(rig_, bone, above))) {
      value.Refuse(fmt::format("{} does not hang from {}", Quoted(value.text()),
                               Quoted(rig_.joints[static_cast<size_t>(above)].name)));
    }
    return bone;
  }

  int NumberedBone(const Value& value) const {
    int number = -1;
    const char* end = value.text().data() + value.text().size();
    const auto [stop, error] = std::from_chars(value.text().data() + 1, end, number);
    if (error != std::errc() || stop != end || number < 0 || number >= rig_.num_joints()) {
      value.Refuse(
          fmt::format("expected #0 to #{}, found {}", rig_.num_joints() - 1, Quoted(value.text())));
    }
    return number;
  }

  int NamedBone(const Value& value) const {
    const int bone = rig_.Find(value.text());
    if (bone < 0) value.Refuse("no bone " + Quoted(value.text()) + Nearest(value.text()));
    for (int j = bone + 1; j < rig_.num_joints(); ++j) {
      if (rig_.joints[static_cast<size_t>(j)].name != value.text()) continue;
      value.Refuse(fmt::format("several bones are called {}: give \"#{}\" or \"#{}\"",
                               Quoted(value.text()), bone, j));
    }
    return bone;
  }

  std::string Nearest(const std::string& name) const {
    std::vector<std::pair<size_t, std::string>> ranked;
    for (const RigJoint& joint : rig_.joints) {
      ranked.emplace_back(EditDistance(name, joint.name), joint.name);
    }
    std::sort(ranked.begin(), ranked.end());
    std::string out;
    for (size_t n = 0; n < std::min(kNearestShown, ranked.size()); ++n) {
      out += (n == 0 ? ", the nearest names are " : ", ") + Quoted(ranked[n].second);
    }
    return out;
  }

  const Rig& rig_;
  std::vector<std::string> joint_of_;  // by bone; empty: none
};

}  // namespace

MapFile ParseMap(const std::string& text, const std::string& name, const Rig& rig) {
  const Document document = ParseYaml(text, name);
  const Value root = document.root();
  root.CheckKeys({"format", "units", "up", "joints"});
  root.Require("format").Integer(1, 1);
  MapFile file;
  if (const auto units = root.Find("units")) {
    file.metres_per_unit = ParseUnits(units->Text());
    if (!file.metres_per_unit) units->RefuseExpecting("cm, m, mm, dm, in, cmu or metres per unit");
  }
  if (const auto up = root.Find("up")) {
    file.up = up->Name("axis", {"y", "z"}) == 0 ? 'y' : 'z';
  }
  file.map = MapReader(rig).Read(root.Require("joints"));
  return file;
}

MapFile ReadMap(const std::string& path, const Rig& rig) {
  return ParseMap(ReadYamlFile(path, "a joint map"), path, rig);
}

}  // namespace retarget::io
