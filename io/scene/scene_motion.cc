// Playback; scene_motion_read.cc reads.
#include "io/scene/scene_motion.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace retarget::io {
namespace {

// The rotation of a linear map: of its polar decomposition, unless it is one already.
Quat NearestRotation(const Mat3& linear) {
  const bool is_rotation = linear.isUnitary(1e-9) && linear.determinant() > 0;
  return Quat(is_rotation ? linear : Mat3(Eigen::Affine3d(linear).rotation())).normalized();
}

}  // namespace

std::vector<int> SceneMotion::FindNodes(const std::string& figure,
                                        const std::vector<std::string>& node_names) const {
  std::vector<int> nodes;
  for (const std::string& node_name : node_names) {
    const auto found = node_of_name_.find(figure + "/" + node_name);
    if (found == node_of_name_.end()) {
      throw InputError(fmt::format("{}: no node \"{}/{}\"", name_, figure, node_name));
    }
    nodes.push_back(found->second);
  }
  return nodes;
}

SceneMotion::Instant SceneMotion::At(double t) const {
  const auto after = std::upper_bound(key_times.begin(), key_times.end(), t);
  if (after == key_times.begin()) return {0, 0.0};
  const size_t key = static_cast<size_t>(after - key_times.begin()) - 1;
  if (after == key_times.end()) return {key, 0.0};
  return {key, (t - key_times[key]) / (*after - key_times[key])};
}

Vec3 SceneMotion::TranslationAt(const Node& node, const Instant& instant) const {
  if (node.translation_track < 0) return node.translation;
  const std::vector<Vec3>& track = translation_tracks_[node.translation_track];
  if (instant.share == 0.0) return track[instant.key];
  return (1.0 - instant.share) * track[instant.key] + instant.share * track[instant.key + 1];
}

Quat SceneMotion::RotationAt(const Node& node, const Instant& instant) const {
  if (node.rotation_track < 0) return node.rotation;
  const std::vector<Quat>& track = rotation_tracks_[node.rotation_track];
  if (instant.share == 0.0) return track[instant.key];
  return track[instant.key].slerp(instant.share, track[instant.key + 1]);  // the shorter arc
}

void SceneMotion::Place(double t, const std::vector<int>& nodes, std::vector<Mat3>* linear,
                        std::vector<Vec3>* origin) const {
  // Work out only the nodes asked for and what they hang from; parents stand before children.
  std::vector<char> needed(nodes_.size(), 0);
  for (const int n : nodes) needed[n] = 1;
  for (size_t n = nodes_.size(); n-- > 0;) {
    if (needed[n] && nodes_[n].parent >= 0) needed[nodes_[n].parent] = 1;
  }
  const Instant instant = At(t);
  linear->resize(nodes_.size());
  origin->resize(nodes_.size());
  for (size_t n = 0; n < nodes_.size(); ++n) {
    if (!needed[n]) continue;
    const Node& node = nodes_[n];
    Mat3& own = (*linear)[n];
    own.noalias() = RotationAt(node, instant).toRotationMatrix() * node.stretch;
    (*origin)[n] = TranslationAt(node, instant);
    if (node.parent < 0) continue;
    const Mat3& parent = (*linear)[node.parent];
    (*origin)[n] = (*origin)[node.parent] + parent * (*origin)[n];
    own = parent * own;
  }
}

void SceneMotion::NodePositions(double t, const std::vector<int>& nodes,
                                std::vector<Vec3>* out) const {
  std::vector<Mat3> linear;
  std::vector<Vec3> origin;
  Place(t, nodes, &linear, &origin);
  out->clear();
  for (const int n : nodes) out->push_back(origin[n]);
}

void SceneMotion::NodeFrames(double t, const std::vector<int>& nodes, std::vector<Vec3>* position,
                             std::vector<Quat>* carrier_rotation) const {
  std::vector<Mat3> linear;
  std::vector<Vec3> origin;
  Place(t, nodes, &linear, &origin);
  position->clear();
  carrier_rotation->clear();
  for (const int n : nodes) {
    const int carrier = nodes_[n].parent < 0 ? n : nodes_[n].parent;
    position->push_back(origin[n]);
    carrier_rotation->push_back(NearestRotation(linear[carrier]));
  }
}

void SceneMotion::NodePositions(double t, const std::string& figure,
                                const std::vector<std::string>& node_names,
                                std::vector<Vec3>* out) const {
  NodePositions(t, FindNodes(figure, node_names), out);
}

}  // namespace retarget::io
