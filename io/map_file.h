// Map files: which bone of a rig plays which joint, written by hand or by `retarget map --yaml`
// (docs/map_format.md). The reader is strict: see io/text/document.h.
#pragma once

#include <optional>
#include <string>

#include "model/rig/rig.h"

namespace retarget::io {

struct MapFile {
  JointMap map;  // profile "by hand"
  std::optional<double> metres_per_unit;
  std::optional<char> up;  // 'y' or 'z'
};

// Reads a map for `rig`. Throws InputError, "file:line: joints.left_knee: ...", where a joint or a
// bone is unknown, a required joint has none, one bone plays two joints, or a bone does not hang
// from the one that it should.
MapFile ReadMap(const std::string& path, const Rig& rig);
MapFile ParseMap(const std::string& text, const std::string& name, const Rig& rig);

// The map as a file to edit; reading it gives the same map, unit and up axis.
std::string FormatMap(const RigMotion& motion, const RigFacts& facts);

// The same for a figure that was refused (`reason`): what its names tell, the rest left open.
std::string FormatMapDraft(const RigMotion& motion, const std::string& reason);

}  // namespace retarget::io
