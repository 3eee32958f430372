// Joints told by their names: MatchNames, MatchBestProfile and NearestNames of io/joint_profiles.h.
#include <algorithm>
#include <limits>
#include <utility>

#include "io/joint_names.h"
#include "io/joint_profiles.h"
#include "io/nearest_name.h"
#include "model/rig_tree.h"

namespace retarget {
namespace {

// Joints at the vertex, in any convention.
constexpr const char* kHeadTops = "headtopend headtop headend headnub headleaf headendm";
constexpr const char* kSides = "left/right l/r";  // tried in every convention
constexpr int kRequired = 8;                      // joints

struct Part {
  const char* name;
  const char* JointProfile::*names;
  int JointMap::Side::*joint;
  bool required;
};
constexpr Part kParts[] = {
    {"clavicle", &JointProfile::clavicle, &JointMap::Side::clavicle, false},
    {"shoulder", &JointProfile::shoulder, &JointMap::Side::shoulder, true},
    {"elbow", &JointProfile::elbow, &JointMap::Side::elbow, true},
    {"wrist", &JointProfile::wrist, &JointMap::Side::wrist, false},
    {"hand", &JointProfile::hand, &JointMap::Side::hand, false},
    {"hip", &JointProfile::hip, &JointMap::Side::hip, true},
    {"knee", &JointProfile::knee, &JointMap::Side::knee, true},
    {"ankle", &JointProfile::ankle, &JointMap::Side::ankle, false},
    {"toe", &JointProfile::toe, &JointMap::Side::toe, false},
};
constexpr int kNamedJoints = 18;  // of the body: 4 + 2 x 7; hands and toes do not count

// One way to read the names of a rig by a convention.
struct Reading {
  NameFrame frame;
  std::string left, right;  // words for the sides
  bool flipped = false;     // they stand at the other end

