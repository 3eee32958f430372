// The rig in a glTF node tree. Inner part of io/gltf_clip.h.
#pragma once

#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "io/gltf_clip.h"
#include "io/gltf_tracks.h"

namespace retarget {

// Translation, rotation and scale of a node. A matrix is split up; `name` stands for the file.
// Throws InputError where the rotation is not unit or the matrix is singular or shears.
struct GltfTransform {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();
};
GltfTransform TransformOf(const tinygltf::Model& model, int node, const std::string& name);

// The skins of one character: the selected skin's, or those of the only one. Empty where the file
// has no skin. `humanoid` are nodes known to be a human's: they choose where nothing is selected.
// Throws InputError that lists the characters where there is a choice.
std::vector<int> CharacterSkins(const LoadedGltf& gltf, const std::string& select,
                                const std::vector<int>& humanoid, const std::string& name);

// Fills rig and joints of `clip` (not yet the frames): the joints of `skins` and the `humanoid`
// nodes, or where there are none, what `tracks` move.
void BuildSkeleton(const LoadedGltf& gltf, const std::vector<int>& skins,
                   const std::vector<int>& humanoid, const GltfTracks& tracks,
                   GltfAccessors* accessors, GltfClip* clip);

// Inverse bind matrices of a skin, checked; identities where it has none. [joints]
std::vector<Eigen::Matrix4d> InverseBindMatrices(const tinygltf::Model& model, int skin,
                                                 GltfAccessors* accessors, const std::string& name);

}  // namespace retarget
