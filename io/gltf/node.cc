#include "io/gltf/node.h"

#include <fmt/format.h>

#include <cmath>

namespace retarget::io {

using Eigen::Matrix4d;

GltfTransform TransformOf(const tinygltf::Model& model, int n, const std::string& name) {
  const tinygltf::Node& node = model.nodes[n];
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{}: nodes[{}]: {}", name, n, what));
  };
  GltfTransform out;
  if (node.matrix.empty()) {
    if (!node.translation.empty()) out.translation = Vec3::Map(node.translation.data());
    if (!node.scale.empty()) out.scale = Vec3::Map(node.scale.data());
    if (!node.rotation.empty()) {
      const double* q = node.rotation.data();
      out.rotation = Quat(q[3], q[0], q[1], q[2]);
      constexpr double kOffUnit = 0.00769;  // as Khronos' validator
      if (!(std::abs(out.rotation.norm() - 1) <= kOffUnit)) fail("rotation is no unit quaternion");
      out.rotation.normalize();
    }
    return out;
  }
  const Eigen::Map<const Matrix4d> matrix(node.matrix.data());  // column-major, as glTF
  Mat3 axes = matrix.topLeftCorner<3, 3>();
  for (int c = 0; c < 3; ++c) {
    out.scale[c] = axes.col(c).norm();
    if (!(out.scale[c] > 1e-12)) fail("its matrix is singular");
    axes.col(c) /= out.scale[c];
  }
  constexpr double kSquare = 1e-3;
  if ((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() > kSquare) {
    fail("its matrix shears: no translation, rotation and scale say the same");
  }
  if (axes.determinant() < 0) {  // a mirror is a rotation and a negative scale
    axes.col(0) *= -1;
    out.scale[0] *= -1;
  }
  out.translation = matrix.topRightCorner<3, 1>();
  out.rotation = Quat(axes).normalized();
  return out;
}

std::vector<Matrix4d> InverseBindMatrices(const tinygltf::Model& model, int skin,
                                          GltfAccessors* accessors, const std::string& name) {
  const tinygltf::Skin& s = model.skins[skin];
  std::vector<Matrix4d> out;
  if (s.inverseBindMatrices < 0) {
    out.assign(s.joints.size(), Matrix4d::Identity());
    return out;
  }
  if (accessors->Count(s.inverseBindMatrices) < s.joints.size()) {
    throw InputError(fmt::format("{}: skins[{}]: {} inverse bind matrices for {} joints", name,
                                 skin, accessors->Count(s.inverseBindMatrices), s.joints.size()));
  }
  const std::vector<double> numbers = accessors->Read(s.inverseBindMatrices, TINYGLTF_TYPE_MAT4);
  for (size_t j = 0; j < s.joints.size(); ++j) {
    Matrix4d m = Eigen::Map<const Matrix4d>(&numbers[16 * j]);
    const Eigen::RowVector4d last_row(0, 0, 0, 1);
    constexpr double kRounding = 1e-4;
    if ((m.row(3) - last_row).cwiseAbs().maxCoeff() > kRounding) {
      throw InputError(
          fmt::format("{}: skins[{}]: inverse bind matrix {} has another last row than 0 0 0 1",
                      name, skin, j));
    }
    m.row(3) = last_row;
    out.push_back(m);
  }
  return out;
}

Eigen::Matrix4d MatrixOf(const GltfTransform& t) {
  Eigen::Matrix4d m = Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = t.rotation.toRotationMatrix() * t.scale.asDiagonal();
  m.topRightCorner<3, 1>() = t.translation;
  return m;
}

}  // namespace retarget::io