  std::string Name(std::string_view pattern, std::string_view side) const {
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
};

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
    for (const std::string& name : Words(profile_.spine)) CountName(name);
    for (const std::string& name : Words(profile_.extras)) CountName(name);
    const JointMap& map = match_.map;
    int found = (map.head >= 0) + DescendsFrom(rig_, map.root, root) + !map.spine.empty() +
                !map.neck.empty();
    for (const JointMap::Side* side : {&map.left, &map.right}) {
      for (const Part& part : kParts) {
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
    for (const std::string& pattern : Words(alternatives)) {
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
    for (const std::string& name : Words(names)) {
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
    for (const Part& part : kParts) {
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
    for (const std::string& pattern : Words(profile_.hand)) {
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
    const int hips = CommonAncestor(rig_, map.left.hip, map.right.hip);
    const int arms = CommonAncestor(rig_, map.left.shoulder, map.right.shoulder);
    map.root = CommonAncestor(rig_, hips, arms);
    if (map.root < 0) {
      match_.misplaced.push_back("arms and legs share no root");
      return;
    }
    if (!DescendsFrom(rig_, map.head, map.root) || map.head == map.root) map.head = -1;
    for (const int joint : {map.left.hip, map.right.hip}) {
      if (joint == map.root) match_.misplaced.push_back(Quote(joint) + " carries the other limbs");
    }
    SplitTrunk();
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

  // The neck begins at the first bone above all arms that the profile calls so, else at the first
  // bone above all arms.
  void SplitTrunk() {
    JointMap& map = match_.map;
    const auto fork = [&](const JointMap::Side& s) {  // carries the arm
      return CommonAncestor(rig_, s.shoulder, map.head >= 0 ? map.head : map.right.shoulder);
    };
    int arms = std::max(fork(map.left), fork(map.right));
    if (map.head < 0) arms = CommonAncestor(rig_, map.left.shoulder, map.right.shoulder);
    std::vector<int> named;
    for (const std::string& name : Words(profile_.neck)) {
      const int joint = index_.FindBelow(Name(name, ""), map.root);
      if (joint >= 0) named.push_back(joint);
    }
    int top = map.head;
    if (top < 0) {  // the last neck bone, else the bone that carries the arms
      for (const int joint : named) {
        if (DescendsFrom(rig_, joint, arms) && joint > top) top = joint;
      }
    }
    std::vector<int> chain;
    if (top >= 0) chain = Between(rig_, map.root, top);
    if (map.head < 0 && top > map.root) chain.push_back(top);
    if (top < 0 && arms > map.root) {
      chain = Between(rig_, map.root, arms);
      chain.push_back(arms);
    }
    auto neck = std::find_if(chain.begin(), chain.end(), [&](int j) {
      return j > arms && std::find(named.begin(), named.end(), j) != named.end();
    });
    if (neck == chain.end()) {
      neck = std::find_if(chain.begin(), chain.end(), [&](int j) { return j > arms; });
    } else {
      ++match_.score;
    }
    map.spine.assign(chain.begin(), neck);
    map.neck.assign(neck, chain.end());
  }

  void FindHeadTop() {
    if (match_.map.head < 0) return;
    for (const std::string& name : Words(kHeadTops)) {
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

bool Better(const NameMatch& a, const NameMatch& b) {
  if (a.complete() != b.complete()) return a.complete();
  return a.score > b.score;
}

bool SameLimbs(const JointMap& a, const JointMap& b) {
  const auto same = [](const JointMap::Side& s, const JointMap::Side& t) {
    return s.shoulder == t.shoulder && s.elbow == t.elbow && s.hip == t.hip && s.knee == t.knee;
  };
  return same(a.left, b.left) && same(a.right, b.right);
}

std::vector<Reading> ReadingsOf(const NameIndex& index, const JointProfile& profile) {
  std::vector<std::string> words = Words(profile.root);
  for (const std::string& word : Words(profile.head)) words.push_back(word);
  std::vector<std::string> sides = Words(profile.sides);
  for (const std::string& pair : Words(kSides)) {
    if (std::find(sides.begin(), sides.end(), pair) == sides.end()) sides.push_back(pair);
  }
  std::vector<Reading> readings;
  for (const NameFrame& frame : index.Frames(words, Words(profile.prefixes), kRequired)) {
    for (const bool flipped : {false, true}) {
      for (const std::string& pair : sides) {
        const auto word = Words(pair, '/');
        readings.push_back({frame, word[0], word[1], flipped});
      }
    }
  }
  return readings;
}

NameMatch MatchProfile(const Rig& rig, const NameIndex& index, const JointProfile& profile) {
  std::optional<NameMatch> best;
  for (const Reading& reading : ReadingsOf(index, profile)) {
    NameMatch match = NameMatcher(rig, index, profile, reading).Match();
    if (!best || Better(match, *best)) {
      best = std::move(match);
    } else if (match.complete() && match.score == best->score && !SameLimbs(match.map, best->map)) {
      const std::vector<std::string> preferred = Words(profile.prefixes);
      const bool ranked =
          std::find(preferred.begin(), preferred.end(), reading.frame.prefix) != preferred.end();
      if (!ranked) ++best->figures;  // another character's names
    }
  }
  return *best;
}

// A project's joint name ("left_hip", "head") as the profile writes it, normalised.
std::string NameInProfile(const std::string& wanted, const JointProfile& profile) {
  if (wanted == "head") return Words(profile.head)[0];
  if (wanted == "root") return Words(profile.root)[0];
  const bool left = wanted.starts_with("left_");
  const std::string part = wanted.substr(wanted.find('_') + 1);
  const auto sides = Words(Words(profile.sides)[0], '/');
  for (const Part& p : kParts) {
    const auto patterns = Words(profile.*p.names);
    if (part == p.name && !patterns.empty()) {
      return Reading{{}, "", "", false}.Name(patterns[0], sides[left ? 0 : 1]);
    }
  }
  return wanted;
}

}  // namespace

NameMatch MatchNames(const Rig& rig, const JointProfile& profile) {
  NameMatch best = MatchProfile(rig, NameIndex(rig, false), profile);
  if (!best.complete() && NamesAreNumbered(rig)) {
    NameMatch match = MatchProfile(rig, NameIndex(rig, true), profile);
    if (Better(match, best)) best = std::move(match);
  }
  return best;
}

BestMatch MatchBestProfile(const Rig& rig) {
  std::vector<NameIndex> indices = {NameIndex(rig, false)};
  if (NamesAreNumbered(rig)) indices.emplace_back(rig, true);
  std::optional<BestMatch> best;
  for (const NameIndex& index : indices) {
    for (const JointProfile& profile : JointProfiles()) {
      NameMatch match = MatchProfile(rig, index, profile);
      if (!best || Better(match, best->match)) {
        best = BestMatch{std::move(match), {}};
      } else if (match.complete() && match.score == best->match.score &&
                 !SameLimbs(match.map, best->match.map)) {
        best->rival = std::move(match);
      }
    }
  }
  return *best;
}

std::vector<std::string> NearestNames(const Rig& rig, const std::string& wanted,
                                      const std::string& profile) {
  const auto found = std::ranges::find_if(JointProfiles(),
                                          [&](const JointProfile& p) { return profile == p.name; });
  const JointProfile& convention =
      found == JointProfiles().end() ? JointProfiles().front() : *found;
  const std::string target = NameInProfile(wanted, convention);
  std::vector<std::pair<size_t, int>> ranked;
  for (int j = 0; j < rig.num_joints(); ++j) {
    ranked.emplace_back(EditDistance(NormalisedName(rig.joints[j].name), target), j);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::string> names;
  for (const auto& [distance, joint] : ranked) {
    const std::string& name = rig.joints[joint].name;
    if (names.size() < 3 && std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace retarget
