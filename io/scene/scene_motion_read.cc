// ReadSceneGlb and ParseSceneGlb of io/scene/scene_motion.h: the strict reader.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "io/gltf/load.h"
#include "io/scene/scene_motion.h"
#include "io/text/read_file.h"

namespace retarget::io {

// Turns a glTF document into a SceneMotion, and refuses what it does not understand.
class SceneMotionReader {
 public:
  explicit SceneMotionReader(const std::string& name) { motion_.name_ = name; }

  SceneMotion Read(const std::string& bytes) {
    LoadedGltf gltf = LoadGltf(bytes, motion_.name_, "");
    model_ = std::move(gltf.model);
    ReadNodes();
    if (model_.animations.size() != 1) {
      Fail(fmt::format("{} animations, expected exactly 1", model_.animations.size()));
    }
    const tinygltf::Animation& animation = model_.animations[0];
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.sampler < 0 || channel.sampler >= static_cast<int>(animation.samplers.size())) {
        Fail(fmt::format("animation sampler {} does not exist", channel.sampler));
      }
      ReadTrack(channel, animation.samplers[channel.sampler]);
    }
    if (motion_.key_times.empty()) Fail("the animation has no keys");
    return std::move(motion_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(motion_.name_ + ": " + what);
  }

  // Keeps the nodes parents first, and remembers where each went.
  void ReadNodes() {
    const int count = static_cast<int>(model_.nodes.size());
    std::vector<int> parent(count, -1), order;
    for (int n = 0; n < count; ++n) {
      for (const int child : model_.nodes[n].children) {
        if (child < 0 || child >= count || parent[child] >= 0) {
          Fail(fmt::format("node {} has a child {} that is missing or has two parents", n, child));
        }
        parent[child] = n;
      }
    }
    for (int n = 0; n < count; ++n) {
      if (parent[n] < 0) order.push_back(n);
    }
    for (size_t i = 0; i < order.size(); ++i) {
      const std::vector<int>& children = model_.nodes[order[i]].children;
      order.insert(order.end(), children.begin(), children.end());
    }
    if (static_cast<int>(order.size()) != count) Fail("the node hierarchy has a loop");

    place_.resize(count);
    for (const int n : order) {
      place_[n] = static_cast<int>(motion_.nodes_.size());
      motion_.nodes_.push_back(ReadNode(model_.nodes[n]));
      if (parent[n] >= 0) motion_.nodes_.back().parent = place_[parent[n]];
      const bool fresh = motion_.node_of_name_.emplace(model_.nodes[n].name, place_[n]).second;
      if (!fresh) Fail(fmt::format("two nodes are called \"{}\"", model_.nodes[n].name));
    }
  }

  SceneMotion::Node ReadNode(const tinygltf::Node& from) const {
    SceneMotion::Node node;
    if (from.matrix.size() == 16) {
      const Eigen::Map<const Eigen::Matrix4d> matrix(from.matrix.data());  // column-major, as glTF
      node.translation = matrix.topRightCorner<3, 1>();
      node.stretch = matrix.topLeftCorner<3, 3>();
    }
    if (from.translation.size() == 3) node.translation = Vec3::Map(from.translation.data());
    if (from.scale.size() == 3) node.stretch = Vec3::Map(from.scale.data()).asDiagonal();
    if (from.rotation.size() == 4) node.rotation = UnitQuaternion(from.rotation.data());
    if (!node.translation.allFinite() || !node.stretch.allFinite()) {
      Fail(fmt::format("node \"{}\" has a transform that is not finite", from.name));
    }
    return node;
  }

  // From glTF's order x, y, z, w. Written quaternions are unit up to rounding; rounding is mended.
  Quat UnitQuaternion(const double* xyzw) const {
    const Quat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    if (!(std::abs(q.norm() - 1.0) < 1e-3)) Fail("a rotation is not a unit quaternion");
    return q.normalized();
  }

  void ReadTrack(const tinygltf::AnimationChannel& channel,
                 const tinygltf::AnimationSampler& sampler) {
    if (channel.target_node < 0 || channel.target_node >= static_cast<int>(place_.size())) {
      Fail(fmt::format("animated node {} does not exist", channel.target_node));
    }
    if (sampler.interpolation != "LINEAR") {
      Fail(fmt::format("interpolation {}, expected LINEAR", sampler.interpolation));
    }
    ReadKeyTimes(sampler.input);
    SceneMotion::Node& node = motion_.nodes_[place_[channel.target_node]];
    if (channel.target_path == "translation" && node.translation_track < 0) {
      node.translation_track = static_cast<int>(motion_.translation_tracks_.size());
      motion_.translation_tracks_.push_back(ReadTranslations(sampler.output));
    } else if (channel.target_path == "rotation" && node.rotation_track < 0) {
      node.rotation_track = static_cast<int>(motion_.rotation_tracks_.size());
      motion_.rotation_tracks_.push_back(ReadRotations(sampler.output));
    } else {
      Fail(
          fmt::format("node {} has a second or unknown track \"{}\", expected one translation and "
                      "one rotation",
                      channel.target_node, channel.target_path));
    }
  }

