// A rig as a file brings it, whatever the format: named joints with local transforms. Units, up
// axis and rest pose are the file's own; model/rig/binding.h lays the body of model/body/body.h
// into it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/geometry/types.h"

namespace retarget {

struct RigJoint {
  std::string name;
  int parent = -1;               // joint, always before this one; -1 for a root
  Vec3 offset = Vec3::Zero();    // rest translation in the parent's frame (file units)
  std::optional<Vec3> end_site;  // a leaf's end point in its own frame (file units)
  // Straight above the joint at rest, where the skin of it and its children is highest, in its own
  // frame (file units); of a character with a mesh.
  std::optional<Vec3> skin_top = {};
  bool translates = false;  // the file moves this joint (position channels on all axes)
  // The format lets it be moved, whether the file does so or not.
  bool can_translate = false;
  Quat rest_rotation = Quat::Identity();  // in the parent's frame; of a BVH always this
  // A joint that the file can only turn about some axes (unit, in its own frame at rest): its
  // rotation is the product of turns about them, the first leftmost. None: a rigid bone.
  bool turns_freely = true;
  std::vector<Vec3> turn_axes = {};
};

struct Rig {
  std::vector<RigJoint> joints;
  int num_joints() const { return static_cast<int>(joints.size()); }
  int Find(const std::string& name) const;  // -1 where there is none
  std::vector<int> ChildrenOf(int joint) const;
};

// Local transform of every joint: translation (file units, replaces the offset), rotation, and the
// scale of all that hangs from the joint, along the joint's own axes: p -> translation + rotation *
// scale .* p. Most rigs are rigid; their frames have no scales.
struct RigFrame {
  std::vector<Vec3> translation;
  std::vector<Quat> rotation;
  std::vector<Vec3> scale = {};  // empty: 1 everywhere
};

struct RigMotion {
  Rig rig;
  double frame_time = 1.0 / 30;  // s
  std::vector<RigFrame> frames;
  int num_frames() const { return static_cast<int>(frames.size()); }
};

// World transform of every joint (file units, file axes). Positions are exact: below an uneven
// scale that is not its axes turn with the joints, so that what hangs there is sheared. `rotation`
// is the product of the rotations alone.
struct PosedRig {
  std::vector<Quat> rotation;
  std::vector<Vec3> position;
  // The linear part: what hangs from joint j at p stands at position[j] + linear[j] p. Empty where
  // the frame has no scales: `rotation` says it all.
  std::vector<Mat3> linear = {};
};
PosedRig PoseRig(const Rig& rig, const RigFrame& frame);

// Frame at `time` seconds (clamped to the clip): linear in translations and scales,
// spherical-linear in rotations. A time within a thousandth of a frame of a key gives that key
// itself.
RigFrame SampleRig(const RigMotion& motion, double time);

// Which rig joint plays which part. Indices of rig joints, -1 where the rig has none.
struct JointMap {
  std::string profile;  // "mixamo", "cmu", ..., or "topology"
  int root = -1;
  std::vector<int> spine;  // bones between root and neck, in order (may be empty)
  std::vector<int> neck;   // neck bones, in order (may be empty)
  int head = -1;
  struct Side {
    int clavicle = -1, shoulder = -1, elbow = -1, wrist = -1;
    int hand = -1;  // base of the middle finger, where there is one
    int hip = -1, knee = -1, ankle = -1;
    int toe = -1;  // toe joint, where there is one
  };
  Side left, right;
  int head_top = -1;  // a joint at the vertex (HeadTop_End), where there is one
};

// A joint that goes with a bone which it does not hang from, as a target of inverse kinematics
// does.
struct RigFollower {
  int joint = -1, bone = -1;
};
// Calls visit(int* joint) for every joint of a map, absent ones included.
template <typename Visit>
void VisitJoints(JointMap* map, const Visit& visit) {
  visit(&map->root);
  for (int& joint : map->spine) visit(&joint);
  for (int& joint : map->neck) visit(&joint);
  visit(&map->head);
  visit(&map->head_top);
  for (JointMap::Side* s : {&map->left, &map->right}) {
    for (int* joint : {&s->clavicle, &s->shoulder, &s->elbow, &s->wrist, &s->hand, &s->hip,
                       &s->knee, &s->ankle, &s->toe}) {
      visit(joint);
    }
  }
}

// What was recognised in a file.
struct RigFacts {
  JointMap map;
  double metres_per_unit = 0.01;
  std::string unit_name = "cm";             // "m", "cm", "mm", "dm", "in", "cmu" or number
  char up = 'y';                            // 'y' or 'z'
  double stature = 0;                       // m
  std::vector<int> t_pose_frames;           // at the start of the clip
  double confidence = 1;                    // 0 to 1: how far names and shape agree with the map
  std::vector<std::string> virtual_joints;  // the project's joints that no bone plays
  std::vector<RigFollower> followers;       // parents before their children
  double facing = 0;               // rad about up from the file's +z (up y) or -y (up z), standing
  std::vector<std::string> notes;  // warnings for the user, one line each
};

}  // namespace retarget
