// The written scene against its contract: through SceneMotion, and again by hand through tinygltf.
#include "io/scene/scene_glb.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "io/render/capsule_mesh.h"
#include "model/geometry/so3.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

constexpr double kFps = 24.0;

Quat RandomRotation(std::mt19937* random) {
  std::normal_distribution<double> normal;
  return Quat(normal(*random), normal(*random), normal(*random), normal(*random)).normalized();
}

Clip RandomClip(const Body& body, int frames, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> metres(-2.0, 2.0);
  Clip clip;
  clip.fps = kFps;
  for (int k = 0; k < frames; ++k) {
    Pose pose = RestPose(body);
    pose.root_position = Vec3(metres(random), metres(random), metres(random));
    for (Quat& q : pose.rotation) q = RandomRotation(&random);
    clip.frames.push_back(pose);
  }
  return clip;
}

// The standard body with a finger that turns about the hand node and a thumb that does not.
Body FingeredBody() {
  Body body = StandardBody(AverageMeasures(1.6));
  const int wrist = body.FindLink("left_wrist"), hand = body.FindNode("left_hand");
  const Vec3 knuckle = body.nodes[hand].offset;
  body.links.push_back({.name = "left_finger", .parent = wrist, .centre = knuckle, .limit = {}});
  body.links.push_back(
      {.name = "left_thumb", .parent = wrist, .centre = Vec3(0.02, 0, 0.03), .limit = {}});
  body.nodes.push_back({"left_finger_tip", hand, body.num_links() - 2, Vec3(0.08, 0, 0), 0.01});
  body.nodes.push_back({"left_thumb_tip", body.FindNode("left_wrist"), body.num_links() - 1,
                        Vec3(0, 0, 0.06), 0.01});
  return body;
}

std::vector<std::string> NodeNames(const Body& body) {
  std::vector<std::string> names;
  for (const Node& node : body.nodes) names.push_back(node.name);
  return names;
}

// Two different bodies in one scene.
class SceneGlbTest : public testing::Test {
 protected:
  static constexpr int kFrames = 12;

  std::string Format() const {
    return FormatSceneGlb(
        {{"a", &body_a_, &clip_a_, kColourA}, {"b", &body_b_, &clip_b_, kColourB}},
        "retarget test");
  }
  tinygltf::Model Load(const std::string& bytes) const {
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string errors, warnings;
    EXPECT_TRUE(loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                            reinterpret_cast<const unsigned char*>(bytes.data()),
                                            static_cast<unsigned>(bytes.size())))
        << errors;
    EXPECT_EQ(errors + warnings, "");
    return model;
  }

  Body body_a_ = StandardBody(AverageMeasures(1.8)), body_b_ = FingeredBody();
  Clip clip_a_ = RandomClip(body_a_, kFrames, 1), clip_b_ = RandomClip(body_b_, kFrames, 2);
};

// ---- A second reader, by hand, that shares nothing with SceneMotion.

template <typename T>
const T* Items(const tinygltf::Model& model, int accessor) {
  const tinygltf::Accessor& a = model.accessors[accessor];
  const tinygltf::BufferView& view = model.bufferViews[a.bufferView];
  EXPECT_EQ(view.byteStride, 0U);
  return reinterpret_cast<const T*>(model.buffers[0].data.data() + view.byteOffset + a.byteOffset);
}

std::map<std::string, int> NodeIndices(const tinygltf::Model& model) {
  std::map<std::string, int> index;
  for (size_t n = 0; n < model.nodes.size(); ++n) index[model.nodes[n].name] = static_cast<int>(n);
  EXPECT_EQ(index.size(), model.nodes.size()) << "names are unique";
  return index;
}

std::vector<int> Parents(const tinygltf::Model& model) {
  std::vector<int> parent(model.nodes.size(), -1);
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    for (const int child : model.nodes[n].children) parent[child] = static_cast<int>(n);
  }
  return parent;
}

