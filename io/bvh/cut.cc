// CutBvh of io/bvh/bvh.h.
#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "io/bvh/bvh.h"
#include "io/bvh/hierarchy.h"
#include "io/text/cursor.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

// The hierarchy without the text of the joints that are not kept, blanks before it included.
std::string CutHierarchy(const BvhFile& file, const std::vector<bool>& kept) {
  const std::string whole = file.hierarchy_text + "MOTION";
  bvh::Cursor cursor(whole, "hierarchy");
  const bvh::Hierarchy hierarchy = bvh::ReadHierarchy(&cursor);
  std::string out;
  size_t at = 0;
  for (size_t j = 0; j < kept.size(); ++j) {
    const auto& [begin, end] = hierarchy.joint_text[j];
    if (kept[j] || begin < at) continue;
    out += file.hierarchy_text.substr(at, begin - at);
    while (!out.empty() && bvh::IsSpace(out.back())) out.pop_back();
    at = end;
  }
  if (at > 0 && at < file.hierarchy_text.size() && !bvh::IsSpace(file.hierarchy_text[at])) {
    out += '\n';
  }
  return out + file.hierarchy_text.substr(at);
}

}  // namespace

BvhFile CutBvh(const BvhFile& file, const std::vector<int>& joints) {
  BvhFile out = file;
  std::vector<bool> kept(file.channels.size(), false);
  out.channels.clear();
  out.adds_offset.clear();
  for (const int j : joints) {
    kept[j] = true;
    out.channels.push_back(file.channels[j]);
    if (!file.adds_offset.empty()) out.adds_offset.push_back(file.adds_offset[j]);
  }
  out.motion = MotionOfJoints(file.motion, joints);
  out.hierarchy_text = CutHierarchy(file, kept);
  return out;
}

}  // namespace retarget::io
