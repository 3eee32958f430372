// Recognition; the files that it includes do its parts.
#include "io/recognition/recognise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/recognition/joint_profiles.h"
#include "io/recognition/joint_words.h"
#include "io/recognition/limb_words.h"
#include "io/recognition/loose_bones.h"
#include "io/recognition/map_joints.h"
#include "io/recognition/open_parts.h"
#include "io/recognition/rig_check.h"
#include "io/recognition/rig_measure.h"
#include "io/recognition/rig_units.h"
#include "io/recognition/t_pose.h"
#include "io/text/quoted.h"

namespace retarget::io {
namespace {

// --- Which joint is which ---

std::string QuotedList(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) {
    out += (out.empty() ? "'" : ", '") + Printable(name) + "'";
  }
  return out;
}

struct Refusal {
  const std::string& file;
  const OptionWords& words;
};

// Every refusal ends with the way out.
[[noreturn]] void RefuseFigure(const Refusal& refusal, const std::string& why) {
  std::string by_hand = refusal.words.map_by_hand;
  const size_t at = by_hand.find("{}");
  if (at != std::string::npos) by_hand.replace(at, 2, refusal.file);
  throw InputError(
      fmt::format("{}: no human figure: {}; to map it by hand: {}", refusal.file, why, by_hand));
}

std::string MissingJoints(const Rig& rig, const NameMatch& match) {
  constexpr size_t kShown = 4;
  std::string missing;
  for (size_t n = 0; n < std::min(kShown, match.missing.size()); ++n) {
    missing += (n > 0 ? ", " : "") + match.missing[n];
  }
  if (match.missing.size() > kShown) {
    missing += fmt::format(" and {} more", match.missing.size() - kShown);
  }
  return fmt::format("nothing plays {} (nearest convention '{}'); the names nearest to {} are {}",
                     missing, match.map.profile, match.missing.front(),
                     QuotedList(NearestNames(rig, match.missing.front(), match.map.profile)));
}

// The limb that two readings of the names give to different joints.
[[noreturn]] void RefuseTie(const Rig& rig, const JointMap& a, const JointMap& b,
                            const Refusal& refusal) {
  using Side = JointMap::Side;
  constexpr std::pair<const char*, int Side::*> kLimbs[] = {{"shoulder", &Side::shoulder},
                                                            {"elbow", &Side::elbow},
                                                            {"hip", &Side::hip},
                                                            {"knee", &Side::knee}};
  for (const auto& [side, name] :
       {std::pair(&JointMap::left, "left"), {&JointMap::right, "right"}}) {
    for (const auto& [part, joint] : kLimbs) {
      const int first = a.*side.*joint, second = b.*side.*joint;
      if (first == second) continue;
      RefuseFigure(refusal,
                   fmt::format("{}_{} may be '{}' (as '{}' has it) or '{}' (as '{}' has it)", name,
                               part, Printable(rig.joints[first].name), a.profile,
                               Printable(rig.joints[second].name), b.profile));
    }
  }
  RefuseFigure(refusal, "its names can be read in two ways");
}

JointMap FindJoints(const RigMotion& motion, const Refusal& refusal, RigFacts* facts) {
  const Rig& rig = motion.rig;
  const auto [match, rival] = MatchBestProfile(rig);
  if (match.complete()) {
    if (rival) RefuseTie(rig, match.map, rival->map, refusal);
    facts->confidence = match.share;
    for (const std::string& bone : match.ignored) {
      facts->notes.push_back("'" + Printable(bone) + "' hangs where no human has it: left out");
    }
    if (match.figures > 1) {
      facts->notes.push_back(fmt::format(
          "the file holds {} figures with the same names: the first one is read", match.figures));
    }
    return match.map;
  }
  const std::vector<JointWords> words = ReadJointWords(rig);
  const NameMatch by_words = MatchWords(rig, words, SamplePoses(motion));
  if (by_words.complete()) {
    const std::string fault = ShapeFault(rig, SamplePoses(motion), by_words.map);
    if (!fault.empty()) RefuseFigure(refusal, fault);
    facts->confidence = by_words.share;
    facts->notes.push_back(
        "the joint names follow no known convention: joints were told by the words in them");
    return by_words.map;
  }
  ShapeMatch shape = MatchShape(rig, SamplePoses(motion));
  if (shape.map) {
    facts->confidence = 0;
    facts->notes.push_back(
        "the joint names follow no known convention: joints were told by shape alone");
    return *shape.map;
  }
  constexpr int kFewest = 9;  // joints: a root and four limbs of two
  if (rig.num_joints() < kFewest) {
    RefuseFigure(refusal, fmt::format("it has {} joint{}, a human at least {}", rig.num_joints(),
                                      rig.num_joints() == 1 ? "" : "s", kFewest));
  }
  if (!shape.refusal.empty()) RefuseFigure(refusal, shape.refusal);
  if (!match.missing.empty()) RefuseFigure(refusal, MissingJoints(rig, match));
  RefuseFigure(refusal, fmt::format("its names follow '{}', but {}", match.map.profile,
                                    Printable(match.misplaced.front())));
}

// Feet that a convention's reading has left out because of what they hang from.
void TakeLooseFeet(const RigMotion& motion, RigFacts* facts) {
  for (const std::string& name : FindLooseFeet(motion, &facts->map)) {
    const std::string bone = "'" + Printable(name) + "'";
    std::erase(facts->notes, bone + " hangs where no human has it: left out");
    facts->notes.push_back(bone +
                           " does not hang from its shin, but stands at the end of it: the "
                           "ankle");
  }
}

void NoteFollowers(const RigMotion& motion, const OptionWords& words, RigFacts* facts) {
  facts->followers = FindFollowers(motion, facts->map, facts->metres_per_unit, facts->stature);
  constexpr size_t kShown = 6;
  std::string list;
  for (size_t n = 0; n < std::min(kShown, facts->followers.size()); ++n) {
    const auto& [joint, bone] = facts->followers[n];
    list += fmt::format("{}'{}' goes with '{}'", n > 0 ? ", " : "",
                        Printable(motion.rig.joints[joint].name),
                        Printable(motion.rig.joints[bone].name));
  }
  if (facts->followers.size() > kShown) {
    list += fmt::format(" and {} more", facts->followers.size() - kShown);
  }
  if (!list.empty())
    facts->notes.push_back(fmt::format("{} ({} keep: not)", list, words.ik_targets));
}

// What the first look has left open.
void FillJoints(const RigMotion& motion, RigFacts* facts) {
  std::string list;
  for (const std::string& part :
       FillOpenParts(motion.rig, ReadJointWords(motion.rig), SamplePoses(motion), &facts->map)) {
    list += (list.empty() ? "" : ", ") + Printable(part);
  }
  if (!list.empty()) facts->notes.push_back("told by their place in the tree: " + list);
}

}  // namespace

RigFacts Recognise(const RigMotion& motion, const RecogniseOptions& options,
                   const std::string& file_name) {
  if (motion.frames.empty() || motion.rig.joints.empty()) {
    throw InputError(file_name + ": no frames of any joint, expected a motion");
  }
  RigFacts facts;
  if (options.map) {
    facts.map = *options.map;
  } else {
    facts.map = FindJoints(motion, {file_name, options.words}, &facts);
    FillJoints(motion, &facts);
    TakeLooseFeet(motion, &facts);
  }
  const RigMeasure figure(motion, facts.map);
  RefuseLimbsWithoutLength(figure, file_name);
  FindUnit(FigureHeight(figure), options, file_name, &facts);
  FindUp(figure, options, file_name, &facts);
  CheckRig(figure, &facts);
  NoteFollowers(motion, options.words, &facts);
  facts.t_pose_frames = TPoseFrames(motion, figure.points, UpAxis(facts));
  NoteTPose(motion, figure.points, options.words, &facts);
  return facts;
}

}  // namespace retarget::io
