// A tree of nodes that moves by keys, as a scene file holds it: translations linear between two
// keys, rotations spherical-linear along the shorter arc. Knows nothing of bodies or formats.
#pragma once

#include <vector>

#include "model/geometry/types.h"

namespace retarget {

// Local transform: p -> translation + rotation * stretch * p. A track number replaces the fixed
// value; -1 is none.
struct KeyedNode {
  int parent = -1;  // always before this one
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Mat3 stretch = Mat3::Identity();
  int translation_track = -1, rotation_track = -1;
};

struct KeyedMotion {
  std::vector<double> key_times;  // s, ascending, shared by all tracks
  std::vector<KeyedNode> nodes;
  std::vector<std::vector<Vec3>> translation_tracks;  // [tracks][keys] (m)
  std::vector<std::vector<Quat>> rotation_tracks;     // [tracks][keys] unit length

  int num_keys() const { return static_cast<int>(key_times.size()); }
};

// The translation of a node at a share of the way, in [0, 1], from key `key` to the next.
Vec3 TranslationAt(const KeyedMotion& motion, int node, int key, double share);
Quat RotationAt(const KeyedMotion& motion, int node, int key, double share);

// World transforms p -> origin + linear * p. [nodes]
struct KeyedPosture {
  std::vector<Mat3> linear;
  std::vector<Vec3> origin;
};
// Fills the nodes of `order`, ascending, each with all that it hangs from.
void PlaceNodes(const KeyedMotion& motion, const std::vector<int>& order, int key, double share,
                KeyedPosture* out);
// The nodes and all that they hang from, ascending.
std::vector<int> WithAncestors(const KeyedMotion& motion, const std::vector<int>& nodes);

}  // namespace retarget
