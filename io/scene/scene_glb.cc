#include "io/scene/scene_glb.h"

#include <tiny_gltf.h>

#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <sstream>
#include <utility>

#include "io/render/image.h"
#include "io/scene/scene_figure.h"

namespace retarget::io {
namespace {

// Arrays of GLM values are copied into the file as they lie in memory.
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::quat) == 16 && sizeof(glm::mat4) == 64);

using JointIndices = glm::vec<4, std::uint16_t>;
using JointWeights = glm::vec<4, std::uint8_t>;

glm::vec3 ToGlm(const Vec3& v) { return glm::vec3(v.x(), v.y(), v.z()); }

// Normalised in double, so that the float components are the nearest to a unit quaternion.
glm::quat ToGlm(const Quat& rotation) {
  const Quat q = rotation.normalized();
  return glm::quat(static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
                   static_cast<float>(q.z()));
}

// Puts the document together. All arrays go into its one buffer.
class SceneWriter {
 public:
  SceneWriter(const std::string& generator, const Clip& timing) {
    model_.asset.version = "2.0";
    model_.asset.generator = generator;
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    model_.animations.emplace_back();
    model_.animations[0].name = "motion";
    AddKeyTimes(timing);
  }

  void AddFigure(const SceneFigure& figure) {
    Pose rest = RestPose(*figure.body);
    rest.root_position = figure.clip->frames[0].root_position;
    const FigureTree tree = PlanTree(figure, rest.root_position);
    const int first = AddNodes(tree);
    AddTracks(tree, first, *figure.clip);
    const PosedBody posed = PoseBody(*figure.body, rest);
    const int mesh = AddMesh(figure, BuildMesh(*figure.body, posed), tree);
    AddSkinnedNode(figure, mesh, AddSkin(figure, tree, first));
  }

  std::string Finish() {
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    writer.WriteGltfSceneToStream(&model_, out, /*prettyPrint=*/false, /*writeBinary=*/true);
    return std::move(out).str();
  }

 private:
  // Appends an array to the buffer. Returns its accessor. `target` says what a GPU uses it for; 0
  // where it does not.
  template <typename T>
  int AddArray(const std::vector<T>& items, int component_type, int type, int target = 0) {
    static_assert(sizeof(T) % 4 == 0);  // keeps every array aligned as glTF demands
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = items.size() * sizeof(T);
    view.target = target;
    data.resize(view.byteOffset + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, items.data(), view.byteLength);

    tinygltf::Accessor accessor;
    accessor.bufferView = Append(std::move(view), &model_.bufferViews);
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = items.size();
    return Append(std::move(accessor), &model_.accessors);
  }

  template <typename T>
  static int Append(T item, std::vector<T>* list) {
    list->push_back(std::move(item));
    return static_cast<int>(list->size()) - 1;
  }

  void AddKeyTimes(const Clip& clip) {
    std::vector<float> times(clip.frames.size());
    for (size_t k = 0; k < times.size(); ++k) times[k] = static_cast<float>(k / clip.fps);
    key_times_ = AddArray(times, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR);
    model_.accessors[key_times_].minValues = {times.front()};
    model_.accessors[key_times_].maxValues = {times.back()};
  }

  // Returns the number of the figure's first node in the file.
  int AddNodes(const FigureTree& tree) {
    const int first = static_cast<int>(model_.nodes.size());
    for (size_t i = 0; i < tree.name.size(); ++i) {
      tinygltf::Node node;
      node.name = tree.name[i];
      const Vec3& t = tree.translation[i];
      node.translation = {t.x(), t.y(), t.z()};
      model_.nodes.push_back(std::move(node));
    }
    for (size_t i = 0; i < tree.name.size(); ++i) {
      const int child = first + static_cast<int>(i);
      if (tree.parent[i] >= 0) model_.nodes[first + tree.parent[i]].children.push_back(child);
    }
    model_.scenes[0].nodes.push_back(first);
    return first;
  }

  void AddTracks(const FigureTree& tree, int first, const Clip& clip) {
    std::vector<glm::vec3> positions;
    for (const Pose& pose : clip.frames) positions.push_back(ToGlm(pose.root_position));
    AddTrack(first, "translation",
             AddArray(positions, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3));
    for (size_t l = 0; l < tree.carrier.size(); ++l) {
      std::vector<glm::quat> keys;
      for (const Pose& pose : clip.frames) {
        const glm::quat q = ToGlm(pose.rotation[l]);
        // q and -q are one rotation; stay on one side for players that interpolate linearly.
        keys.push_back(!keys.empty() && glm::dot(keys.back(), q) < 0 ? -q : q);
      }
      AddTrack(first + tree.carrier[l], "rotation",
               AddArray(keys, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4));
    }
  }

