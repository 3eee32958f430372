#include "io/bvh/hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "io/bvh/bvh.h"
#include "io/text/quoted.h"

namespace retarget::io::bvh {
namespace {

// Bounds that no real file reaches, so that a damaged one cannot ask for all memory.
constexpr size_t kMaxJoints = 4096;
constexpr size_t kMaxDepth = 256;

constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

// HIERARCHY ... up to the word MOTION.
class HierarchyReader {
 public:
  explicit HierarchyReader(Cursor* cursor) : cursor_(*cursor) {}

  Hierarchy Read() {
    if (const auto word = cursor_.Next(); !SameWord(word, "HIERARCHY")) {
      cursor_.FailAtToken(word, "HIERARCHY");
    }
    for (;;) {
      const std::string_view word = cursor_.Next();
      if (SameWord(word, "MOTION") && !out_.rig.joints.empty()) {
        out_.motion_begin = cursor_.position() - word.size();
        return std::move(out_);
      }
      if (!SameWord(word, "ROOT")) {
        cursor_.FailAtToken(word, out_.rig.joints.empty() ? "ROOT" : "ROOT or MOTION");
      }
      Open(-1);
      while (!open_.empty()) ReadInJoint();
    }
  }

 private:
  struct OpenJoint {
    int joint;
    bool has_offset = false, has_channels = false, has_child = false;
  };

  void Open(int parent) {
    const size_t begin = cursor_.position() - (parent < 0 ? 4 : 5);  // ROOT, JOINT
    const std::string_view name = cursor_.RestAsName();
    if (name.empty()) cursor_.Fail("a joint without a name", "a name on the same line");
    if (out_.rig.joints.size() >= kMaxJoints) {
      cursor_.Fail("too many joints", fmt::format("at most {}", kMaxJoints));
    }
    if (open_.size() >= kMaxDepth) {
      cursor_.Fail("joints nested too deeply", fmt::format("at most {} levels", kMaxDepth));
    }
    ExpectBrace();
    RigJoint joint;
    joint.name = std::string(name);
    joint.parent = parent;
    out_.rig.joints.push_back(std::move(joint));
    out_.channels.emplace_back();
    out_.joint_text.emplace_back(begin, begin);
    out_.second_offset.emplace_back();
    out_.offset_line.push_back(0);
    open_.push_back({out_.rig.num_joints() - 1});
  }

  void ReadInJoint() {
    OpenJoint& joint = open_.back();
    const std::string_view word = cursor_.Next();
    if (SameWord(word, "OFFSET")) {
      if (joint.has_offset) cursor_.Fail("a second OFFSET", "one per joint");
      out_.rig.joints[joint.joint].offset = ReadOffset(&out_.second_offset[joint.joint]);
      out_.offset_line[joint.joint] = cursor_.line();
      joint.has_offset = true;
    } else if (SameWord(word, "CHANNELS")) {
      // Numbers of a frame are in the order of these lines, hence of the joints.
      if (joint.has_channels) cursor_.Fail("a second CHANNELS", "one per joint");
      if (joint.has_child) cursor_.Fail("CHANNELS after a child joint", "them before");
      const std::vector<int> kinds = ReadChannels();
      const auto is_position = [](int kind) { return kind < kFirstRotationChannel; };
      // No channel stands twice, so three are all axes.
      RigJoint& rig_joint = out_.rig.joints[joint.joint];
      rig_joint.translates = std::ranges::count_if(kinds, is_position) == 3;
      rig_joint.can_translate = rig_joint.translates;
      out_.channels[joint.joint] = kinds;
      joint.has_channels = true;
    } else if (SameWord(word, "JOINT")) {
      joint.has_child = true;
      Open(joint.joint);  // `joint` is no longer valid
    } else if (SameWord(word, "END")) {
      ReadEndSite(joint.joint);
    } else if (word == "}") {
      if (!joint.has_offset) {
        cursor_.Fail("the end of joint " + QuotedWord(out_.rig.joints[joint.joint].name),
                     "its OFFSET");
      }
      out_.joint_text[joint.joint].second = cursor_.position();
      open_.pop_back();
    } else {
      cursor_.FailAtToken(word, "OFFSET, CHANNELS, JOINT, End Site or }");
    }
  }