// World transforms of all nodes at key `k`.
std::vector<Eigen::Isometry3d> WorldAtKey(const tinygltf::Model& model, int k) {
  std::vector<Eigen::Isometry3d> local(model.nodes.size(), Eigen::Isometry3d::Identity());
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    const std::vector<double>& t = model.nodes[n].translation;
    if (!t.empty()) local[n].translation() = Vec3(t[0], t[1], t[2]);
  }
  const tinygltf::Animation& animation = model.animations.at(0);
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    const int output = animation.samplers[channel.sampler].output;
    Eigen::Isometry3d& node = local[channel.target_node];
    if (channel.target_path == "translation") {
      const float* v = Items<float>(model, output) + 3 * k;
      node.translation() = Vec3(v[0], v[1], v[2]);
    } else {
      const float* q = Items<float>(model, output) + 4 * k;
      node.linear() = Quat(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
    }
  }
  const std::vector<int> parent = Parents(model);
  std::vector<Eigen::Isometry3d> world = local;
  for (size_t n = 0; n < world.size(); ++n) {
    for (int p = parent[n]; p >= 0; p = parent[p]) world[n] = local[p] * world[n];
  }
  return world;
}

TEST_F(SceneGlbTest, HasTheContractsNodes) {
  const tinygltf::Model model = Load(Format());
  const std::map<std::string, int> index = NodeIndices(model);
  std::set<std::string> expected = {"a mesh", "b mesh", "b/joint/left_thumb"};
  for (const std::string& name : NodeNames(body_a_)) expected.insert("a/" + name);
  for (const std::string& name : NodeNames(body_b_)) expected.insert("b/" + name);
  for (const std::string figure : {"a", "b"}) {
    for (const std::string joint : {"waist", "left_clavicle", "right_clavicle"}) {
      expected.insert(figure + "/joint/" + joint);
    }
  }
  std::set<std::string> found;
  for (const auto& [name, n] : index) found.insert(name);
  EXPECT_EQ(found, expected);

  const std::vector<int> parent = Parents(model);
  const auto parent_name = [&](const std::string& name) {
    const int p = parent[index.at(name)];
    return p < 0 ? std::string() : model.nodes[p].name;
  };
  const std::map<std::string, std::string> parents = {
      {"a/root", ""},
      {"a mesh", ""},
      {"a/joint/waist", "a/root"},
      {"a/left_hip", "a/root"},
      {"a/chest", "a/joint/waist"},
      {"a/neck", "a/chest"},
      {"a/head", "a/neck"},
      {"a/head_top", "a/head"},
      {"a/joint/left_clavicle", "a/chest"},
      {"a/left_shoulder", "a/joint/left_clavicle"},
      {"a/left_hand", "a/left_wrist"},
      {"a/right_toe", "a/right_ankle"},
      {"b/left_finger_tip", "b/left_hand"},
      {"b/joint/left_thumb", "b/left_wrist"},
      {"b/left_thumb_tip", "b/joint/left_thumb"},
  };
  for (const auto& [name, expected_parent] : parents) {
    EXPECT_EQ(parent_name(name), expected_parent) << name;
  }
  EXPECT_EQ(model.asset.generator, "retarget test");
  EXPECT_EQ(model.scenes.at(model.defaultScene).nodes.size(), 4U);
}

TEST_F(SceneGlbTest, HasOneLinearAnimationWithOneKeyPerFrame) {
  const tinygltf::Model model = Load(Format());
  ASSERT_EQ(model.animations.size(), 1U);
  const tinygltf::Animation& animation = model.animations[0];
  std::set<std::string> translated, rotated;
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    const tinygltf::AnimationSampler& sampler = animation.samplers[channel.sampler];
    EXPECT_EQ(sampler.interpolation, "LINEAR");
    EXPECT_EQ(sampler.input, animation.samplers[0].input) << "one input for all";
    EXPECT_EQ(model.accessors[sampler.output].count, size_t(kFrames));
    EXPECT_EQ(model.accessors[sampler.output].componentType, TINYGLTF_COMPONENT_TYPE_FLOAT);
    std::set<std::string>& names = channel.target_path == "translation" ? translated : rotated;
    EXPECT_TRUE(names.insert(model.nodes[channel.target_node].name).second);
  }
  EXPECT_EQ(translated, (std::set<std::string>{"a/root", "b/root"}));
  EXPECT_EQ(rotated.size(), body_a_.links.size() + body_b_.links.size());
  EXPECT_TRUE(rotated.count("a/joint/waist") && rotated.count("b/left_hand"));
  EXPECT_FALSE(rotated.count("a/left_hand"));

  const float* times = Items<float>(model, animation.samplers[0].input);
  for (int k = 0; k < kFrames; ++k) EXPECT_EQ(times[k], static_cast<float>(k / kFps));
}

