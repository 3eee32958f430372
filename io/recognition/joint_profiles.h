// Which joint of a rig plays which part: by its names, where they follow a known convention, or by
// the shape of the tree alone.
//
// Whole conventions are scored, never a union of their words, because the same word is a different
// joint elsewhere: LeftShoulder is the collar bone in Mixamo and the upper arm in classic BVH,
// LeftLeg is the shin in Mixamo and the thigh in SOMA.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

// One naming convention. Names are normalised (NormalisedName); a field may hold several
// alternatives between blanks, the preferred first. '#' stands for the convention's word for the
// side, '@' for the letter l or r. Whatever else stands before or after the words of all names (a
// character's name, "DEF-", "_JNT") is found out from the rig, and side words are also tried at the
// other end: "#foot" finds LeftFoot and Foot.L.
struct JointProfile {
  const char* name;
  const char* prefixes;  // of names that come twice: which of them to read first
  const char* sides;     // pairs "left/right"
  const char* root;
  const char* spine;
  const char* neck;
  const char* head;
  const char* clavicle;
  const char* shoulder;
  const char* elbow;
  const char* wrist;
  const char* hand;  // base of the middle finger, else the nearest thing to it
  const char* hip;
  const char* knee;
  const char* ankle;
  const char* toe;
  const char* extras;  // names that tell this convention from its neighbours
};

std::span<const JointProfile> JointProfiles();

// The name without name space, separators and case: "mixamorig1:LeftUpLeg" -> "leftupleg",
// "Bip01 L Thigh" -> "bip01lthigh".
std::string NormalisedName(std::string_view name);

// How well a rig's names follow one convention. Shoulders, elbows, hips and knees are required.
struct NameMatch {
  JointMap map;                        // complete only if `missing` and `misplaced` are empty
  int score = 0;                       // number of names found
  double share = 0;                    // of the body's joints found by name
  int figures = 1;                     // that have these names
  std::vector<std::string> missing;    // required joints, by the project's names
  std::vector<std::string> misplaced;  // joints that do not hang where a human's do
  std::vector<std::string> ignored;    // bones of other joints that do not
  bool complete() const { return missing.empty() && misplaced.empty(); }
};
NameMatch MatchNames(const Rig& rig, const JointProfile& profile);

// The best of all conventions: complete before incomplete, then by score, then as listed.
struct BestMatch {
  NameMatch match;
  std::optional<NameMatch> rival;  // as complete and with the same score, but other joints
};
BestMatch MatchBestProfile(const Rig& rig);

// Without names: a root with two equal legs and a trunk that ends in two equal arms and a neck, and
// that stands over the legs. `poses` are some frames of the motion, to tell lengths and left from
// right (feet point forwards).
struct ShapeMatch {
  std::optional<JointMap> map;  // where the shape is a human's and can be read in one way only
  std::string refusal;          // else why, where that is clear: "its trunk ..."
};
ShapeMatch MatchShape(const Rig& rig, const std::vector<PosedRig>& poses);

// Why a figure that was told by words alone is no human's; empty where it may be one.
std::string ShapeFault(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map);

// Up to three joints of `rig` whose names come nearest to `wanted`, one of the project's names, as
// `profile` would write it.
std::vector<std::string> NearestNames(const Rig& rig, const std::string& wanted,
                                      const std::string& profile);

}  // namespace retarget::io