  // All tracks must have the keys of the first.
  void ReadKeyTimes(int accessor) {
    if (!read_inputs_.insert(accessor).second) return;
    std::vector<double> times = ReadFloats(accessor, 1);
    for (size_t k = 1; k < times.size(); ++k) {
      if (times[k] <= times[k - 1]) Fail("key times do not ascend");
    }
    if (motion_.key_times.empty())
      motion_.key_times = std::move(times);
    else if (times != motion_.key_times)
      Fail("tracks have different key times");
  }

  std::vector<Vec3> ReadTranslations(int accessor) const {
    const std::vector<double> values = ReadValues(accessor, 3);
    std::vector<Vec3> track;
    for (size_t i = 0; i < values.size(); i += 3) track.push_back(Vec3::Map(&values[i]));
    return track;
  }

  std::vector<Quat> ReadRotations(int accessor) const {
    const std::vector<double> values = ReadValues(accessor, 4);
    std::vector<Quat> track;
    for (size_t i = 0; i < values.size(); i += 4) track.push_back(UnitQuaternion(&values[i]));
    return track;
  }

  std::vector<double> ReadValues(int accessor, size_t components) const {
    std::vector<double> values = ReadFloats(accessor, components);
    if (values.size() != components * motion_.key_times.size()) {
      Fail("a track has not one value per key");
    }
    return values;
  }

  // The numbers of a float32 accessor, item after item. [count * components]
  std::vector<double> ReadFloats(int index, size_t components) const {
    if (index < 0 || index >= static_cast<int>(model_.accessors.size())) {
      Fail(fmt::format("accessor {} does not exist", index));
    }
    const tinygltf::Accessor& accessor = model_.accessors[index];
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.sparse.isSparse ||
        tinygltf::GetNumComponentsInType(accessor.type) != static_cast<int>(components)) {
      Fail(fmt::format("accessor {}: expected {} plain float32 components", index, components));
    }
    const unsigned char* data = CheckedData(accessor, components * sizeof(float));
    const size_t stride = accessor.ByteStride(model_.bufferViews[accessor.bufferView]);
    std::vector<double> values(accessor.count * components);
    for (size_t i = 0; i < accessor.count; ++i) {
      for (size_t c = 0; c < components; ++c) {
        float value;
        std::memcpy(&value, data + i * stride + c * sizeof(float), sizeof(float));
        if (!std::isfinite(value)) Fail(fmt::format("accessor {}: a number is not finite", index));
        values[i * components + c] = value;
      }
    }
    return values;
  }

  // Start of the accessor's data, all of which is known to lie within its buffer.
  const unsigned char* CheckedData(const tinygltf::Accessor& accessor, size_t item_bytes) const {
    if (accessor.bufferView < 0 || accessor.bufferView >= int(model_.bufferViews.size())) {
      Fail("an accessor has no buffer view");
    }
    const tinygltf::BufferView& view = model_.bufferViews[accessor.bufferView];
    if (view.buffer < 0 || view.buffer >= int(model_.buffers.size())) {
      Fail("a buffer view has no buffer");
    }
    const std::vector<unsigned char>& data = model_.buffers[view.buffer].data;
    const int stride = accessor.ByteStride(view);
    // In this order no sum or product can overflow.
    const bool inside =
        view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset &&
        accessor.byteOffset <= view.byteLength && accessor.count > 0 &&
        stride >= static_cast<int>(item_bytes) &&
        item_bytes <= view.byteLength - accessor.byteOffset &&
        accessor.count - 1 <= (view.byteLength - accessor.byteOffset - item_bytes) / size_t(stride);
    if (!inside) Fail("an accessor reaches beyond its data");
    return data.data() + view.byteOffset + accessor.byteOffset;
  }

  SceneMotion motion_;
  tinygltf::Model model_;
  std::vector<int> place_;     // of each node of the file in motion_.nodes_
  std::set<int> read_inputs_;  // accessors of key times that are known to agree
};

SceneMotion ParseSceneGlb(const std::string& bytes, const std::string& name) {
  return SceneMotionReader(name).Read(bytes);
}

SceneMotion ReadSceneGlb(const std::string& path) {
  return ParseSceneGlb(ReadFile(path, "a scene (GLB)"), path);
}

}  // namespace retarget::io