TEST_F(SceneGlbTest, PlaysAsPoseBody) {
  const std::string bytes = Format();
  const SceneMotion motion = ParseSceneGlb(bytes, "test.glb");
  const tinygltf::Model model = Load(bytes);
  const std::map<std::string, int> index = NodeIndices(model);
  ASSERT_EQ(motion.key_times.size(), size_t(kFrames));
  double error = 0, error_by_hand = 0;
  for (int k = 0; k < kFrames; ++k) {
    const std::vector<Eigen::Isometry3d> world = WorldAtKey(model, k);
    const auto compare = [&](const std::string& figure, const Body& body, const Pose& pose) {
      const PosedBody posed = PoseBody(body, pose);
      std::vector<Vec3> read;
      motion.NodePositions(motion.key_times[k], figure, NodeNames(body), &read);
      ASSERT_EQ(read.size(), posed.node.size());
      for (int n = 0; n < body.num_nodes(); ++n) {
        const Vec3 by_hand = world[index.at(figure + "/" + body.nodes[n].name)].translation();
        error = std::max(error, (read[n] - posed.node[n]).norm());
        error_by_hand = std::max(error_by_hand, (by_hand - posed.node[n]).norm());
      }
    };
    compare("a", body_a_, clip_a_.frames[k]);
    compare("b", body_b_, clip_b_.frames[k]);
  }
  EXPECT_LT(error, 1e-6);
  EXPECT_LT(error_by_hand, 1e-6);
}

TEST_F(SceneGlbTest, InterpolatesAsPosesDo) {
  const SceneMotion motion = ParseSceneGlb(Format(), "test.glb");
  const std::vector<std::string> names = NodeNames(body_a_);
  const std::vector<int> ids = motion.FindNodes("a", names);
  std::vector<Vec3> read;
  for (int k = 0; k + 1 < kFrames; ++k) {
    for (const double u : {0.25, 0.5, 0.75}) {
      const double t = (1 - u) * motion.key_times[k] + u * motion.key_times[k + 1];
      motion.NodePositions(t, ids, &read);
      const PosedBody posed =
          PoseBody(body_a_, Interpolate(clip_a_.frames[k], clip_a_.frames[k + 1], u));
      // Looser than at keys: random keys lie nearly half a turn apart now and then, where a slerp
      // enlarges the rounding of its ends.
      for (size_t n = 0; n < read.size(); ++n) {
        EXPECT_LT((read[n] - posed.node[n]).norm(), 2e-5) << names[n] << " at " << t;
      }
    }
  }
}

// Largest error of NodeFrames over all nodes: of positions against NodePositions, of rotations
// (rad) against the links that carry the nodes.
struct FrameErrors {
  double position = 0, rotation = 0;
};
FrameErrors NodeFrameErrors(const SceneMotion& motion, double t, const std::string& figure,
                            const Body& body, const Pose& pose) {
  const PosedBody posed = PoseBody(body, pose);
  const std::vector<int> ids = motion.FindNodes(figure, NodeNames(body));
  std::vector<Vec3> positions, position(3, Vec3::Zero());  // what was there goes
  std::vector<Quat> rotation(3, Quat::Identity());
  motion.NodePositions(t, ids, &positions);
  motion.NodeFrames(t, ids, &position, &rotation);
  EXPECT_EQ(position.size(), body.nodes.size());
  EXPECT_EQ(rotation.size(), body.nodes.size());
  FrameErrors worst;
  for (int n = 0; n < body.num_nodes(); ++n) {
    const Quat link(posed.rotation[body.nodes[n].link]);
    EXPECT_NEAR(rotation[n].norm(), 1.0, 1e-12);
    worst.position = std::max(worst.position, (position[n] - positions[n]).norm());
    worst.rotation = std::max(worst.rotation, rotation[n].angularDistance(link));
  }
  return worst;
}

