#include "model/rig/keyed_motion.h"

#include <algorithm>

namespace retarget {

Vec3 TranslationAt(const KeyedMotion& motion, int node, int key, double share) {
  const KeyedNode& n = motion.nodes[node];
  if (n.translation_track < 0) return n.translation;
  const std::vector<Vec3>& track = motion.translation_tracks[n.translation_track];
  if (share == 0) return track[key];
  return (1 - share) * track[key] + share * track[key + 1];
}

Quat RotationAt(const KeyedMotion& motion, int node, int key, double share) {
  const KeyedNode& n = motion.nodes[node];
  if (n.rotation_track < 0) return n.rotation;
  const std::vector<Quat>& track = motion.rotation_tracks[n.rotation_track];
  if (share == 0) return track[key];
  return track[key].slerp(share, track[key + 1]);  // the shorter arc
}

void PlaceNodes(const KeyedMotion& motion, const std::vector<int>& order, int key, double share,
                KeyedPosture* out) {
  out->linear.resize(motion.nodes.size());
  out->origin.resize(motion.nodes.size());
  for (const int n : order) {
    const KeyedNode& node = motion.nodes[n];
    Mat3& own = out->linear[n];
    own.noalias() = RotationAt(motion, n, key, share).toRotationMatrix() * node.stretch;
    out->origin[n] = TranslationAt(motion, n, key, share);
    if (node.parent < 0) continue;
    const Mat3& parent = out->linear[node.parent];
    out->origin[n] = out->origin[node.parent] + parent * out->origin[n];
    own = parent * own;
  }
}

std::vector<int> WithAncestors(const KeyedMotion& motion, const std::vector<int>& nodes) {
  std::vector<char> needed(motion.nodes.size(), 0);
  for (const int n : nodes) needed[n] = 1;
  std::vector<int> order;
  for (size_t n = motion.nodes.size(); n-- > 0;) {
    if (!needed[n]) continue;
    order.push_back(static_cast<int>(n));
    if (motion.nodes[n].parent >= 0) needed[motion.nodes[n].parent] = 1;
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace retarget
