// How the numbers after OFFSET and the position channels of a BVH file belong together. Inner part
// of io/bvh/bvh.h.
#pragma once

#include <string>

#include "io/bvh/bvh.h"
#include "io/bvh/hierarchy.h"

namespace retarget::io::bvh {

// `file` has its frames, position channels in place of the OFFSETs. Where they can only be
// displacements from the OFFSETs, adds these, fills `adds_offset` and warns.
void AddOffsetsToDisplacements(BvhFile* file);

// Warns of six numbers after OFFSET, of which the first three are read. Throws InputError, one line
// with file and line, where the position channels stand at the last three.
void CheckSecondOffsets(const Hierarchy& hierarchy, const std::string& name, BvhFile* file);

}  // namespace retarget::io::bvh