TEST_F(SceneGlbTest, NodeFramesTurnWithTheLinksThatCarryTheNodes) {
  const SceneMotion motion = ParseSceneGlb(Format(), "test.glb");
  for (int k = 0; k + 1 < kFrames; ++k) {
    for (const double u : {0.0, 0.3}) {
      const double t = (1 - u) * motion.key_times[k] + u * motion.key_times[k + 1];
      const auto check = [&](const std::string& figure, const Body& body, const Clip& clip) {
        const Pose pose = Interpolate(clip.frames[k], clip.frames[k + 1], u);
        const FrameErrors worst = NodeFrameErrors(motion, t, figure, body, pose);
        EXPECT_EQ(worst.position, 0.0);
        EXPECT_LT(worst.rotation, u == 0 ? 1e-6 : 2e-5) << figure << " at " << t;
      };
      check("a", body_a_, clip_a_);
      check("b", body_b_, clip_b_);
    }
  }
}

TEST_F(SceneGlbTest, NodeFramesAreRotationsInStretchedScenes) {
  tinygltf::Model model = Load(Format());
  const std::map<std::string, int> index = NodeIndices(model);
  model.nodes[index.at("a/root")].scale = {2, 2, 2};
  model.nodes[index.at("a/left_wrist")].scale = {0.5, 3, 1};  // only the hand hangs from it
  std::ostringstream bytes;
  ASSERT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true));
  const SceneMotion motion = ParseSceneGlb(bytes.str(), "stretched.glb");
  for (int k = 0; k < kFrames; ++k) {
    const FrameErrors worst =
        NodeFrameErrors(motion, motion.key_times[k], "a", body_a_, clip_a_.frames[k]);
    EXPECT_EQ(worst.position, 0.0);
    EXPECT_LT(worst.rotation, 1e-6) << k;
  }
}

TEST_F(SceneGlbTest, TurnsByHalfTheAngleInMidFrame) {
  clip_a_ = {kFps, {RestPose(body_a_), RestPose(body_a_)}};
  clip_b_ = {kFps, {RestPose(body_b_), RestPose(body_b_)}};
  const int shoulder = body_a_.FindLink("left_shoulder");
  clip_a_.frames[1].rotation[shoulder] = ExpSo3(Vec3(0, 0, kPi / 2));  // out to up
  clip_a_.frames[1].rotation[shoulder].coeffs() *= -1;                 // the same rotation
  const SceneMotion motion = ParseSceneGlb(Format(), "test.glb");
  std::vector<Vec3> read;
  motion.NodePositions(0.5 / kFps, "a", {"left_shoulder", "left_elbow"}, &read);
  const Vec3 direction = (read[1] - read[0]).normalized();
  EXPECT_LT((direction - Vec3(1, 1, 0).normalized()).norm(), 1e-6);
}

TEST_F(SceneGlbTest, KeepsQuaternionsUnitAndOnOneSide) {
  for (size_t k = 0; k < clip_a_.frames.size(); k += 2) {
    for (Quat& q : clip_a_.frames[k].rotation) q.coeffs() *= -1.000001;
  }
  const tinygltf::Model model = Load(Format());
  int checked = 0;
  for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
    if (channel.target_path != "rotation") continue;
    const float* q = Items<float>(model, model.animations[0].samplers[channel.sampler].output);
    for (int k = 0; k < kFrames; ++k, q += 4) {
      const Eigen::Map<const Eigen::Vector4f> now(q);
      EXPECT_NEAR(now.cast<double>().norm(), 1.0, 2e-7);
      if (k > 0) {
        EXPECT_GE(Eigen::Map<const Eigen::Vector4f>(q - 4).dot(now), 0.0F);
      }
      ++checked;
    }
  }
  EXPECT_EQ(checked, kFrames * (body_a_.num_links() + body_b_.num_links()));
}

TEST_F(SceneGlbTest, ASingleFrameIsAScene) {
  clip_a_.frames.resize(1);
  clip_b_.frames.resize(1);
  const SceneMotion motion = ParseSceneGlb(Format(), "test.glb");
  EXPECT_EQ(motion.key_times, std::vector<double>{0.0});
  const PosedBody posed = PoseBody(body_b_, clip_b_.frames[0]);
  for (const double t : {-1.0, 0.0, 5.0}) {
    std::vector<Vec3> read;
    motion.NodePositions(t, "b", {"left_finger_tip"}, &read);
    EXPECT_LT((read[0] - posed.node[body_b_.FindNode("left_finger_tip")]).norm(), 1e-6);
  }
}

