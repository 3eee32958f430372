#include "model/rig/mirror.h"

#include <cctype>
#include <cstddef>
#include <string>
#include <utility>

namespace retarget {
namespace {

Vec3 Reflected(const Vec3& v) { return {-v.x(), v.y(), v.z()}; }

// M q M of the reflection M = diag(-1, 1, 1).
Quat Reflected(const Quat& q) { return Quat(q.w(), q.x(), -q.y(), -q.z()); }

int DepthOf(const Rig& rig, int joint) {
  int depth = 0;
  for (int j = joint; j >= 0; j = rig.joints[j].parent) ++depth;
  return depth;
}

// The joint whose name is this one's with one mark of a side exchanged; -1 where there is none.
int ByName(const Rig& rig, int joint) {
  constexpr std::pair<const char*, const char*> kMarks[] = {
      {"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}, {"L", "R"}, {"l", "r"}};
  const std::string& name = rig.joints[joint].name;
  for (const auto& [left, right] : kMarks) {
    for (const auto& [from, to] : {std::pair(left, right), std::pair(right, left)}) {
      const std::string word = from;
      for (size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
        std::string other = name;
        other.replace(at, word.size(), to);
        const int found = rig.Find(other);
        if (found >= 0 && DepthOf(rig, found) == DepthOf(rig, joint)) return found;
      }
    }
  }
  return -1;
}

RigFrame RestFrame(const Rig& rig) {
  RigFrame rest;
  for (const RigJoint& joint : rig.joints) {
    rest.translation.push_back(joint.offset);
    rest.rotation.push_back(joint.rest_rotation);
  }
  return rest;
}

}  // namespace

std::vector<int> Counterparts(const Rig& rig, const JointMap& map) {
  std::vector<int> out(rig.joints.size(), -1);
  const auto pair = [&](int a, int b) {
    if (a < 0 || b < 0) return;
    out[a] = b;
    out[b] = a;
  };
  using Side = JointMap::Side;
  for (const auto part : {&Side::clavicle, &Side::shoulder, &Side::elbow, &Side::wrist, &Side::hand,
                          &Side::hip, &Side::knee, &Side::ankle, &Side::toe}) {
    pair(map.left.*part, map.right.*part);
  }
  for (const std::vector<int>& middle : {map.spine, map.neck, {map.root, map.head, map.head_top}}) {
    for (const int joint : middle) pair(joint, joint);
  }
  for (int j = 0; j < rig.num_joints(); ++j) {
    if (out[j] >= 0) continue;
    const int other = ByName(rig, j);
    if (other >= 0 && out[other] < 0 && ByName(rig, other) == j) pair(j, other);
    if (out[j] < 0) out[j] = j;
  }
  return out;
}

RigMotion Mirrored(const RigMotion& motion, const std::vector<int>& counterparts) {
  const Rig& rig = motion.rig;
  const PosedRig rest = PoseRig(rig, RestFrame(rig));
  RigMotion out = motion;
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    const PosedRig posed = PoseRig(rig, motion.frames[t]);
    std::vector<Quat> world(rig.joints.size());
    for (int j = 0; j < rig.num_joints(); ++j) {
      const int c = counterparts[j], parent = rig.joints[j].parent;
      // The counterpart's turn from its rest, reflected, on this joint's rest.
      world[j] = Reflected(posed.rotation[c] * rest.rotation[c].conjugate()) * rest.rotation[j];
      RigFrame& frame = out.frames[t];
      frame.rotation[j] = parent < 0 ? world[j] : world[parent].conjugate() * world[j];
      const RigJoint& other = rig.joints[c];
      const Vec3 moved = motion.frames[t].translation[c];
      if (parent < 0 || other.parent < 0) {
        frame.translation[j] = Reflected(moved);
      } else {
        const Vec3 beyond = posed.rotation[other.parent] * (moved - other.offset);
        frame.translation[j] = rig.joints[j].offset + world[parent].conjugate() * Reflected(beyond);
      }
    }
  }
  return out;
}

}  // namespace retarget
