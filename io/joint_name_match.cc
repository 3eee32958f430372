// Joints told by their names: NormalisedName, MatchNames, MatchBestProfile and NearestNames of
// io/joint_profiles.h.
#include <algorithm>
#include <cctype>
#include <unordered_map>
#include <utility>

#include "io/joint_profiles.h"
#include "io/nearest_name.h"

namespace retarget {
namespace {

// Joints at the vertex, in any convention.
constexpr const char* kHeadTops = "headtopend headtop headend headnub headleaf";

std::vector<std::string> Words(std::string_view text, char separator = ' ') {
  std::vector<std::string> words;
  while (!text.empty()) {
    const size_t end = std::min(text.find(separator), text.size());
    if (end > 0) words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

std::string WithSide(std::string_view pattern, std::string_view side) {
  std::string out;
  for (char c : pattern) {
    if (c == '#') {
      out += side;
    } else if (c == '@') {
      out += side.front();
    } else {
      out += c;
    }
  }
  return out;
}

// Whether `joint` hangs somewhere below `ancestor`.
bool DescendsFrom(const Rig& rig, int joint, int ancestor) {
  while (joint > ancestor) joint = rig.joints[joint].parent;  // parents come first
  return joint == ancestor && joint >= 0;
}

int CommonAncestor(const Rig& rig, int a, int b) {
  while (a != b) (a > b ? a : b) = rig.joints[std::max(a, b)].parent;
  return a;
}

// The joints strictly between `ancestor` and `joint`, from the top.
std::vector<int> Between(const Rig& rig, int ancestor, int joint) {
  std::vector<int> chain;
  for (int j = rig.joints[joint].parent; j > ancestor; j = rig.joints[j].parent) chain.push_back(j);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

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
    {"wrist", &JointProfile::wrist, &JointMap::Side::wrist, true},
    {"hand", &JointProfile::hand, &JointMap::Side::hand, false},
    {"hip", &JointProfile::hip, &JointMap::Side::hip, true},
    {"knee", &JointProfile::knee, &JointMap::Side::knee, true},
    {"ankle", &JointProfile::ankle, &JointMap::Side::ankle, true},
    {"toe", &JointProfile::toe, &JointMap::Side::toe, false},
};

// Names of one rig under one profile and one pair of side words.
class NameMatcher {
 public:
  NameMatcher(const Rig& rig, const JointProfile& profile) : rig_(rig), profile_(profile) {
    for (int j = rig.num_joints() - 1; j >= 0; --j) {  // of equal names the first joint stays
      index_[NormalisedName(rig.joints[j].name, profile.prefixes)] = j;
    }
  }

  NameMatch Match(const std::string& left, const std::string& right) {
    match_ = {};
    match_.map.profile = profile_.name;
    match_.map.head = Find(profile_.head, "");
    if (match_.map.head < 0) match_.missing.push_back("head");
    Find(profile_.root, "");
    MatchSide(left, "left", &match_.map.left);
    MatchSide(right, "right", &match_.map.right);
    CountAll(profile_.spine);
    CountAll(profile_.extras);
    if (match_.missing.empty()) Arrange();
    return match_;
  }

 private:
  // The first of the alternatives that the rig has, and counts it.
  int Find(std::string_view alternatives, std::string_view side) {
    for (const std::string& name : Words(alternatives)) {
      const auto found = index_.find(WithSide(name, side));
      if (found == index_.end()) continue;
      ++match_.score;
      return found->second;
    }
    return -1;
  }

  void CountAll(std::string_view names) {
    for (const std::string& name : Words(names)) match_.score += index_.contains(name) ? 1 : 0;
  }

  void MatchSide(const std::string& word, const std::string& side, JointMap::Side* joints) {
    for (const Part& part : kParts) {
      int& joint = joints->*part.joint;
      joint = Find(profile_.*part.names, word);
      if (joint < 0 && part.required) match_.missing.push_back(side + "_" + part.name);
    }
    joints->hand = BestHand(word, joints->wrist);
  }

  // The first alternative that is not at the wrist itself, as CMU's zero bones are; -1 if none.
  int BestHand(const std::string& word, int wrist) const {
    for (const std::string& name : Words(profile_.hand)) {
      const auto found = index_.find(WithSide(name, word));
      if (found == index_.end() || wrist < 0 || !DescendsFrom(rig_, found->second, wrist)) continue;
      double length = 0;
      for (int j = found->second; j != wrist; j = rig_.joints[j].parent) {
        length += rig_.joints[j].offset.norm();
      }
      if (length > 0) return found->second;
    }
    return -1;
  }

  // Checks that the joints hang from one another as they do in a human, and fills root, spine and
  // neck from the chain between legs and head.
  void Arrange() {
    JointMap& map = match_.map;
    CheckSide(map.left, "left");
    CheckSide(map.right, "right");
    map.root = CommonAncestor(rig_, CommonAncestor(rig_, map.left.hip, map.right.hip), map.head);
    if (map.root < 0) {
      match_.misplaced.push_back("legs and head share no root");
      return;
    }
    for (int joint : {map.head, map.left.hip, map.right.hip}) {
      if (joint == map.root) match_.misplaced.push_back(Quote(joint) + " carries the other limbs");
    }
    for (int joint : {map.left.shoulder, map.right.shoulder}) {
      if (!DescendsFrom(rig_, joint, map.root)) NoteMisplaced(joint, map.root);
    }
    SplitTrunk();
    FindHeadTop();
  }

  void CheckSide(JointMap::Side& s, const std::string& side) {
    const std::pair<int, int> chains[] = {
        {s.elbow, s.shoulder}, {s.wrist, s.elbow}, {s.knee, s.hip}, {s.ankle, s.knee}};
    for (const auto& [joint, ancestor] : chains) {
      if (joint == ancestor || !DescendsFrom(rig_, joint, ancestor)) NoteMisplaced(joint, ancestor);
    }
    if (DescendsFrom(rig_, s.shoulder, s.hip) || DescendsFrom(rig_, s.hip, s.shoulder)) {
      match_.misplaced.push_back(side + " arm and leg hang from one another");
    }
    if (!DescendsFrom(rig_, s.shoulder, s.clavicle)) s.clavicle = -1;
    if (!DescendsFrom(rig_, s.toe, s.ankle)) s.toe = -1;
  }

  // The neck begins at the first bone below the root that the profile calls so; without such a
  // name, below the last bone that carries an arm.
  void SplitTrunk() {
    JointMap& map = match_.map;
    const std::vector<int> chain = Between(rig_, map.root, map.head);
    const std::vector<std::string> names = Words(profile_.neck);
    auto neck = std::find_if(chain.begin(), chain.end(), [&](int j) {
      const std::string name = NormalisedName(rig_.joints[j].name, profile_.prefixes);
      return std::find(names.begin(), names.end(), name) != names.end();
    });
    if (neck == chain.end()) {
      const int arms = std::max(CommonAncestor(rig_, map.left.shoulder, map.head),
                                CommonAncestor(rig_, map.right.shoulder, map.head));
      neck = std::find_if(chain.begin(), chain.end(), [&](int j) { return j > arms; });
    } else {
      ++match_.score;
    }
    map.spine.assign(chain.begin(), neck);
    map.neck.assign(neck, chain.end());
  }

  void FindHeadTop() {
    for (const std::string& name : Words(kHeadTops)) {
      const auto found = index_.find(name);
      if (found == index_.end()) continue;
      if (found->second != match_.map.head && DescendsFrom(rig_, found->second, match_.map.head)) {
        match_.map.head_top = found->second;
        return;
      }
    }
  }

  std::string Quote(int joint) const { return "'" + rig_.joints[joint].name + "'"; }
  void NoteMisplaced(int joint, int ancestor) {
    match_.misplaced.push_back(Quote(joint) + " does not hang from " + Quote(ancestor));
  }

  const Rig& rig_;
  const JointProfile& profile_;
  std::unordered_map<std::string, int> index_;
  NameMatch match_;
};

bool Better(const NameMatch& a, const NameMatch& b) {
  if (a.complete() != b.complete()) return a.complete();
  return a.score > b.score;
}

// A project's joint name ("left_hip", "head") as the profile writes it, normalised.
std::string NameInProfile(const std::string& wanted, const JointProfile& profile) {
  if (wanted == "head") return profile.head;
  const bool left = wanted.starts_with("left_");
  const std::string part = wanted.substr(wanted.find('_') + 1);
  const auto sides = Words(Words(profile.sides)[0], '/');
  for (const Part& p : kParts) {
    if (part == p.name) return WithSide(Words(profile.*p.names)[0], sides[left ? 0 : 1]);
  }
  return wanted;
}

}  // namespace

std::string NormalisedName(std::string_view name, std::string_view prefixes) {
  if (const size_t space = name.find_last_of(":|"); space != std::string_view::npos) {
    name.remove_prefix(space + 1);
  }
  std::string out;
  for (char c : name) {
    if (std::string_view(" _.-").find(c) != std::string_view::npos) continue;
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const std::string& prefix : Words(prefixes)) {
    if (!out.starts_with(prefix)) continue;
    size_t end = prefix.size();
    while (end < out.size() && std::isdigit(static_cast<unsigned char>(out[end]))) ++end;
    return out.substr(end);
  }
  return out;
}

NameMatch MatchNames(const Rig& rig, const JointProfile& profile) {
  NameMatcher matcher(rig, profile);
  std::optional<NameMatch> best;
  for (const std::string& pair : Words(profile.sides)) {
    const auto sides = Words(pair, '/');
    NameMatch match = matcher.Match(sides[0], sides[1]);
    if (!best || Better(match, *best)) best = std::move(match);
  }
  return *best;
}

NameMatch MatchBestProfile(const Rig& rig) {
  std::optional<NameMatch> best;
  for (const JointProfile& profile : JointProfiles()) {
    NameMatch match = MatchNames(rig, profile);
    if (!best || Better(match, *best)) best = std::move(match);
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
    const auto name = NormalisedName(rig.joints[j].name, convention.prefixes);
    ranked.emplace_back(EditDistance(name, target), j);
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
