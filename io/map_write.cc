// FormatMap and FormatMapDraft of io/map_file.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "io/map_file.h"
#include "io/recognition/joint_profiles.h"
#include "io/recognition/map_joints.h"
#include "io/text/quoted.h"
#include "io/text/yaml.h"

namespace retarget::io {
namespace {

// Well-formed UTF-8, which YAML demands (RFC 3629; overlong forms are let pass).
bool IsUtf8(const std::string& text) {
  int open = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (open > 0) {
      if ((byte & 0xC0) != 0x80) return false;
      --open;
    } else if (byte >= 0x80) {
      open = (byte & 0xE0) == 0xC0 ? 1 : (byte & 0xF0) == 0xE0 ? 2 : (byte & 0xF8) == 0xF0 ? 3 : -1;
      if (open < 0) return false;
    }
  }
  return open == 0;
}

class MapWriter {
 public:
  explicit MapWriter(const Rig& rig) : rig_(rig) {
    for (const RigJoint& joint : rig.joints) ++count_[joint.name];
  }

  void Comment(const std::string& text) { out_ += "# " + Line(text) + "\n"; }
  void Add(const std::string& line) { out_ += line + "\n"; }

  // `open`: required joints without a bone are left empty, with the names that come nearest.
  void Joints(const JointMap& map, bool open) {
    Add("joints:                   # none: a virtual joint, at a tabulated place");
    const auto joint = [&](const std::string& name, int bone, bool required) {
      if (bone < 0 && required && open) {
        Add(fmt::format("  {}:  # required; nearest: {}", name, NearestTo(name, map.profile)));
      } else {
        Add(fmt::format("  {}: {}", name, bone < 0 ? "none" : Bone(bone)));
      }
      if (bone >= 0) used_.push_back(bone);
    };
    joint("root", map.root, true);
    Add(fmt::format("  spine: {}  # from above the root to below the neck", Chain(map.spine)));
    Add(fmt::format("  neck: {}", Chain(map.neck)));
    joint("head", map.head, false);
    joint("head_top", map.head_top, false);
    for (const auto& [prefix, side] : {std::pair("left_", &map.left), {"right_", &map.right}}) {
      for (const SidePart& part : kSideParts) {
        joint(std::string(prefix) + part.name, side->*part.joint, part.required);
      }
    }
    Add("# bones without a part:");
    for (int j = 0; j < rig_.num_joints(); ++j) {
      if (std::find(used_.begin(), used_.end(), j) == used_.end()) Add("#   " + Line(Bone(j)));
    }
  }

  const std::string& text() const { return out_; }

 private:
  static std::string Line(std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
    return text;
  }

  std::string Bone(int joint) const {
    const std::string& name = rig_.joints[static_cast<size_t>(joint)].name;
    const bool clear = !name.empty() && count_.at(name) == 1 && name != "none" &&
                       name.front() != '#' && IsUtf8(name);
    return clear ? YamlText(name) : fmt::format("\"#{}\"", joint);
  }

  std::string Chain(const std::vector<int>& bones) {
    std::string list;
    for (const int bone : bones) {
      list += (list.empty() ? "" : ", ") + Bone(bone);
      used_.push_back(bone);
    }
    return "[" + list + "]";
  }

  std::string NearestTo(const std::string& joint, const std::string& profile) const {
    std::string list;
    for (const std::string& name : NearestNames(rig_, joint, profile)) {
      list += (list.empty() ? "" : ", ") + Printable(name);
    }
    return IsUtf8(list) ? list : "";
  }

  const Rig& rig_;
  std::unordered_map<std::string, int> count_;  // of joints by name
  std::vector<int> used_;
  std::string out_;
};

}  // namespace

std::string FormatMap(const RigMotion& motion, const RigFacts& facts) {
  MapWriter writer(motion.rig);
  writer.Comment(fmt::format("profile {}, confidence {:.2f}, stature {:.2f} m", facts.map.profile,
                             facts.confidence, facts.stature));
  for (const std::string& note : facts.notes) {
    if (IsUtf8(note)) writer.Comment(note);
  }
  writer.Add("format: 1");
  writer.Add(
      fmt::format("units: {:<18} # cm, m, mm, dm, in, cmu or metres per unit; left out: guessed",
                  facts.unit_name));
  writer.Add(fmt::format("up: {:<21} # y or z; left out: from the motion", facts.up));
  writer.Joints(facts.map, false);
  return writer.text();
}

std::string FormatMapDraft(const RigMotion& motion, const std::string& reason) {
  MapWriter writer(motion.rig);
  writer.Comment(IsUtf8(reason) ? reason : "no human figure");
  writer.Comment("a draft: fill in the required joints");
  writer.Add("format: 1");
  writer.Joints(MatchBestProfile(motion.rig).match.map, true);
  return writer.text();
}

}  // namespace retarget::io