  void AddTrack(int node, const char* path, int values) {
    tinygltf::Animation& animation = model_.animations[0];
    tinygltf::AnimationSampler sampler;
    sampler.input = key_times_;
    sampler.output = values;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = Append(std::move(sampler), &animation.samplers);
    channel.target_node = node;
    channel.target_path = path;
    animation.channels.push_back(std::move(channel));
  }

  int AddMesh(const SceneFigure& figure, const FigureMesh& figure_mesh, const FigureTree& tree) {
    const TriangleMesh& triangles = figure_mesh.triangles;
    std::vector<glm::vec3> normals;
    for (const Vec3& n : triangles.normal) normals.push_back(glm::normalize(ToGlm(n)));
    std::vector<JointIndices> joints;
    for (const int link : figure_mesh.link) joints.emplace_back(tree.carrier[link], 0, 0, 0);
    const std::vector<JointWeights> weights(joints.size(), JointWeights(255, 0, 0, 0));
    const std::vector<std::uint32_t> corners(triangles.corner.begin(), triangles.corner.end());

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = AddMaterial(figure);
    primitive.indices = AddArray(corners, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                 TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.attributes["POSITION"] = AddPositions(triangles.position);
    primitive.attributes["NORMAL"] = AddArray(normals, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                              TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["JOINTS_0"] = AddArray(joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                                TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    const int weight = AddArray(weights, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
                                TINYGLTF_TARGET_ARRAY_BUFFER);
    model_.accessors[weight].normalized = true;  // 255 stands for 1
    primitive.attributes["WEIGHTS_0"] = weight;
    tinygltf::Mesh mesh;
    mesh.name = figure.name;
    mesh.primitives.push_back(std::move(primitive));
    return Append(std::move(mesh), &model_.meshes);
  }

  // glTF wants the exact bounds of positions, in their float precision.
  int AddPositions(const std::vector<Vec3>& points) {
    std::vector<glm::vec3> positions;
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const Vec3& p : points) {
      positions.push_back(ToGlm(p));
      low = glm::min(low, positions.back());
      high = glm::max(high, positions.back());
    }
    const int accessor = AddArray(positions, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                  TINYGLTF_TARGET_ARRAY_BUFFER);
    model_.accessors[accessor].minValues = {low.x, low.y, low.z};
    model_.accessors[accessor].maxValues = {high.x, high.y, high.z};
    return accessor;
  }

  int AddMaterial(const SceneFigure& figure) {
    const Vec3 c = figure.colour.unaryExpr(&LinearFromSrgb);  // glTF wants linear colour
    tinygltf::Material material;
    material.name = figure.name;
    material.pbrMetallicRoughness.baseColorFactor = {c.x(), c.y(), c.z(), 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.75;
    return Append(std::move(material), &model_.materials);
  }

  // Every node of the figure is a joint of its skin, end nodes too, so that editors that draw
  // bones show all segments.
  int AddSkin(const SceneFigure& figure, const FigureTree& tree, int first) {
    std::vector<glm::mat4> inverse_bind(tree.name.size());
    tinygltf::Skin skin;
    skin.name = figure.name;
    skin.skeleton = first;
    const std::vector<Vec3> rest = RestPositions(tree);
    for (size_t i = 0; i < rest.size(); ++i) {
      skin.joints.push_back(first + static_cast<int>(i));
      inverse_bind[i] = glm::translate(glm::mat4(1.0f), -ToGlm(rest[i]));
    }
    skin.inverseBindMatrices =
        AddArray(inverse_bind, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4);
    return Append(std::move(skin), &model_.skins);
  }

  // World positions of the nodes in the rest pose, where no node is rotated (m). [nodes]
  static std::vector<Vec3> RestPositions(const FigureTree& tree) {
    std::vector<Vec3> position(tree.name.size());
    for (size_t i = 0; i < position.size(); ++i) {
      position[i] = Vec3::Zero();
      for (int n = static_cast<int>(i); n >= 0; n = tree.parent[n]) {
        position[i] += tree.translation[n];
      }
    }
    return position;
  }

  // At the scene's top, as glTF asks: the transform of a skinned node's parents does not count.
  void AddSkinnedNode(const SceneFigure& figure, int mesh, int skin) {
    tinygltf::Node node;
    node.name = figure.name + " mesh";
    node.mesh = mesh;
    node.skin = skin;
    model_.scenes[0].nodes.push_back(Append(std::move(node), &model_.nodes));
  }

  tinygltf::Model model_;
  int key_times_ = -1;  // accessor
};

}  // namespace

std::string FormatSceneGlb(const std::vector<SceneFigure>& figures, const std::string& generator) {
  assert(!figures.empty() && figures[0].clip->num_frames() > 0);
  SceneWriter writer(generator, *figures[0].clip);
  for (const SceneFigure& figure : figures) {
    assert(figure.clip->fps == figures[0].clip->fps);
    assert(figure.clip->num_frames() == figures[0].clip->num_frames());
    writer.AddFigure(figure);
  }
  return writer.Finish();
}

}  // namespace retarget::io