  void ReadEndSite(int joint) {
    const std::string_view rest = cursor_.RestAsName();
    if (!SameWord(rest.substr(0, 4), "Site")) cursor_.Fail(QuotedWord(rest), "Site after End");
    ExpectBrace();
    if (const auto word = cursor_.Next(); !SameWord(word, "OFFSET")) {
      cursor_.FailAtToken(word, "OFFSET of the End Site");
    }
    const Vec3 point = ReadOffset(nullptr);
    if (const auto word = cursor_.Next(); word != "}") cursor_.FailAtToken(word, "}");
    if (out_.rig.joints[joint].end_site) {
      out_.warnings.push_back(fmt::format("line {}: joint {} has a second End Site, ignored",
                                          cursor_.line(), QuotedWord(out_.rig.joints[joint].name)));
    } else {
      out_.rig.joints[joint].end_site = point;
    }
  }

  // Some writers (NVIDIA's SOMA) put a joint's rotation at rest after its place: into `second`.
  Vec3 ReadOffset(std::optional<Vec3>* second) {
    Vec3 offset = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      offset[axis] = ReadOffsetNumber();
      out_.offset_numbers.push_back(last_number_);
    }
    if (!AtNumber()) return offset;
    constexpr const char* kExpected = "three, or six of a place and a rotation";
    Vec3 more = Vec3::Zero();
    int count = 0;
    for (; AtNumber(); ++count) {
      const double number = ReadOffsetNumber();
      if (count < 3) more[count] = number;
    }
    if (second == nullptr || count != 3) {
      cursor_.Fail(fmt::format("{} numbers after OFFSET", 3 + count),
                   second == nullptr ? "three" : kExpected);
    }
    *second = more;
    return offset;
  }

  bool AtNumber() {
    double unused = 0;
    return ParseNumber(cursor_.Peek(), &unused) != NumberFault::kNotANumber;
  }

  double ReadOffsetNumber() {
    std::string_view word = cursor_.Next();
    const size_t begin = cursor_.position() - word.size();
    while (word.ends_with(',')) word.remove_suffix(1);
    last_number_ = {begin, begin + word.size()};
    return cursor_.Number(word, "three numbers after OFFSET");
  }

  std::vector<int> ReadChannels() {
    const std::string_view count_word = cursor_.Next();
    const double count = cursor_.Number(count_word, "the number of channels");
    if (count < 0 || count > 6 || count != std::floor(count)) {
      cursor_.FailAtToken(count_word, "0 to 6 channels");
    }
    std::vector<int> kinds;
    for (int c = 0; c < static_cast<int>(count); ++c) {
      const std::string_view word = cursor_.Next();
      const int kind = ChannelKind(word);
      if (kind < 0) cursor_.FailAtToken(word, "a channel such as Xposition or Zrotation");
      if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) {
        cursor_.FailAtToken(word, "each channel once per joint");
      }
      kinds.push_back(kind);
    }
    if (ChannelKind(cursor_.Peek()) >= 0) {
      cursor_.Fail("more channel names", fmt::format("{} as declared", kinds.size()));
    }
    return kinds;
  }

  static int ChannelKind(std::string_view word) {
    for (size_t k = 0; k < kChannelNames.size(); ++k) {
      if (SameWord(word, kChannelNames[k])) return static_cast<int>(k);
    }
    return -1;
  }

  void ExpectBrace() {
    if (const auto word = cursor_.Next(); word != "{") cursor_.FailAtToken(word, "{");
  }

  Cursor& cursor_;
  Hierarchy out_;
  std::pair<size_t, size_t> last_number_;
  std::vector<OpenJoint> open_;
};

}  // namespace

Hierarchy ReadHierarchy(Cursor* cursor) { return HierarchyReader(cursor).Read(); }

}  // namespace retarget::io::bvh
