// BoneRadii of io/gltf/clip.h, and io/gltf/mesh.h.
#include "io/gltf/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/gltf/node.h"

namespace retarget::io {
namespace {

constexpr double kQuantile = 0.75;

double Quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Distance of `p` from the segment 0..end.
double DistanceFromBone(const Vec3& p, const Vec3& end) {
  const double length2 = end.squaredNorm();
  const double along = length2 > 0 ? std::clamp(p.dot(end) / length2, 0.0, 1.0) : 0.0;
  return (p - along * end).norm();
}

class VertexCollector {
 public:
  VertexCollector(const LoadedGltf& gltf, const GltfClip& clip)
      : model_(gltf.model),
        clip_(clip),
        compression_(gltf.compression),
        accessors_(gltf.model, clip.name) {
    vertices_.resize(clip.joints.size());
    joint_of_node_.assign(model_.nodes.size(), -1);
    for (size_t j = 0; j < clip.joints.size(); ++j) {
      joint_of_node_[clip.joints[j].node] = static_cast<int>(j);
    }
  }

  // Whether a mesh was left out because its data are compressed.
  bool met_compressed() const { return met_compressed_; }

  // In the joints' own frames, in metres. [joints of the rig]
  std::vector<std::vector<Vec3>> Collect() {
    for (const tinygltf::Node& node : model_.nodes) {
      if (node.mesh < 0 || node.skin < 0) continue;
      const std::vector<Eigen::Matrix4d> inverse_bind =
          InverseBindMatrices(model_, node.skin, &accessors_, clip_.name);
      for (const tinygltf::Primitive& primitive : model_.meshes[node.mesh].primitives) {
        AddPrimitive(primitive, model_.skins[node.skin].joints, inverse_bind);
      }
    }
    return std::move(vertices_);
  }

 private:
  void AddPrimitive(const tinygltf::Primitive& primitive, const std::vector<int>& skin_joints,
                    const std::vector<Eigen::Matrix4d>& inverse_bind) {
    const auto attribute = [&](const char* key) {
      const auto it = primitive.attributes.find(key);
      return it == primitive.attributes.end() ? -1 : it->second;
    };
    const int place = attribute("POSITION");
    if (place < 0) return;
    for (const auto& [key, accessor] : primitive.attributes) {
      if (!IsSkinning(key)) continue;
      const int view = model_.accessors[accessor].bufferView;
      // Draco's accessors may have no view of their own.
      if (view < 0 ? compression_.empty() : model_.bufferViews[view].extensions.empty()) continue;
      met_compressed_ = true;
      return;
    }
    if (model_.accessors[place].bufferView < 0) return;
    const std::vector<double> position = accessors_.Read(place, TINYGLTF_TYPE_VEC3);
    const size_t count = position.size() / 3;
    std::vector<int> strongest(count, -1);
    std::vector<double> most(count, 0.0);
    for (int set = 0;; ++set) {
      const int j = attribute(fmt::format("JOINTS_{}", set).c_str());
      const int w = attribute(fmt::format("WEIGHTS_{}", set).c_str());
      if (j < 0 || w < 0) break;
      const std::vector<double> joint = accessors_.Read(j, TINYGLTF_TYPE_VEC4);
      const std::vector<double> weight = accessors_.Read(w, TINYGLTF_TYPE_VEC4);
      for (size_t k = 0; k < std::min({4 * count, joint.size(), weight.size()}); ++k) {
        if (weight[k] <= most[k / 4]) continue;
        most[k / 4] = weight[k];
        strongest[k / 4] = static_cast<int>(joint[k]);
      }
    }
    for (size_t v = 0; v < count; ++v) {
      const int s = strongest[v];
      if (s < 0 || s >= static_cast<int>(skin_joints.size())) continue;
      const int j = joint_of_node_[skin_joints[s]];
      if (j < 0) continue;
      const Eigen::Vector4d local = inverse_bind[s] * Vec3::Map(&position[3 * v]).homogeneous();
      const GltfJoint& joint = clip_.joints[j];
      const Vec3 metres = joint.stretch.sum() / 3 * joint.scale;
      vertices_[j].push_back(metres.cwiseProduct(local.head<3>()));
    }
  }

