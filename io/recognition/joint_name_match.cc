// The best convention for the names of a rig: MatchNames, MatchBestProfile and NearestNames of
// io/recognition/joint_profiles.h.
#include <algorithm>
#include <utility>

#include "io/recognition/joint_names.h"
#include "io/recognition/joint_profiles.h"
#include "io/recognition/joint_reading.h"
#include "io/text/nearest_name.h"

namespace retarget::io {
namespace {

constexpr const char* kSides = "left/right l/r";  // tried in every convention
constexpr int kRequired = 8;                      // joints

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
  std::vector<std::string> words = SplitWords(profile.root);
  for (const std::string& word : SplitWords(profile.head)) words.push_back(word);
  std::vector<std::string> sides = SplitWords(profile.sides);
  for (const std::string& pair : SplitWords(kSides)) {
    if (std::find(sides.begin(), sides.end(), pair) == sides.end()) sides.push_back(pair);
  }
  std::vector<Reading> readings;
  for (const NameFrame& frame : index.Frames(words, SplitWords(profile.prefixes), kRequired)) {
    for (const bool flipped : {false, true}) {
      for (const std::string& pair : sides) {
        const auto word = SplitWords(pair, '/');
        readings.push_back({frame, word[0], word[1], flipped});
      }
    }
  }
  return readings;
}

NameMatch MatchProfile(const Rig& rig, const NameIndex& index, const JointProfile& profile) {
  std::optional<NameMatch> best;
  for (const Reading& reading : ReadingsOf(index, profile)) {
    NameMatch match = MatchReading(rig, index, profile, reading);
    if (!best || Better(match, *best)) {
      best = std::move(match);
    } else if (match.complete() && match.score == best->score && !SameLimbs(match.map, best->map)) {
      const std::vector<std::string> preferred = SplitWords(profile.prefixes);
      const bool ranked =
          std::find(preferred.begin(), preferred.end(), reading.frame.prefix) != preferred.end();
      if (!ranked) ++best->figures;  // another character's names
    }
  }
  return *best;
}

// A project's joint name ("left_hip", "head") as the profile writes it, normalised.
std::string NameInProfile(const std::string& wanted, const JointProfile& profile) {
  if (wanted == "head") return SplitWords(profile.head)[0];
  if (wanted == "root") return SplitWords(profile.root)[0];
  const bool left = wanted.starts_with("left_");
  const std::string part = wanted.substr(wanted.find('_') + 1);
  const auto sides = SplitWords(SplitWords(profile.sides)[0], '/');
  for (const NamedPart& p : kNamedParts) {
    const auto patterns = SplitWords(profile.*p.names);
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

}  // namespace retarget::io