TEST_F(SceneGlbTest, HoldsBeforeTheFirstAndAfterTheLastKey) {
  const SceneMotion motion = ParseSceneGlb(Format(), "test.glb");
  std::vector<Vec3> read;
  motion.NodePositions(-3.0, "a", {"root"}, &read);
  EXPECT_LT((read[0] - clip_a_.frames.front().root_position).norm(), 1e-6);
  motion.NodePositions(1e6, "a", {"root"}, &read);
  EXPECT_LT((read[0] - clip_a_.frames.back().root_position).norm(), 1e-6);
}

// Skins every vertex as glTF says and finds it on the capsule of its segment.
TEST_F(SceneGlbTest, SkinnedVerticesLieOnTheCapsules) {
  const tinygltf::Model model = Load(Format());
  for (int figure = 0; figure < 2; ++figure) {
    const Body& body = figure == 0 ? body_a_ : body_b_;
    const tinygltf::Skin& skin = model.skins.at(figure);
    const tinygltf::Primitive& primitive = model.meshes.at(figure).primitives.at(0);
    const float* position = Items<float>(model, primitive.attributes.at("POSITION"));
    const auto* joints = Items<std::uint16_t>(model, primitive.attributes.at("JOINTS_0"));
    const auto* weights = Items<std::uint8_t>(model, primitive.attributes.at("WEIGHTS_0"));
    const float* inverse_bind = Items<float>(model, skin.inverseBindMatrices);
    const int vertices =
        static_cast<int>(model.accessors[primitive.attributes.at("POSITION")].count);
    ASSERT_EQ(vertices, body.num_nodes() * kCapsuleVertices) << "all segments and the nose";
    EXPECT_EQ(model.nodes[skin.skeleton].name, figure == 0 ? "a/root" : "b/root");

    const int k = 3;
    const std::vector<Eigen::Isometry3d> world = WorldAtKey(model, k);
    const PosedBody posed = PoseBody(body, figure == 0 ? clip_a_.frames[k] : clip_b_.frames[k]);
    for (int v = 0; v < vertices - kCapsuleVertices; ++v) {
      const Node& node = body.nodes[1 + v / kCapsuleVertices];
      ASSERT_EQ(weights[4 * v] + weights[4 * v + 1] + weights[4 * v + 2] + weights[4 * v + 3], 255);
      // Their inner ends are on other links that do not meet them at their own joints' centres.
      if (node.name.find("shoulder") != std::string::npos || node.name == "left_thumb_tip")
        continue;
      const int joint = joints[4 * v];
      const Eigen::Map<const Eigen::Matrix4f> bind(inverse_bind + 16 * joint);
      const Eigen::Vector4d at(position[3 * v], position[3 * v + 1], position[3 * v + 2], 1);
      const Vec3 p = world[skin.joints[joint]] * (bind.cast<double>() * at).head<3>();
      const Vec3 a = posed.node[node.parent], axis = posed.node[body.FindNode(node.name)] - a;
      const double along = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
      ASSERT_NEAR((p - a - along * axis).norm(), node.radius, 2e-6) << node.name;
    }
  }
}

