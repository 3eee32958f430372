#include "model/rig/rig.h"

#include <algorithm>
#include <cmath>

namespace retarget {

int Rig::Find(const std::string& name) const {
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name == name) return static_cast<int>(j);
  }
  return -1;
}

std::vector<int> Rig::ChildrenOf(int joint) const {
  std::vector<int> children;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].parent == joint) children.push_back(static_cast<int>(j));
  }
  return children;
}

namespace {

PosedRig PoseScaledRig(const Rig& rig, const RigFrame& frame) {
  PosedRig posed;
  for (size_t j = 0; j < rig.joints.size(); ++j) {
    const int parent = rig.joints[j].parent;
    const Mat3 own = frame.rotation[j].toRotationMatrix() * frame.scale[j].asDiagonal();
    if (parent < 0) {
      posed.rotation.push_back(frame.rotation[j]);
      posed.position.push_back(frame.translation[j]);
      posed.linear.push_back(own);
    } else {
      posed.rotation.push_back(posed.rotation[parent] * frame.rotation[j]);
      posed.position.push_back(posed.position[parent] +
                               posed.linear[parent] * frame.translation[j]);
      posed.linear.push_back(posed.linear[parent] * own);
    }
  }
  return posed;
}

}  // namespace

PosedRig PoseRig(const Rig& rig, const RigFrame& frame) {
  if (!frame.scale.empty()) return PoseScaledRig(rig, frame);
  PosedRig posed;
  posed.rotation.resize(rig.joints.size());
  posed.position.resize(rig.joints.size());
  for (size_t j = 0; j < rig.joints.size(); ++j) {
    const int parent = rig.joints[j].parent;
    if (parent < 0) {
      posed.rotation[j] = frame.rotation[j];
      posed.position[j] = frame.translation[j];
    } else {
      posed.rotation[j] = posed.rotation[parent] * frame.rotation[j];
      posed.position[j] = posed.position[parent] + posed.rotation[parent] * frame.translation[j];
    }
  }
  return posed;
}

RigFrame SampleRig(const RigMotion& motion, double time) {
  const double last = motion.num_frames() - 1;
  const double at = std::clamp(time / motion.frame_time, 0.0, last);
  const double nearest = std::round(at);
  if (std::abs(at - nearest) < 1e-3) return motion.frames[static_cast<size_t>(nearest)];
  const size_t k = static_cast<size_t>(at);
  const double u = at - static_cast<double>(k);
  const RigFrame& a = motion.frames[k];
  const RigFrame& b = motion.frames[k + 1];
  RigFrame out = a;
  for (size_t j = 0; j < a.rotation.size(); ++j) {
    out.translation[j] = (1 - u) * a.translation[j] + u * b.translation[j];
    out.rotation[j] = a.rotation[j].slerp(u, b.rotation[j]);
  }
  for (size_t j = 0; j < a.scale.size(); ++j) {
    out.scale[j] = (1 - u) * a.scale[j] + u * b.scale[j];
  }
  return out;
}

}  // namespace retarget
