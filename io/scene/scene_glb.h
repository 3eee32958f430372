// Writes the scene: figures with their motion as one binary glTF 2.0 file.
//
// Contract (other programs read the file by it). For a figure "a":
//  - nodes "a/<node>" for all nodes of the body. "a/root" carries link 0, and alone has a
//    translation track. Every other node is a child of the glTF node that carries its link, at the
//    node's offset.
//  - a link whose joint centre is a node of the body is carried by that glTF node; every other link
//    (waist, clavicles) by an extra node "a/joint/<link>". Each carries a rotation track. Forward
//    kinematics of the file is therefore PoseBody.
//  - exactly one animation: float32, LINEAR, one key per frame, frame k at k / fps; quaternions of
//    unit length whose sign never flips between keys.
//  - a skinned mesh "a mesh" beside "a/root": one capsule per segment, in node order, rigid in the
//    segment's link, then the nose. Its bind pose is the rest pose at the root's first position.
#pragma once

#include <string>
#include <vector>

#include "io/scene/scene_motion.h"  // the reader of what is written here
#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/geometry/types.h"

namespace retarget::io {

struct SceneFigure {
  std::string name;            // prefix of its nodes: "a"
  const Body* body = nullptr;  // not owned
  const Clip* clip = nullptr;  // not owned; at least one frame
  Vec3 colour = Vec3::Ones();  // sRGB, components in [0, 1]
};

// Two colours that stay apart for every kind of colour vision (Okabe and Ito 2008; sRGB).
inline const Vec3 kColourA = Vec3(0x00, 0x72, 0xB2) / 255.0;
inline const Vec3 kColourB = Vec3(0xE6, 0x9F, 0x00) / 255.0;

// The bytes of the file. All clips have the same rate and number of frames. `generator` becomes
// asset.generator. The same input gives the same bytes.
std::string FormatSceneGlb(const std::vector<SceneFigure>& figures, const std::string& generator);

}  // namespace retarget::io
