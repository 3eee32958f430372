// Rigs for tests, built by hand from the body tables: a human of 1.75 m in a T-pose that faces +Z,
// Y up, cm, with bones of any names, order and local axes.
#pragma once

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/geometry/so3.h"
#include "model/rig/rig.h"

namespace retarget {

// Joint (root, spine0, spine1, .., neck, head, left_clavicle, ..) -> the rig's name for it.
using JointNames = std::map<std::string, std::string>;

class RigFigure {
 public:
  // A figure with those bones alone that `names` has; the bones beyond hang from the next above.
  explicit RigFigure(const JointNames& names) : body_(StandardBody(AverageMeasures(1.75))) {
    const PosedBody posed = PoseBody(body_, RestPose(body_));
    const auto at = [&](const std::string& node) -> Vec3 {
      return 100 * (posed.node[body_.FindNode(node)] + Vec3(0, 0.95, 0));
    };
    const auto add = [&](const std::string& joint, int parent, const Vec3& where) {
      const auto found = names.find(joint);
      return found == names.end() ? parent : Add(found->second, parent, where);
    };
    const int root = add("root", -1, at("root"));
    int trunk = root, spines = 0;
    while (names.contains("spine" + std::to_string(spines))) ++spines;
    const Vec3 lowest = at("root") + 0.35 * (at("chest") - at("root"));
    for (int n = 0; n < spines; ++n) {
      const double share = spines > 1 ? static_cast<double>(n) / (spines - 1) : 0.5;
      trunk = add("spine" + std::to_string(n), trunk, lowest + share * (at("chest") - lowest));
    }
    const int neck = add("neck", trunk, at("neck"));
    const int head = add("head", neck, at("head"));
    if (names.contains("head")) {
      motion.rig.joints[head].end_site = at("head_top") - at("head");
    }
    for (const std::string side : {"left_", "right_"}) {
      const double x = side == "left_" ? 1 : -1;
      const Vec3 clavicle = at("neck") + Vec3(2 * x, -2, 0);
      int limb = add(side + "clavicle", trunk, clavicle);
      for (const char* joint : {"shoulder", "elbow", "wrist"}) {
        limb = add(side + joint, limb, at(side + joint));
      }
      if (names.contains(side + "wrist")) {
        motion.rig.joints[limb].end_site = at(side + "hand") - at(side + "wrist");
      }
      limb = root;
      for (const char* joint : {"hip", "knee", "ankle"}) {
        limb = add(side + joint, limb, at(side + joint));
      }
      limb = add(side + "toe", limb, at(side + "toe"));
    }
    motion.frame_time = 1.0 / 30;
    Rest();
  }

  // A bone at a place of the rest pose (cm), after all others. Call Rest or Move afterwards.
  int Add(const std::string& name, int parent, const Vec3& where) {
    RigJoint joint;
    joint.name = name;
    joint.parent = parent;
    joint.offset = parent < 0 ? where : Vec3(where - place_[static_cast<size_t>(parent)]);
    joint.translates = parent < 0;
    motion.rig.joints.push_back(joint);
    place_.push_back(where);
    return motion.rig.num_joints() - 1;
  }
  const Vec3& Place(int joint) const { return place_[static_cast<size_t>(joint)]; }

  // One frame: the rest pose.
  void Rest() {
    RigFrame frame;
    for (const RigJoint& joint : motion.rig.joints) {
      frame.translation.push_back(joint.offset);
      frame.rotation.push_back(Quat::Identity());
    }
    motion.frames = {frame};
  }

