// Questions about the tree of a rig's joints. Parents come before their children.
#pragma once

#include <algorithm>
#include <utility>
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

// The joints that carry `joint`, it, and all below it, in order.
inline std::vector<int> BranchOf(const Rig& rig, int joint) {
  std::vector<int> out;
  for (int j = 0; j < rig.num_joints(); ++j) {
    if (DescendsFrom(rig, joint, j) || DescendsFrom(rig, j, joint)) out.push_back(j);
  }
  return out;
}

// The motion of some joints alone: `joints` in order, and with all that carry them.
inline RigMotion MotionOfJoints(const RigMotion& motion, const std::vector<int>& joints) {
  RigMotion out;
  out.frame_time = motion.frame_time;
  std::vector<int> place(motion.rig.joints.size(), -1);
  for (const int j : joints) {
    place[j] = out.rig.num_joints();
    RigJoint joint = motion.rig.joints[j];
    if (joint.parent >= 0) joint.parent = place[joint.parent];
    out.rig.joints.push_back(std::move(joint));
  }
  for (const RigFrame& frame : motion.frames) {
    RigFrame cut;
    for (const int j : joints) {
      cut.translation.push_back(frame.translation[j]);
      cut.rotation.push_back(frame.rotation[j]);
    }
    out.frames.push_back(std::move(cut));
  }
  return out;
}

}  // namespace retarget
