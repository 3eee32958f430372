#include "io/acclaim/skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "io/acclaim/text.h"
#include "io/text/cursor.h"
#include "io/text/nearest_name.h"
#include "io/text/quoted.h"
#include "model/geometry/euler_angles.h"

namespace retarget::io::acclaim {
namespace {

using bvh::SameWord;

// A bound that no real file reaches, so that a damaged one cannot ask for all memory.
constexpr size_t kMaxBones = 1024;

constexpr std::array<std::string_view, 6> kDofNames = {"tx", "ty", "tz", "rx", "ry", "rz"};
constexpr const char* kBoneKeys =
    "id, name, direction, length, axis, bodymass, cofmass, dof, limits or end";

// -1 for a word that is no degree of freedom.
int DofKind(std::string_view word) {
  for (size_t k = 0; k < kDofNames.size(); ++k) {
    if (SameWord(word, kDofNames[k])) return static_cast<int>(k);
  }
  return -1;
}

// "XYZ": axis 0 first.
bool ParseOrder(std::string_view word, std::array<int, 3>* order) {
  if (word.size() != 3) return false;
  for (size_t k = 0; k < 3; ++k) {
    const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(word[k])));
    (*order)[k] = c - 'x';
    if (c < 'x' || c > 'z') return false;
  }
  return CompleteAxes(*order) == *order;
}

class SkeletonReader {
 public:
  SkeletonReader(std::string_view text, const std::string& name) : lines_(text, name) {
    bones_.emplace_back();
    bones_[0].name = "root";
    out_.joint_of_name["root"] = 0;
  }

  Skeleton Read() {
    bool more = lines_.Next();
    while (more) {
      const std::string_view key = lines_.key();
      if (!key.starts_with(':')) lines_.FailAtWord(key, "a keyword such as :bonedata");
      if (SameWord(key, ":units")) {
        more = ReadUnits();
      } else if (SameWord(key, ":root")) {
        more = ReadRoot();
      } else if (SameWord(key, ":bonedata")) {
        more = ReadBones();
      } else if (SameWord(key, ":hierarchy")) {
        more = ReadHierarchy();
      } else {  // version, name, documentation, skin and what else there may be
        while ((more = lines_.Next()) && !lines_.key().starts_with(':')) {
        }
      }
    }
    if (bones_.size() < 2) lines_.Fail("no bones", "a :bonedata section");
    if (!has_order_) lines_.Fail("no order of the root's values", "a :root section with order");
    Assemble(bones_, lines_, &out_);
    return std::move(out_);
  }

 private:
  // Steps to the next line of a section; false at its end.
  bool NextInSection(bool* more) {
    *more = lines_.Next();
    return *more && !lines_.key().starts_with(':');
  }

  bool ReadUnits() {
    bool more;
    while (NextInSection(&more)) {
      if (SameWord(lines_.key(), "length")) {
        out_.length_unit = lines_.Number(1, "a length unit above zero");
        if (out_.length_unit <= 0) lines_.FailAtWord(lines_.words()[1], "a length unit above zero");
      } else if (SameWord(lines_.key(), "angle")) {
        const std::string_view unit = lines_.words().size() > 1 ? lines_.words()[1] : "";
        out_.degrees = SameWord(unit.substr(0, 3), "deg");
        if (!out_.degrees && !SameWord(unit.substr(0, 3), "rad")) {
          lines_.FailAtWord(unit, "deg or rad");
        }
      }
    }
    return more;
  }

  bool ReadRoot() {
    if (has_order_) lines_.Fail("a second :root", "one");
    BoneBlock& root = bones_[0];
    bool more;
    while (NextInSection(&more)) {
      const std::string_view key = lines_.key();
      if (SameWord(key, "order")) {
        root.dofs = ReadDofs();
        has_order_ = true;
      } else if (SameWord(key, "axis")) {
        if (lines_.words().size() < 2 || !ParseOrder(lines_.words()[1], &root.axis_order)) {
          lines_.FailAtWord(lines_.words().back(), "an order such as XYZ");
        }
      } else if (SameWord(key, "position")) {
        root.direction = ReadVector("three numbers after position");
        for (size_t k = 1; k <= 3; ++k) NoteLength(lines_.words()[k]);
      } else if (SameWord(key, "orientation")) {
        root.axis_angles = ReadVector("three numbers after orientation");
      } else {
        lines_.FailAtWord(key, "order, axis, position or orientation");
      }
    }
    return more;
  }

  bool ReadBones() {
    bool more;
    while (NextInSection(&more)) {
      if (!SameWord(lines_.key(), "begin")) lines_.FailAtWord(lines_.key(), "begin");
      if (bones_.size() > kMaxBones) {
        lines_.Fail("too many bones", fmt::format("at most {}", kMaxBones));
      }
      ReadBone();
    }
    return more;
  }

