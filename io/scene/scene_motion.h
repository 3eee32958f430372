// A scene file played back by the rules of glTF 2.0 alone, so that what is measured is what was
// written and not what was meant. Knows nothing of bodies, links or poses.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "model/geometry/types.h"
#include "model/rig/keyed_motion.h"

namespace retarget::io {

class SceneMotion {
 public:
  // Instants of the keys (s), ascending, shared by all tracks. At least one.
  std::vector<double> key_times;

  // Ids of the nodes called "<figure>/<name>", for the overload below. Throws InputError where the
  // file has no such node.
  std::vector<int> FindNodes(const std::string& figure,
                             const std::vector<std::string>& node_names) const;

  // World positions (m) of `nodes` at time `t` (s): translation is linear between keys, rotation
  // spherical-linear along the shorter arc; before the first and after the last key it holds.
  void NodePositions(double t, const std::vector<int>& nodes, std::vector<Vec3>* out) const;

  // World positions (m) of `nodes` at time `t` as NodePositions gives them, and of each the world
  // rotation of its glTF parent: in a scene of io/scene/scene_glb.h, of the link that carries the
  // node. A node without parent ("a/root") gives its own. Where a file stretches nodes, the
  // rotation is the one nearest to the transform.
  void NodeFrames(double t, const std::vector<int>& nodes, std::vector<Vec3>* position,
                  std::vector<Quat>* carrier_rotation) const;

  // NodePositions by name.
  void NodePositions(double t, const std::string& figure,
                     const std::vector<std::string>& node_names, std::vector<Vec3>* out) const;

  // The tree with its tracks, for what reasons about the motion between instants; ids are those of
  // FindNodes.
  KeyedMotion Keyed() const { return {key_times, nodes_, translation_tracks_, rotation_tracks_}; }

 private:
  friend class SceneMotionReader;

  using Node = KeyedNode;

  // A key and the share of the way to the next.
  struct Instant {
    size_t key = 0;
    double share = 0;
  };

  // World transforms p -> origin + linear * p at time `t` of `nodes` and of all they hang from; the
  // others are not filled. [nodes of the file]
  void Place(double t, const std::vector<int>& nodes, std::vector<Mat3>* linear,
             std::vector<Vec3>* origin) const;

  Instant At(double t) const;
  Vec3 TranslationAt(const Node& node, const Instant& instant) const;
  Quat RotationAt(const Node& node, const Instant& instant) const;

  std::string name_;  // of the file, for messages
  std::vector<Node> nodes_;
  std::unordered_map<std::string, int> node_of_name_;
  std::vector<std::vector<Vec3>> translation_tracks_;  // [tracks][keys] (m)
  std::vector<std::vector<Quat>> rotation_tracks_;     // [tracks][keys] unit length
};

// Read a binary glTF with exactly one animation: LINEAR translation and rotation tracks that share
// their key times. Throw InputError on anything else, damaged files included. `name` is what
// messages call the bytes.
SceneMotion ReadSceneGlb(const std::string& path);
SceneMotion ParseSceneGlb(const std::string& bytes, const std::string& name);

}  // namespace retarget::io
