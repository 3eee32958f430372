// Questions about the tree of a rig's joints. Parents come before their children.
#pragma once

#include <algorithm>
#include <vector>

#include "model/rig/rig.h"

namespace retarget {

// Whether `joint` is `ancestor` or hangs somewhere below it.
inline bool DescendsFrom(const Rig& rig, int joint, int ancestor) {
  while (joint > ancestor) joint = rig.joints[joint].parent;
  return joint == ancestor && joint >= 0;
}

inline int TopOf(const Rig& rig, int joint) {
  while (rig.joints[joint].parent >= 0) joint = rig.joints[joint].parent;
  return joint;
}

// The lowest joint above both (or one of them); -1 where they share none.
inline int CommonAncestor(const Rig& rig, int a, int b) {
  while (a != b && a >= 0 && b >= 0) (a > b ? a : b) = rig.joints[std::max(a, b)].parent;
  return a == b ? a : -1;
}

// The joints strictly between `ancestor` and `joint`, from the top.
inline std::vector<int> Between(const Rig& rig, int ancestor, int joint) {
  std::vector<int> chain;
  for (int j = rig.joints[joint].parent; j > ancestor; j = rig.joints[j].parent) chain.push_back(j);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

}  // namespace retarget
