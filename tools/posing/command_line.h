// Operations as words of the command line: an option's name and its value.
#pragma once

#include <string>
#include <vector>

#include "tools/posing/state.h"

namespace retarget::posing {

// The options that do something to a posture, for the command line's table of contents.
struct PoseWord {
  std::string name;   // "hold"
  std::string alias;  // its name in JSON where that differs: "add-hold"; may be empty
  std::string value;  // how its value reads; empty: takes none
  std::string help;
};
std::vector<PoseWord> PoseWords();

// By name or alias. Throws InputError:
// "--drag a/left_hnad=0,1,0: unknown node "left_hnad", did you mean ...".
PoseStep ParsePoseStep(const std::string& name, const std::string& value, const PoseState& state);

}  // namespace retarget::posing
