// The scene with the user's own characters in place of capsule figures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/gltf/clip.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Neither is owned. `motion` is in the scene's world, on the clip's rig, one frame per key of the
// scene.
struct SceneCharacter {
  const GltfClip* clip = nullptr;
  const RigMotion* motion = nullptr;
};

// The bytes of a GLB that is `scene_glb` (as FormatSceneGlb of io/scene/scene_glb.h writes it, of
// figures "a" and "b") with characters for its figures; null leaves a capsule figure. All that is
// promised of a scene stays true of it: nodes "a/..." with the same transforms, tracks and key
// times, and one animation with unique node names, which moves the characters too. But
// - of a figure with a character the mesh, its node "a mesh", its skin and its material are gone;
// - the character's nodes are called "a character/<name>", with its joints named as in its rig. It
//   is what the selected skins show, and what hangs rigidly from the joints, with skins, morph
//   targets, materials, textures and images; everything else in its file stays out. External files
//   are embedded, under the reader's rules.
// Each character moves as FormatGltf would have it, except that a scale of its animation becomes
// its node's. `notes`, if not null, gets lines about what was left out: images that are not there,
// and extensions that are unknown or, as VRM's, about the whole document.
//
// Throws InputError where a character has no mesh, requires an extension that cannot be merged,
// holds a broken reference, or where the GLB would exceed 4 GiB.
std::string FormatCharacterScene(const std::string& scene_glb,
                                 const std::array<const SceneCharacter*, 2>& characters,
                                 std::vector<std::string>* notes = nullptr);

}  // namespace retarget::io