  // The rest pose, then `count` frames in which every bone turns about at most `most` rad.
  void Move(int count, double most, unsigned seed) {
    Rest();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const RigFrame rest = motion.frames.front();
    std::vector<Vec3> from, to;
    for (size_t j = 0; j < rest.rotation.size(); ++j) {
      from.push_back(0.6 * most * Vec3(number(random), number(random), number(random)));
      to.push_back(0.6 * most * Vec3(number(random), number(random), number(random)));
    }
    for (int k = 0; k < count; ++k) {
      RigFrame frame = rest;
      const double u = static_cast<double>(k) / count;
      for (size_t j = 0; j < from.size(); ++j) {
        frame.rotation[j] = ExpSo3((1 - u) * from[j] + u * to[j]);
      }
      frame.translation[0] += Vec3(20 * u, -3 * u, 5);
      motion.frames.push_back(frame);
    }
  }

  // The same motion with other local axes on every bone, as glTF rigs have them.
  void TurnAxes(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-2, 2);
    std::vector<Quat> turn;  // new axes in the old ones
    for (int j = 0; j < motion.rig.num_joints(); ++j) {
      turn.push_back(ExpSo3(Vec3(number(random), number(random), number(random))));
    }
    const auto above = [&](size_t j) {
      const int parent = motion.rig.joints[j].parent;
      return parent < 0 ? Quat::Identity() : turn[static_cast<size_t>(parent)];
    };
    for (size_t j = 0; j < turn.size(); ++j) {
      RigJoint& joint = motion.rig.joints[j];
      joint.offset = above(j).conjugate() * joint.offset;
      if (joint.end_site) joint.end_site = turn[j].conjugate() * *joint.end_site;
      for (RigFrame& frame : motion.frames) {
        frame.translation[j] = above(j).conjugate() * frame.translation[j];
        frame.rotation[j] = above(j).conjugate() * frame.rotation[j] * turn[j];
      }
    }
  }

  // The same rig with its joints in another order, parents first.
  void Shuffle(unsigned seed) {
    std::mt19937 random(seed);
    const Rig old = motion.rig;
    std::vector<int> open, order, place(old.joints.size(), -1);
    for (int j = 0; j < old.num_joints(); ++j) {
      if (old.joints[static_cast<size_t>(j)].parent < 0) open.push_back(j);
    }
    while (!open.empty()) {
      std::swap(open[random() % open.size()], open.back());
      const int j = open.back();
      open.pop_back();
      place[static_cast<size_t>(j)] = static_cast<int>(order.size());
      order.push_back(j);
      for (const int child : old.ChildrenOf(j)) open.push_back(child);
    }
    const std::vector<RigFrame> frames = motion.frames;
    for (size_t n = 0; n < order.size(); ++n) {
      const auto from = static_cast<size_t>(order[n]);
      RigJoint joint = old.joints[from];
      if (joint.parent >= 0) joint.parent = place[static_cast<size_t>(joint.parent)];
      motion.rig.joints[n] = joint;
      for (size_t k = 0; k < frames.size(); ++k) {
        motion.frames[k].translation[n] = frames[k].translation[from];
        motion.frames[k].rotation[n] = frames[k].rotation[from];
      }
    }
  }

  RigMotion motion;

 private:
  Body body_;
  std::vector<Vec3> place_;  // of every joint in the rest pose
};

// Mixamo's names for every joint, with so many spine bones.
inline JointNames MixamoNames(int spines) {
  JointNames names = {{"root", "Hips"}, {"neck", "Neck"}, {"head", "Head"}};
  for (int n = 0; n < spines; ++n) {
    names["spine" + std::to_string(n)] = n == 0 ? "Spine" : "Spine" + std::to_string(n);
  }
  for (const auto& [side, word] : {std::pair("left_", "Left"), std::pair("right_", "Right")}) {
    for (const auto& [joint, name] :
         {std::pair("clavicle", "Shoulder"), std::pair("shoulder", "Arm"),
          std::pair("elbow", "ForeArm"), std::pair("wrist", "Hand"), std::pair("hip", "UpLeg"),
          std::pair("knee", "Leg"), std::pair("ankle", "Foot"), std::pair("toe", "ToeBase")}) {
      names[std::string(side) + joint] = std::string(word) + name;
    }
  }
  return names;
}

}  // namespace retarget
