// Written files played by the rules of their formats alone, to check what was written. Shares no
// code with the readers and writers of clips (io/bvh, io/acclaim, io/gltf/read.cc): it knows no
// rig, no units and no body, multiplies matrices from the root to the joint, and tells where joints
// stand. What it takes for granted, such as well-formed numbers, the readers have checked.
#pragma once

#include <string>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

// A written file in memory.
struct PlayedFile {
  std::string format;     // "BVH", "glTF" or "Acclaim"
  std::string name;       // for messages
  std::string bytes;      // of an Acclaim motion the AMC
  std::string skeleton;   // the ASF of it
  std::string folder;     // where the buffers are that a .gltf names
  std::string animation;  // glTF: the name of the one to play
  double fps = 120;       // Acclaim: which does not say
  int rest_frames = 0;    // BVH: frames before the motion, such as a T-pose
  // BVH: joints, counted in the file from 0, whose position channels are added to their OFFSET; of
  // all others they stand for it.
  std::vector<int> displaced = {};
};

// A joint by its name, the first of that name; of glTF by its node's index where that is given.
struct PlayedJoint {
  std::string name;
  int node = -1;
};

struct Played {
  double seconds = 0;                       // from the first key to the last
  std::vector<std::vector<Vec3>> position;  // [times][joints] in the file's units and axes
};

// Where `joints` stand at `times` (s from the motion's first key, held beyond the last). Between
// keys translations and scales are linear, rotations spherical-linear, as glTF has it. Throws
// InputError, one line that begins with the file's name, where the file has no such joint or cannot
// be played.
Played Play(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
            const std::vector<double>& times);

}  // namespace retarget::io
