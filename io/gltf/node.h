// Transforms of a glTF document's nodes, at rest and where a skin was bound. Inner part of
// io/gltf/clip.h.
#pragma once

#include <string>
#include <vector>

#include "io/gltf/accessor.h"
#include "model/geometry/types.h"

namespace retarget::io {

// Translation, rotation and scale of a node. A matrix is split up; `name` stands for the file.
// Throws InputError where the rotation is not unit or the matrix is singular or shears.
struct GltfTransform {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();
};
GltfTransform TransformOf(const tinygltf::Model& model, int node, const std::string& name);

// Inverse bind matrices of a skin, checked; identities where it has none. [joints]
std::vector<Eigen::Matrix4d> InverseBindMatrices(const tinygltf::Model& model, int skin,
                                                 GltfAccessors* accessors, const std::string& name);

// The matrix of a local transform, column vectors.
Eigen::Matrix4d MatrixOf(const GltfTransform& t);

}  // namespace retarget::io
