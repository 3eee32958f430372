// The skeleton (ASF) of an Acclaim motion. Inner part of io/acclaim/acclaim.h.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/acclaim/acclaim.h"
#include "io/acclaim/text.h"

namespace retarget::io::acclaim {

struct Skeleton {
  Rig rig;  // joint 0 is the root
  std::vector<AcclaimBone> bones;
  std::unordered_map<std::string, int> joint_of_name;  // by lower-case name
  double length_unit = 1;
  bool degrees = true;
  std::vector<std::pair<size_t, size_t>> length_numbers;  // begin and end of each in the text
};

// A bone as its block states it. Block 0 is the root, whose direction is its position.
struct BoneBlock {
  std::string name;
  Vec3 direction = Vec3::Zero();
  double length = 0;
  Vec3 axis_angles = Vec3::Zero();  // file's angle unit
  std::array<int, 3> axis_order = {0, 1, 2};
  std::vector<int> dofs;
  int parent = -1;
  std::vector<int> children;
};

// Lays the bones out from the root (the first), parents before children, and fills the rig, the
// bones and the joints of the names. `lines` is where messages point to.
void Assemble(const std::vector<BoneBlock>& blocks, const LineReader& lines, Skeleton* skeleton);

std::string LowerCase(std::string_view word);

Skeleton ReadSkeleton(std::string_view text, const std::string& name);

}  // namespace retarget::io::acclaim
