// What a character's skin says of its joints. Inner part of io/gltf/clip.h.
#pragma once

#include "io/gltf/clip.h"
#include "io/gltf/load.h"

namespace retarget::io {

// Sets RigJoint::skin_top of the joints whose skin, or whose children's, rises above them at rest.
void FindSkinTops(const LoadedGltf& gltf, GltfClip* clip);

}  // namespace retarget::io
