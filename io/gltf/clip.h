// Characters and motions in glTF 2.0: .glb, .gltf, and what is built on them: VRM 0.x, VRM 1.0,
// VRMA.
//
// A file's node tree becomes a rig: the joints of one character's skins, the nodes between them,
// nodes above and below them that are animated or scaled unevenly, and what hangs below and carries
// no mesh. Everything still above is folded into the roots, even scales into the translations, so
// that the rig is in metres, Y up. It is rigid unless its frames have scales: those that are uneven
// or change, as shares of the folded ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

// Which animation and which character of a file: a name, or an index from 0. Empty: the only one.
// A skin stands for its character: all skins that share its skeleton.
struct GltfSelect {
  std::string animation;
  std::string skin;
  std::string figure = {};     // of several characters: by any of its names, or by number
  bool any_animation = false;  // of several, none of them selected, the first
  bool at_rest = false;        // the character alone, one frame, whatever animations there are
};

// What stands behind a joint of the rig: its transform in metres is
//   translation = origin + turn (stretch .* t),  rotation = turn * q,  scale = s / size
// of the node's own t, q and s. `origin` and `turn` are those of the folded nodes above a root.
struct GltfJoint {
  int node = -1;               // index in the file
  Vec3 origin = Vec3::Zero();  // m
  Quat turn = Quat::Identity();
  Vec3 stretch = Vec3::Ones();           // m per unit, even
  Vec3 rest_translation = Vec3::Zero();  // the node's own t, q and scale, whatever animates them
  Quat rest_rotation = Quat::Identity();
  Vec3 rest_scale = Vec3::Ones();
  Vec3 scale = Vec3::Ones();  // in the animation, of its first key
  double size = 1;            // of the scale, the part that is folded into what hangs below
  bool changes_scale = false;
  bool has_translation_track = false;
};

struct GltfClip {
  RigMotion motion;
  std::vector<GltfJoint> joints;  // [joints of the rig]
  // s, of each frame: the file's own key times. Empty where the frames do not stand at the keys.
  std::vector<double> key_times;
  std::string animation;           // its name; empty for a character at rest
  std::vector<int> skins;          // the character's, indices in the file
  bool is_one_of_several = false;  // skinned characters
  std::optional<JointMap> map;     // VRM and VRMA say which bone is which; absent bones are -1
  bool faces_minus_z = false;      // as VRM 0.x does; everything else should face +Z
  std::vector<std::string> notes;  // what was tolerated or left aside, one line each

  std::string bytes;   // the file as it was read
  std::string name;    // of the file, for messages
  std::string folder;  // where its external buffers are; empty: nowhere
};

// Reads a file. A file without an animation is a character at rest, one frame. Keys of a uniform
// rate are the frames; others are sampled at the highest rate found, up to 240 per second.
// Throws InputError, one line that begins with the path. Allocates by what is there, never by a
// count that the file merely declares; textures are not decoded; external buffers must lie in the
// file's folder or below.
GltfClip ReadGltf(const std::string& path, const GltfSelect& select = {});

// The same from bytes.
GltfClip ParseGltf(std::string bytes, const std::string& name, const std::string& folder,
                   const GltfSelect& select = {});

// The bytes of `original` with one animation more, or another one where it has the name already:
// `motion` on the joints that were read. .glb stays .glb; .gltf stays .gltf, with the new data in a
// data URI and its references to other files as they were, so that it belongs into the same folder.
// All else keeps its bytes, in the JSON text as in the data, except
// - a node that has a `matrix` and is a joint gets translation, rotation and scale instead;
// - the byteLength of a GLB's buffer grows.
// Rotations are written for every joint, translations for those that have moved or whose animation
// had them, scales where the animation's was not the node's own; interpolation is linear. With
// `fps` 0 keys are one per frame, at the file's own key times where the motion still has them, else
// from 0; otherwise `motion` is sampled at that rate. An animation that is replaced leaves its old
// data in the file. Throws InputError where a matrix cannot be split up.
std::string FormatGltf(const GltfClip& original, const RigMotion& motion, double fps = 0,
                       const std::string& animation_name = "retargeted");

// The clip with some of its joints alone, `joints` in order and with all that carry them: what
// FormatGltf writes moves only these.
GltfClip CutGltf(const GltfClip& clip, const std::vector<int>& joints);

// Radius of a capsule about each joint's bone (m): the upper quartile of the distances of the
// joint's own vertices (those it has most weight of) from its bone. A quarter of the skin then lies
// outside, by little: that hides contact better than a mean does, and unlike the largest distance
// it is deaf to clothes, pockets and stray weights. 0 where a joint has no vertices.
std::vector<double> BoneRadii(const GltfClip& clip);

}  // namespace retarget::io