  void ReadBone() {
    BoneBlock bone;
    bool has_direction = false, has_length = false, in_limits = false;
    while (true) {
      if (!lines_.Next()) lines_.Fail("the end of the file", kBoneKeys);
      const std::string_view key = lines_.key();
      double unused = 0;
      if (in_limits && bvh::ParseNumber(key, &unused) != bvh::NumberFault::kNotANumber) continue;
      in_limits = false;
      if (SameWord(key, "end")) break;
      if (SameWord(key, "name")) {
        if (lines_.words().size() != 2) lines_.Fail("no single word", "the name of the bone");
        bone.name = std::string(lines_.words()[1]);
      } else if (SameWord(key, "direction")) {
        bone.direction = ReadVector("three numbers after direction");
        has_direction = true;
      } else if (SameWord(key, "length")) {
        bone.length = lines_.Number(1, "a length");
        if (bone.length < 0) lines_.FailAtWord(lines_.words()[1], "a length that is not negative");
        NoteLength(lines_.words()[1]);
        has_length = true;
      } else if (SameWord(key, "axis")) {
        bone.axis_angles = ReadVector("three numbers after axis");
        if (lines_.words().size() > 4 && !ParseOrder(lines_.words()[4], &bone.axis_order)) {
          lines_.FailAtWord(lines_.words()[4], "an order such as XYZ");
        }
      } else if (SameWord(key, "dof")) {
        bone.dofs = ReadDofs();
      } else if (SameWord(key, "limits")) {
        in_limits = true;
      } else if (!SameWord(key, "id") && !SameWord(key, "bodymass") && !SameWord(key, "cofmass")) {
        lines_.FailAtWord(key, kBoneKeys);
      }
    }
    if (bone.name.empty()) lines_.Fail("the end of a bone", "its name");
    if (!has_direction || !has_length) {
      lines_.Fail("the end of bone " + QuotedWord(bone.name), "its direction and length");
    }
    const double norm = bone.direction.norm();
    if (norm < 1e-9 && bone.length > 0) {
      lines_.Fail("no direction of bone " + QuotedWord(bone.name), "one that is not zero");
    }
    if (norm > 0) bone.direction /= norm;
    const int joint = static_cast<int>(bones_.size());
    if (!out_.joint_of_name.emplace(LowerCase(bone.name), joint).second) {
      lines_.Fail("a second bone " + QuotedWord(bone.name), "each name once");
    }
    bones_.push_back(std::move(bone));
  }

  bool ReadHierarchy() {
    bool more;
    while (NextInSection(&more)) {
      if (SameWord(lines_.key(), "begin") || SameWord(lines_.key(), "end")) continue;
      const int parent = FindBone(lines_.key());
      for (size_t k = 1; k < lines_.words().size(); ++k) {
        const int child = FindBone(lines_.words()[k]);
        if (child == 0 || bones_[child].parent >= 0) {
          lines_.FailAtWord(lines_.words()[k], "each bone once as a child");
        }
        bones_[child].parent = parent;
        bones_[parent].children.push_back(child);
      }
    }
    return more;
  }

  int FindBone(std::string_view word) const {
    const auto it = out_.joint_of_name.find(LowerCase(word));
    if (it != out_.joint_of_name.end()) return it->second;
    std::vector<std::string> names;
    for (const BoneBlock& bone : bones_) names.push_back(Printable(bone.name));
    lines_.FailAtWord(word, "a bone of :bonedata" + Suggestion(word, names));
  }

  std::vector<int> ReadDofs() const {
    std::vector<int> dofs;
    for (size_t k = 1; k < lines_.words().size(); ++k) {
      const std::string_view word = lines_.words()[k];
      const int kind = DofKind(word);
      if (kind < 0) lines_.FailAtWord(word, "tx, ty, tz, rx, ry or rz");
      if (std::find(dofs.begin(), dofs.end(), kind) != dofs.end()) {
        lines_.FailAtWord(word, "each degree of freedom once");
      }
      dofs.push_back(kind);
    }
    return dofs;
  }

  Vec3 ReadVector(const char* what) const {
    return {lines_.Number(1, what), lines_.Number(2, what), lines_.Number(3, what)};
  }

  void NoteLength(std::string_view word) {
    const size_t begin = lines_.PositionOf(word);
    out_.length_numbers.emplace_back(begin, begin + word.size());
  }

  LineReader lines_;
  std::vector<BoneBlock> bones_;  // the root first; its direction is its position
  bool has_order_ = false;
  Skeleton out_;
};

}  // namespace

std::string LowerCase(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

Skeleton ReadSkeleton(std::string_view text, const std::string& name) {
  return SkeletonReader(text, name).Read();
}

}  // namespace retarget::io::acclaim