  static bool IsSkinning(const std::string& key) {
    return key == "POSITION" || key.starts_with("JOINTS_") || key.starts_with("WEIGHTS_");
  }

  const tinygltf::Model& model_;
  const GltfClip& clip_;
  const std::string& compression_;
  bool met_compressed_ = false;
  GltfAccessors accessors_;
  std::vector<int> joint_of_node_;
  std::vector<std::vector<Vec3>> vertices_;
};

}  // namespace

void FindSkinTops(const LoadedGltf& gltf, GltfClip* clip) {
  VertexCollector collector(gltf, *clip);
  const std::vector<std::vector<Vec3>> vertices = collector.Collect();
  if (collector.met_compressed()) {
    clip->notes.push_back(fmt::format(
        "the mesh is compressed{}: the width of the skin cannot be read, and capsules are as wide "
        "as tabulated where they would follow it; export it uncompressed",
        gltf.compression.empty() ? "" : " (" + gltf.compression + ")"));
  }
  Rig& rig = clip->motion.rig;
  RigFrame rest;
  for (const RigJoint& joint : rig.joints) {
    rest.translation.push_back(joint.offset);
    rest.rotation.push_back(joint.rest_rotation);
  }
  const PosedRig posed = PoseRig(rig, rest);
  std::vector<double> top(rig.joints.size(), -INFINITY);
  for (size_t j = rig.joints.size(); j-- > 0;) {  // children first
    for (const Vec3& v : vertices[j]) {
      top[j] = std::max(top[j], (posed.position[j] + posed.rotation[j] * v).y());
    }
    const int parent = rig.joints[j].parent;
    if (parent >= 0) top[parent] = std::max(top[parent], top[j]);
  }
  for (size_t j = 0; j < top.size(); ++j) {
    const double rise = top[j] - posed.position[j].y();
    if (!(rise > 0) || !std::isfinite(rise)) continue;
    rig.joints[j].skin_top = posed.rotation[j].conjugate() * Vec3(0, rise, 0);
  }
}

std::vector<double> BoneRadii(const GltfClip& clip) {
  const LoadedGltf gltf = LoadGltf(clip.bytes, clip.name, clip.folder);
  const std::vector<std::vector<Vec3>> vertices = VertexCollector(gltf, clip).Collect();
  const std::vector<RigJoint>& joints = clip.motion.rig.joints;
  std::vector<std::vector<Vec3>> ends(joints.size());  // of the bones that begin at a joint
  for (const RigJoint& joint : joints) {
    if (joint.parent >= 0 && joint.offset.norm() > 0) ends[joint.parent].push_back(joint.offset);
  }
  std::vector<double> out(joints.size(), 0.0);
  for (size_t j = 0; j < joints.size(); ++j) {
    if (vertices[j].empty()) continue;
    if (ends[j].empty()) {
      // A leaf's bone goes through its flesh.
      Vec3 middle;
      for (int c = 0; c < 3; ++c) {
        std::vector<double> values;
        for (const Vec3& v : vertices[j]) values.push_back(v[c]);
        middle[c] = Quantile(std::move(values), 0.5);
      }
      ends[j].push_back(2 * middle);
    }
    std::vector<double> distance;
    for (const Vec3& v : vertices[j]) {
      double least = DistanceFromBone(v, ends[j][0]);
      for (const Vec3& end : ends[j]) least = std::min(least, DistanceFromBone(v, end));
      distance.push_back(least);
    }
    out[j] = Quantile(std::move(distance), kQuantile);
  }
  return out;
}

}  // namespace retarget::io
