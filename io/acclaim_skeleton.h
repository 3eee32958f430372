// The skeleton (ASF) of an Acclaim motion. Inner part of io/acclaim.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/acclaim.h"

namespace retarget::acclaim {

struct Skeleton {
  Rig rig;  // joint 0 is the root
  std::vector<AcclaimBone> bones;
  std::unordered_map<std::string, int> joint_of_name;  // by lower-case name
  double length_unit = 1;
  bool degrees = true;
  std::vector<std::pair<size_t, size_t>> length_numbers;  // begin and end of each in the text
};

std::string LowerCase(std::string_view word);

// -1 for a word that is no degree of freedom.
int DofKind(std::string_view word);

Skeleton ReadSkeleton(std::string_view text, const std::string& name);

}  // namespace retarget::acclaim
