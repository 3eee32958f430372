#include "io/recognition/joint_reading.h"

#include <algorithm>
#include <limits>

#include "io/recognition/figure_tree.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

// Joints at the vertex, in any convention.
constexpr const char* kHeadTops = "headtopend headtop headend headnub headleaf headendm";
constexpr int kNamedJoints = 18;  // of the body: 4 + 2 x 7; hands and toes do not count

class NameMatcher {
 public:
  NameMatcher(const Rig& rig, const NameIndex& index, const JointProfile& profile,
              const Reading& reading)
      : rig_(rig), index_(index), profile_(profile), reading_(reading) {}

  NameMatch Match() {
    match_.map.profile = profile_.name;
    match_.figures = std::numeric_limits<int>::max();
    match_.map.head = Find(profile_.head, "");
    const int root = Find(profile_.root, "");
    MatchSide(reading_.left, "left", &match_.map.left);
    MatchSide(reading_.right, "right", &match_.map.right);
    if (match_.missing.empty()) {
      Arrange();
    } else {
      match_.figures = 1;
      match_.map.root = root;
      match_.map.spine = Chain(profile_.spine);
      match_.map.neck = Chain(profile_.neck);
    }
    for (const std::string& name : SplitWords(profile_.spine)) CountName(name);
    for (const std::string& name : SplitWords(profile_.extras)) CountName(name);
    const JointMap& map = match_.map;
    int found = (map.head >= 0) + DescendsFrom(rig_, map.root, root) + !map.spine.empty() +
                !map.neck.empty();
    for (const JointMap::Side* side : {&map.left, &map.right}) {
      for (const NamedPart& part : kNamedParts) {
        const bool counts =
            part.joint != &JointMap::Side::hand && part.joint != &JointMap::Side::toe;
        if (counts && side->*part.joint >= 0) ++found;
      }
    }
    match_.share = static_cast<double>(found) / kNamedJoints;
    return match_;
  }

 private:
  std::string Name(std::string_view pattern, std::string_view side) const {
    return reading_.Name(pattern, side);
  }

  // The first of the alternatives that the rig has, and counts it.
  int Find(std::string_view alternatives, std::string_view side) {
    for (const std::string& pattern : SplitWords(alternatives)) {
      const int joint = index_.Find(Name(pattern, side));
      if (joint < 0) continue;
      ++match_.score;
      return joint;
    }
    return -1;
  }

  // The bones of these names as far as they hang from one another.
  std::vector<int> Chain(std::string_view names) const {
    std::vector<int> chain;
    for (const std::string& name : SplitWords(names)) {
      const int bone = index_.Find(Name(name, ""));
      if (bone >= 0 && (chain.empty() || DescendsFrom(rig_, bone, chain.back()))) {
        chain.push_back(bone);
      }
    }
    return chain;
  }

  void CountName(const std::string& name) {
    match_.score += index_.Count(Name(name, "")) > 0 ? 1 : 0;
  }

  void MatchSide(const std::string& word, const std::string& side, JointMap::Side* joints) {
    for (const NamedPart& part : kNamedParts) {
      int& joint = joints->*part.joint;
      joint = Find(profile_.*part.names, word);
      if (!part.required) continue;
      if (joint < 0) {
        match_.missing.push_back(side + "_" + part.name);
      } else {
        match_.figures = std::min(match_.figures, index_.Count(index_.NameOf(joint)));
      }
    }
    joints->hand = BestHand(word, joints->wrist);
  }

  // The first alternative that is not at the wrist itself, as CMU's zero bones are; -1 if none.
  int BestHand(const std::string& word, int wrist) const {
    for (const std::string& pattern : SplitWords(profile_.hand)) {
      const int joint = wrist < 0 ? -1 : index_.FindBelow(Name(pattern, word), wrist);
      double length = 0;
      for (int j = joint; j > wrist; j = rig_.joints[j].parent) {
        length += rig_.joints[j].offset.norm();
      }
      if (joint >= 0 && length > 0) return joint;
    }
    return -1;
  }

