// One convention read in one way against the names of a rig. Inner part of
// io/recognition/joint_profiles.h.
#pragma once

#include <string>
#include <string_view>

#include "io/recognition/joint_names.h"
#include "io/recognition/joint_profiles.h"

namespace retarget::io {

// The joints of a side as a convention names them.
struct NamedPart {
  const char* name;
  const char* JointProfile::*names;
  int JointMap::Side::*joint;
  bool required;
};
inline constexpr NamedPart kNamedParts[] = {
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

// One way to read the names of a rig by a convention.
struct Reading {
  NameFrame frame;
  std::string left, right;  // words for the sides
  bool flipped = false;     // they stand at the other end

  // A name of the convention, with the word for its side, as the rig would have it (normalised).
  std::string Name(std::string_view pattern, std::string_view side) const;
};

NameMatch MatchReading(const Rig& rig, const NameIndex& index, const JointProfile& profile,
                       const Reading& reading);

}  // namespace retarget::io
