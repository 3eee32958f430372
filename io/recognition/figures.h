// The people of a file that holds several.
#pragma once

#include <string>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

struct FileFigure {
  std::string name;  // of its topmost joint
  int joint = -1;    // that joint: what hangs from it is the figure's
};

// The figures of a motion in the order of its joints: the lowest branches that hold a human each,
// and roots of many joints that are not recognised. Layers of a control rig ("DEF-spine",
// "ORG-spine") that stand in one place throughout are one figure, the first of them.
std::vector<FileFigure> FindFigures(const RigMotion& motion);

// The figure of that name or else number (from 0), or else the branch of the joint of that name.
// Throws InputError, one line that begins with `file` and lists the figures, where there is none.
FileFigure SelectFigure(const RigMotion& motion, const std::string& figure,
                        const std::string& file);

}  // namespace retarget::io