  // Checks that the joints hang from one another as they do in a human, and fills root, spine and
  // neck from the chain between legs and head.
  void Arrange() {
    JointMap& map = match_.map;
    CheckSide(&map.left, "left");
    CheckSide(&map.right, "right");
    const auto named_necks = [&](int root) {
      std::vector<int> named;
      for (const std::string& name : SplitWords(profile_.neck)) {
        const int joint = index_.FindBelow(Name(name, ""), root);
        if (joint >= 0) named.push_back(joint);
      }
      return named;
    };
    bool neck_named = false;
    if (!ArrangeTrunk(rig_, named_necks, &map, &neck_named)) {
      match_.misplaced.push_back("arms and legs share no root");
      return;
    }
    match_.score += neck_named ? 1 : 0;
    for (const int joint : {map.left.hip, map.right.hip}) {
      if (joint == map.root) match_.misplaced.push_back(Quote(joint) + " carries the other limbs");
    }
    FindHeadTop();
  }

  void CheckSide(JointMap::Side* s, const std::string& side) {
    for (const auto& [joint, ancestor] :
         {std::pair{s->elbow, s->shoulder}, std::pair{s->knee, s->hip}}) {
      if (joint == ancestor || !DescendsFrom(rig_, joint, ancestor)) NoteMisplaced(joint, ancestor);
    }
    if (DescendsFrom(rig_, s->shoulder, s->hip) || DescendsFrom(rig_, s->hip, s->shoulder)) {
      match_.misplaced.push_back(side + " arm and leg hang from one another");
    }
    // What is not required and hangs elsewhere (an ankle that is a handle) plays no part.
    const auto drop_unless = [&](int* joint, int ancestor) {
      if (*joint < 0 || (*joint != ancestor && DescendsFrom(rig_, *joint, ancestor))) return;
      match_.ignored.push_back(rig_.joints[*joint].name);
      *joint = -1;
    };
    drop_unless(&s->wrist, s->elbow);
    drop_unless(&s->ankle, s->knee);
    if (s->wrist < 0) s->hand = -1;
    if (s->ankle < 0) s->toe = -1;
    if (s->toe >= 0) drop_unless(&s->toe, s->ankle);
    if (!DescendsFrom(rig_, s->shoulder, s->clavicle) || s->shoulder == s->clavicle) {
      s->clavicle = -1;
    }
  }

  void FindHeadTop() {
    if (match_.map.head < 0) return;
    for (const std::string& name : SplitWords(kHeadTops)) {
      const int joint = index_.FindBelow(Name(name, ""), match_.map.head);
      if (joint < 0) continue;
      match_.map.head_top = joint;
      return;
    }
  }

  std::string Quote(int joint) const { return "'" + rig_.joints[joint].name + "'"; }
  void NoteMisplaced(int joint, int ancestor) {
    match_.misplaced.push_back(Quote(joint) + " does not hang from " + Quote(ancestor));
  }

  const Rig& rig_;
  const NameIndex& index_;
  const JointProfile& profile_;
  const Reading& reading_;
  NameMatch match_;
};

}  // namespace

std::string Reading::Name(std::string_view pattern, std::string_view side) const {
  std::string moved;
  if (flipped && pattern.find('#') != std::string_view::npos) {
    moved = pattern.front() == '#' ? std::string(pattern.substr(1)) + "#"
                                   : "#" + std::string(pattern.substr(0, pattern.size() - 1));
    pattern = moved;
  }
  std::string out = frame.prefix;
  for (const char c : pattern) {
    if (c == '#') {
      out += side;
    } else if (c == '@') {
      out += side.front();
    } else {
      out += c;
    }
  }
  return out + frame.suffix;
}

NameMatch MatchReading(const Rig& rig, const NameIndex& index, const JointProfile& profile,
                       const Reading& reading) {
  return NameMatcher(rig, index, profile, reading).Match();
}

}  // namespace retarget::io
