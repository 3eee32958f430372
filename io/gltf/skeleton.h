// The rig in a glTF node tree. Inner part of io/gltf/clip.h.
#pragma once

#include <vector>

#include "io/gltf/clip.h"
#include "io/gltf/tracks.h"

namespace retarget::io {

// Fills rig and joints of `clip` (not yet the frames): the joints of `skins` and the `humanoid`
// nodes, or where there are none, what `tracks` move.
void BuildSkeleton(const LoadedGltf& gltf, const std::vector<int>& skins,
                   const std::vector<int>& humanoid, const GltfTracks& tracks,
                   GltfAccessors* accessors, GltfClip* clip);

}  // namespace retarget::io
