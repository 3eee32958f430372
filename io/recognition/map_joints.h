// A joint map by the project's names, for tables, files and messages. Inner part of
// io/recognition/recognise.h.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/recognition/rig_measure.h"
#include "model/rig/rig.h"

namespace retarget::io {

// The project's joints and end nodes in order, with the rig joint that plays each, -1 where none
// does. `chest_bone` as ChestBone of io/recognition/recognise.h.
std::vector<std::pair<std::string, int>> NamedJoints(const JointMap& map, int chest_bone);

// The joints of the body (not the end nodes) that no bone plays.
std::vector<std::string> VirtualJoints(const RigMeasure& figure);

// The parts of one side, as the names above and map files have them.
struct SidePart {
  const char* name;
  int JointMap::Side::*joint;
  bool required;
};
inline constexpr SidePart kSideParts[] = {{"clavicle", &JointMap::Side::clavicle, false},
                                          {"shoulder", &JointMap::Side::shoulder, true},
                                          {"elbow", &JointMap::Side::elbow, true},
                                          {"wrist", &JointMap::Side::wrist, false},
                                          {"hand", &JointMap::Side::hand, false},
                                          {"hip", &JointMap::Side::hip, true},
                                          {"knee", &JointMap::Side::knee, true},
                                          {"ankle", &JointMap::Side::ankle, false},
                                          {"toe", &JointMap::Side::toe, false}};

}  // namespace retarget::io
