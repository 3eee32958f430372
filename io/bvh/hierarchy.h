// The HIERARCHY part of a BVH file. Inner part of io/bvh/bvh.h.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/text/cursor.h"
#include "model/rig/rig.h"

namespace retarget::io::bvh {

struct Hierarchy {
  Rig rig;
  std::vector<std::vector<int>> channels;                 // kinds per joint, in file order
  std::vector<std::pair<size_t, size_t>> offset_numbers;  // begin and end of each in the text
  std::vector<std::pair<size_t, size_t>> joint_text;      // from its word to its last brace
  size_t motion_begin = 0;                                // of the word MOTION in the text
  // Of joints with six numbers after OFFSET: the last three, and the line. [joints]
  std::vector<std::optional<Vec3>> second_offset;
  std::vector<int> offset_line;
  std::vector<std::string> warnings;
};

// Reads HIERARCHY ... up to and with the word MOTION.
Hierarchy ReadHierarchy(Cursor* cursor);

}  // namespace retarget::io::bvh
