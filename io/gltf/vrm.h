// Which bone is which, as VRM files say it. Inner part of io/gltf/clip.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

struct VrmBones {
  std::map<std::string, int> node;  // by the bone's VRM name; empty: the file is no VRM
  bool faces_minus_z = false;       // VRM 0.x
  bool is_animation = false;        // VRMA, whose motion is the file's first
};

// From the extensions of a document (JSON): VRMC_vrm (VRM 1.0), VRMC_vrm_animation (VRMA) or VRM
// (0.x), in this order. Throws InputError where a node does not exist or has two parts.
VrmBones ReadVrmBones(const std::string& extensions, int num_nodes, const std::string& name);

// The same for the joints of a rig. `joint_of_node` [nodes]: -1 where a node is no joint.
JointMap MapOfVrmBones(const VrmBones& bones, const std::vector<int>& joint_of_node);

}  // namespace retarget::io