TEST(CapsuleMesh, IsClosedAndFacesOutwards) {
  TriangleMesh mesh;
  AppendCapsule(Vec3(1, 2, 3), Vec3(1.5, 2.2, 2), 0.3, &mesh);
  AppendCapsule(Vec3::Zero(), Vec3::Zero(), 0.3, &mesh);  // a sphere
  ASSERT_EQ(mesh.position.size(), 2U * kCapsuleVertices);
  std::map<std::pair<int, int>, int> edges;
  for (size_t i = 0; i < mesh.corner.size(); i += 3) {
    const int c[3] = {mesh.corner[i], mesh.corner[i + 1], mesh.corner[i + 2]};
    for (int e = 0; e < 3; ++e) ++edges[{c[e], c[(e + 1) % 3]}];
    const Vec3 face = (mesh.position[c[1]] - mesh.position[c[0]])
                          .cross(mesh.position[c[2]] - mesh.position[c[0]]);
    const Vec3 normal = mesh.normal[c[0]] + mesh.normal[c[1]] + mesh.normal[c[2]];
    if (face.norm() > 1e-12) {  // the sphere's tube is flat
      EXPECT_GT(face.dot(normal), 0.0);
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << "an open edge";
  }
}

TEST_F(SceneGlbTest, TheSameSceneGivesTheSameBytes) { EXPECT_EQ(Format(), Format()); }

// Runs Khronos' validator. Skips where node or the module is not installed.
TEST_F(SceneGlbTest, PassesTheKhronosValidator) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no node here";
  const std::string path = testing::TempDir() + "scene_glb_test.glb";
  const std::string still_path = testing::TempDir() + "scene_glb_test_still.glb";
  const std::string verdict = path + ".json";
  std::ofstream(path, std::ios::binary) << Format();
  clip_a_.frames.resize(1);
  clip_b_.frames.resize(1);
  std::ofstream(still_path, std::ios::binary) << Format();
  const std::string command = "node '" + ProjectPath("tests/tools/validate_glb.mjs") + "' '" +
                              path + "' '" + still_path + "' > '" + verdict + "' 2> /dev/null";
  const int status = WEXITSTATUS(std::system(command.c_str()));
  const std::string text = ReadWholeFile(verdict);
  for (const std::string& file : {path, still_path, verdict}) std::filesystem::remove(file);
  if (status == 3) {
    GTEST_SKIP() << "gltf-validator is not installed: npm install gltf-validator, then set "
                    "RETARGET_NODE_MODULES to its node_modules";
  }
  EXPECT_EQ(status, 0) << text;
  const std::string clean = "\"errors\":0,\"warnings\":0,\"infos\":0";
  const size_t first = text.find(clean);
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_NE(text.find(clean, first + 1), std::string::npos) << text;
}

// ---- What is not a scene is refused.

std::string MessageOf(const std::string& bytes) {
  try {
    ParseSceneGlb(bytes, "bad.glb");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(SceneGlbTest, RefusesTruncatedFiles) {
  const std::string bytes = Format();
  int checked = 0;
  for (size_t size = 0; size < bytes.size(); size += 97, ++checked) {
    ASSERT_THROW(ParseSceneGlb(bytes.substr(0, size), "bad.glb"), InputError) << size;
  }
  for (size_t cut = 1; cut <= 16; ++cut, ++checked) {
    const std::string shorter = bytes.substr(0, bytes.size() - cut);
    ASSERT_THROW(ParseSceneGlb(shorter, "bad.glb"), InputError) << cut;
  }
  EXPECT_GT(checked, 1000);
}

TEST_F(SceneGlbTest, SurvivesFlippedBytes) {
  const std::string bytes = Format();
  std::uint32_t json_length;
  std::memcpy(&json_length, bytes.data() + 12, 4);
  std::mt19937 random(7);
  int refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    // Every second one hits the header or the document, where it hurts.
    const size_t range = trial % 2 == 0 ? bytes.size() : 20 + json_length;
    std::string flipped = bytes;
    flipped[random() % range] ^= static_cast<char>(1 + random() % 255);
    try {
      const SceneMotion motion = ParseSceneGlb(flipped, "bad.glb");
      std::vector<Vec3> read;
      motion.NodePositions(0.1, "a", NodeNames(body_a_), &read);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, 100);
}

TEST_F(SceneGlbTest, SaysWhatIsWrong) {
  EXPECT_NE(MessageOf("").find("bad.glb: damaged"), std::string::npos);
  std::string spline = Format();
  spline.replace(spline.find("\"LINEAR\""), 8, "\"SPLINE\"");
  EXPECT_NE(MessageOf(spline).find("SPLINE, expected LINEAR"), std::string::npos);
  std::string twins = Format();
  twins.replace(twins.find("\"a/left_hip\""), 12, "\"a/left_toe\"");
  EXPECT_NE(MessageOf(twins).find("two nodes are called \"a/left_toe\""), std::string::npos);
  EXPECT_THROW(ReadSceneGlb("/no/such/file.glb"), InputError);
  const SceneMotion motion = ParseSceneGlb(Format(), "test.glb");
  std::vector<Vec3> read;
  EXPECT_THROW(motion.NodePositions(0, "a", {"tail"}, &read), InputError);
}

}  // namespace
}  // namespace retarget::io
