// Scenes with the user's characters, played by the oracle of tests/io/gltf_oracle.h beside what
// they are made of: FormatGltf's file and the plain scene. Read by Khronos' validator, too.
#include "io/scene/character_scene.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "io/scene/scene_glb.h"
#include "tests/io/gltf/gltf_maker.h"
#include "tests/io/gltf/gltf_oracle.h"

namespace retarget::io {
namespace {

constexpr int kFrames = 6;
constexpr double kFps = 30;

std::string CharacterPath(const std::string& file) { return SharedPath("data/characters/") + file; }

Clip SomeClip(const Body& body, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> metres(-1, 1);
  Clip clip;
  clip.fps = kFps;
  for (int k = 0; k < kFrames; ++k) {
    Pose pose = RestPose(body);
    pose.root_position = Vec3(metres(random), 1, metres(random));
    for (Quat& q : pose.rotation) q = SomeRotation(&random, 0.3);
    clip.frames.push_back(pose);
  }
  return clip;
}

std::string PlainScene() {
  const Body body = StandardBody(AverageMeasures(1.8));
  const Clip a = SomeClip(body, 1), b = SomeClip(body, 2);
  return FormatSceneGlb({{"a", &body, &a, kColourA}, {"b", &body, &b, kColourB}}, "test");
}

// Other rotations everywhere and another way of the roots, at the scene's rate.
RigMotion SomeMotion(const GltfClip& clip, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.3);
  RigMotion out = clip.motion;
  out.frame_time = 1 / kFps;
  out.frames.assign(kFrames, clip.motion.frames.front());
  for (RigFrame& frame : out.frames) {
    for (Quat& q : frame.rotation) q = q * SomeRotation(&random, 0.3);
    for (size_t j = 0; j < frame.translation.size(); ++j) {
      if (out.rig.joints[j].parent >= 0) continue;
      frame.translation[j] += Vec3(normal(random), normal(random), normal(random));
    }
  }
  return out;
}

// The awkward character with all that is to be merged: a textured material with extensions, a
// morph target, a scale in the animation, a camera, a light, and VRM's extension.
constexpr char kPng[] = "\x89PNG of our own making";
nlohmann::ordered_json Parsed(const std::string& text) {
  return nlohmann::ordered_json::parse(text);
}

GltfMaker DressedCharacter(const std::string& image_uri = "") {
  GltfMaker maker = AwkwardCharacter();
  auto& document = maker.document;
  document["nodes"][9].erase("translation");
  std::mt19937 random(11);
  const int a = maker.AddAnimation("captured");
  const int times = maker.AddArray(Times(3, 25), "SCALAR");
  maker.AddChannel(a, 4, "scale", times, maker.AddArray(std::vector<float>(9, 0.75F), "VEC3"));
  maker.AddChannel(a, 5, "rotation", times, maker.AddArray(SomeRotations(&random, 3), "VEC4"));
  const int shape = maker.AddArray<float>({0, 0, 0, 0, 0, 1, 0, 0, 2}, "VEC3");
  document["meshes"][0]["weights"] = Parsed("[0.25]");
  document["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = shape;
  document["meshes"][0]["primitives"][0]["material"] = 1;
  document["images"] = Parsed(R"([{"uri": "data:image/png;base64,iVBORw0KGgo="},
                                  {"name": "skin"}])");
  if (image_uri.empty()) {
    while (maker.data.size() % 4 != 0) maker.data.push_back('\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", maker.data.size()}, {"byteLength", sizeof kPng - 1}});
    maker.data.append(kPng, sizeof kPng - 1);
    document["images"][1]["bufferView"] = maker.Size("bufferViews") - 1;
    document["images"][1]["mimeType"] = "image/png";
  } else {
    document["images"][1]["uri"] = image_uri;
  }
  document["samplers"] = Parsed(R"([{"wrapS": 10497}, {"wrapS": 33071}])");
  document["textures"] = Parsed(R"([{"source": 0, "sampler": 0}, {"source": 1, "sampler": 1}])");
  document["materials"] = Parsed(R"([
      {"name": "unused", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
      {"name": "coat",
       "pbrMetallicRoughness": {
         "baseColorTexture": {"index": 1,
                              "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}},
         "metallicFactor": 0},
       "extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 1}},
                      "EXT_of_nobody": {"index": 77}}}])");
  document["cameras"] = Parsed(R"([{"type": "perspective"}])");
  document["nodes"][6]["camera"] = 0;
  document["nodes"][6]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  document["extensions"] = Parsed(R"({"KHR_lights_punctual": {"lights": [{"type": "point"}]}})");
  document["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform",
                                "KHR_materials_clearcoat", "EXT_of_nobody"};
  document["asset"]["copyright"] = "CC BY Somebody";
  return maker;
}

int NodeCalled(const GltfOracle& oracle, const std::string& name) {
  int found = -1;
  for (size_t n = 0; n < oracle.document["nodes"].size(); ++n) {
    if (oracle.document["nodes"][n].value("name", "") != name) continue;
    EXPECT_EQ(found, -1) << "two nodes are called " << name;
    found = static_cast<int>(n);
  }
  EXPECT_GE(found, 0) << name;
  return found;
}

// The bytes of a view, or of an accessor's view.
std::string ViewBytes(const GltfOracle& oracle, const json& index) {
  const json& view = oracle.document["bufferViews"][index.get<size_t>()];
  return oracle.buffers[view["buffer"].get<size_t>()].substr(view.value("byteOffset", size_t{0}),
                                                             view["byteLength"]);
}

// World positions of a mesh node's vertices, by glTF's rule: sum of weight * joint * inverse bind.
std::vector<Vec3> Skinned(const GltfOracle& oracle, const json& node,
                          const std::vector<Matrix4>& globals) {
  const json& skin = oracle.document["skins"][node["skin"].get<size_t>()];
  const json& mesh = oracle.document["meshes"][node["mesh"].get<size_t>()];
  std::vector<std::vector<double>> inverse;
  if (skin.contains("inverseBindMatrices")) inverse = oracle.Items(skin["inverseBindMatrices"]);
  std::vector<Vec3> out;
  for (const json& primitive : mesh["primitives"]) {
    const json& attributes = primitive["attributes"];
    const auto position = oracle.Items(attributes["POSITION"]);
    const auto joint = oracle.Items(attributes["JOINTS_0"]);
    const auto weight = oracle.Items(attributes["WEIGHTS_0"]);
    const size_t step = std::max<size_t>(1, position.size() / 50);
    for (size_t v = 0; v < position.size(); v += step) {
      Eigen::Vector4d p = Eigen::Vector4d::Zero();
      for (size_t i = 0; i < 4; ++i) {
        const size_t j = static_cast<size_t>(joint[v][i]);
        const Matrix4 bind = inverse.empty() ? Matrix4::Identity() : Matrix4(inverse[j].data());
        const Vec3 own = Vec3::Map(position[v].data());
        p += weight[v][i] * globals[skin["joints"][j].get<size_t>()] * bind * own.homogeneous();
      }
      out.push_back(p.head<3>());
    }
  }
  return out;
}

// Checks one character of a scene against FormatGltf's file, at keys and between them: all joints
// and the skinned vertices.
void CheckCharacter(const std::string& scene, const SceneCharacter& character,
                    const std::string& prefix) {
  const GltfClip& clip = *character.clip;
  const GltfOracle after(scene), before(FormatGltf(clip, *character.motion), clip.folder);
  const int animation = before.AnimationNamed("retargeted");
  std::vector<int> node;
  for (const RigJoint& joint : clip.motion.rig.joints) {
    node.push_back(NodeCalled(after, prefix + joint.name));
  }
  const double begin = before.Span(animation).first;
  double worst_joint = 0, worst_vertex = 0;
  int vertices = 0;
  for (const double key : {0.0, 0.3, 1.0, 2.5, 4.9, 5.0}) {
    const auto x = before.Globals(animation, begin + key / kFps), y = after.Globals(0, key / kFps);
    for (size_t j = 0; j < node.size(); ++j) {
      const Matrix4 difference = x[clip.joints[j].node] - y[node[j]];
      worst_joint = std::max(worst_joint, difference.cwiseAbs().maxCoeff());
    }
    // The meshes of the selected skins, in the file's order in both.
    std::vector<const json*> old_meshes, new_meshes;
    for (const json& n : before.document["nodes"]) {
      if (!n.contains("skin")) continue;
      const auto& skins = clip.skins;
      if (std::find(skins.begin(), skins.end(), n["skin"].get<int>()) != skins.end()) {
        old_meshes.push_back(&n);
      }
    }
    for (const json& n : after.document["nodes"]) {
      if (n.contains("skin") && n["name"].get<std::string>().starts_with(prefix)) {
        new_meshes.push_back(&n);
      }
    }
    ASSERT_EQ(old_meshes.size(), new_meshes.size());
    for (size_t m = 0; m < old_meshes.size(); ++m) {
      const auto p = Skinned(before, *old_meshes[m], x), q = Skinned(after, *new_meshes[m], y);
      ASSERT_EQ(p.size(), q.size());
      for (size_t v = 0; v < p.size(); ++v, ++vertices) {
        worst_vertex = std::max(worst_vertex, (p[v] - q[v]).norm());
      }
    }
  }
  EXPECT_LT(worst_joint, 1e-5) << clip.name;
  EXPECT_LT(worst_vertex, 1e-5) << clip.name;
  EXPECT_GT(vertices, 10) << clip.name;
}

// All nodes of the contract are where the plain scene has them, to the last bit.
void CheckContract(const std::string& plain, const std::string& scene) {
  const SceneMotion x = ParseSceneGlb(plain, "plain"), y = ParseSceneGlb(scene, "characters");
  EXPECT_EQ(x.key_times, y.key_times);
  const GltfOracle before(plain), after(scene);
  std::vector<std::string> names;
  for (const json& node : before.document["nodes"]) {
    const std::string name = node["name"];
    if (name.find('/') == std::string::npos) continue;
    names.push_back(name);
    json a = node, b = after.document["nodes"][NodeCalled(after, name)];
    for (json* n : {&a, &b}) n->erase("children");
    EXPECT_EQ(a, b);
  }
  EXPECT_GE(names.size(), 42U);
  for (const double key : {0.0, 0.4, 1.0, 3.7, 5.0}) {
    for (const std::string figure : {"a", "b"}) {
      std::vector<std::string> own;
      for (const std::string& name : names) {
        if (name.starts_with(figure + "/")) own.push_back(name.substr(2));
      }
      std::vector<Vec3> p, q;
      x.NodePositions(key / kFps, figure, own, &p);
      y.NodePositions(key / kFps, figure, own, &q);
      EXPECT_EQ(p, q);
    }
  }
  // The animation begins with the plain one, and adds nothing to the contract's nodes.
  ASSERT_EQ(after.document["animations"].size(), 1U);
  const json &old = before.document["animations"][0], &now = after.document["animations"][0];
  std::map<std::string, int> tracks;
  for (size_t c = 0; c < now["channels"].size(); ++c) {
    const json& channel = now["channels"][c];
    const json& sampler = now["samplers"][channel["sampler"].get<size_t>()];
    const std::string name =
        after.document["nodes"][channel["target"]["node"].get<size_t>()]["name"];
    const std::string path = channel["target"]["path"];
    EXPECT_EQ(++tracks[name + " " + path], 1);
    EXPECT_EQ(sampler["interpolation"], "LINEAR");
    EXPECT_EQ(sampler["input"], now["samplers"][0]["input"]);
    EXPECT_NE(path, "scale");
    EXPECT_EQ(name.find('/') == 1, c < old["channels"].size()) << name;
    if (c >= old["channels"].size()) continue;
    const json& was = old["samplers"][old["channels"][c]["sampler"].get<size_t>()];
    EXPECT_EQ(after.Items(sampler["output"]), before.Items(was["output"]));
  }
  EXPECT_EQ(tracks.count("a/root translation") + tracks.count("b/root translation"), 2U);
}

// ---- Motion.

TEST(CharacterScene, PlaysAsTheFilesItIsMadeOf) {
  const std::string plain = PlainScene();
  const GltfClip clip = ParseGltf(DressedCharacter().Glb(), "a.glb", "");
  const RigMotion first = SomeMotion(clip, 3), second = SomeMotion(clip, 4);
  const SceneCharacter a{&clip, &first}, b{&clip, &second};
  const std::string one = FormatCharacterScene(plain, {nullptr, &b});
  CheckContract(plain, one);
  CheckCharacter(one, b, "b character/");
  const std::string two = FormatCharacterScene(plain, {&a, &b});
  CheckContract(plain, two);
  CheckCharacter(two, a, "a character/");
  CheckCharacter(two, b, "b character/");
  // Only the figure that stays a capsule figure has its mesh.
  const auto meshes = [](const std::string& scene) {
    std::set<std::string> names;
    const GltfOracle oracle(scene);
    for (const json& node : oracle.document["nodes"]) {
      if (node.contains("mesh")) names.insert(node["name"]);
    }
    return names;
  };
  EXPECT_EQ(meshes(one), (std::set<std::string>{"a mesh", "b character/mesh", "b character/prop"}));
  EXPECT_EQ(meshes(two), (std::set<std::string>{"a character/mesh", "a character/prop",
                                                "b character/mesh", "b character/prop"}));
}

TEST(CharacterScene, ShowsRealCharacters) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string plain = PlainScene();
  const std::pair<const char*, const char*> pairs[] = {
      {"m2m_human-male.glb", "m2m_mixamo-sample-rig.glb"},
      {"cesium_man.gltf", "rigged_simple.gltf"}};
  for (const auto& [file_a, file_b] : pairs) {
    const GltfClip clip_a = ReadGltf(CharacterPath(file_a)),
                   clip_b = ReadGltf(CharacterPath(file_b));
    const RigMotion motion_a = SomeMotion(clip_a, 5), motion_b = SomeMotion(clip_b, 6);
    const SceneCharacter a{&clip_a, &motion_a}, b{&clip_b, &motion_b};
    std::vector<std::string> notes;
    const std::string scene = FormatCharacterScene(plain, {&a, &b}, &notes);
    EXPECT_TRUE(notes.empty()) << notes[0];
    CheckContract(plain, scene);
    CheckCharacter(scene, a, "a character/");
    CheckCharacter(scene, b, "b character/");
  }
}

// ---- What is merged.

// All that a material, mesh or image says once its indices are followed: equal documents give equal
// trees, whatever their indices.
json Followed(const GltfOracle& oracle, const json& value, const std::string& key);

json Bytes(const std::string& text) {
  return json::binary(std::vector<std::uint8_t>(text.begin(), text.end()));
}

json FollowedItem(const GltfOracle& oracle, const char* array, const json& index) {
  json item = Followed(oracle, oracle.document[array][index.get<size_t>()], array);
  if (array == std::string("bufferViews")) {
    for (const char* key : {"buffer", "byteOffset"}) item.erase(key);
    item["bytes"] = Bytes(ViewBytes(oracle, index));
  }
  if (array == std::string("images")) {  // wherever it is kept
    const std::string uri = item.value("uri", "");
    item["bytes"] = uri.empty() ? item["bufferView"]["bytes"]
                                : Bytes(FromBase64(uri.substr(uri.find(',') + 1)));
    for (const char* key : {"uri", "bufferView", "mimeType"}) item.erase(key);
  }
  return item;
}

json Followed(const GltfOracle& oracle, const json& value, const std::string& key) {
  if (value.is_array()) {
    json out = json::array();
    for (const json& item : value) out.push_back(Followed(oracle, item, key));
    return out;
  }
  if (!value.is_object()) return value;
  json out = json::object();
  for (const auto& [name, member] : value.items()) {
    if (name == "KHR_draco_mesh_compression") {  // its attributes are its own numbers
      out[name] = member;
      out[name]["bufferView"] = FollowedItem(oracle, "bufferViews", member["bufferView"]);
      continue;
    }
    const bool attribute = key == "attributes" || key == "targets";
    const char* array = attribute || name == "indices"                ? "accessors"
                        : name == "material"                          ? "materials"
                        : name == "bufferView"                        ? "bufferViews"
                        : name == "source"                            ? "images"
                        : name == "sampler"                           ? "samplers"
                        : name == "index" && key.ends_with("Texture") ? "textures"
                                                                      : nullptr;
    out[name] = array != nullptr && member.is_number() ? FollowedItem(oracle, array, member)
                                                       : Followed(oracle, member, name);
  }
  return out;
}

json MeshOf(const GltfOracle& oracle, const json& node) {
  return Followed(oracle, oracle.document["meshes"][node["mesh"].get<size_t>()], "mesh");
}

TEST(CharacterScene, MeshesMaterialsAndImagesKeepTheirBytes) {
  const std::string plain = PlainScene();
  GltfMaker maker = DressedCharacter();
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  const RigMotion motion = SomeMotion(clip, 3);
  const SceneCharacter a{&clip, &motion};
  std::vector<std::string> notes;
  const GltfOracle after(FormatCharacterScene(plain, {&a, nullptr}, &notes)), before(clip.bytes);
  const json& mesh = after.document["nodes"][NodeCalled(after, "a character/mesh")];
  json expected = MeshOf(before, before.document["nodes"][9]);
  expected["primitives"][0]["material"]["extensions"].erase("EXT_of_nobody");
  EXPECT_EQ(MeshOf(after, mesh), expected);
  const json& picture = expected["primitives"][0]["material"]["pbrMetallicRoughness"]
                                ["baseColorTexture"]["index"]["source"];
  EXPECT_EQ(picture["bytes"], Bytes(kPng));
  EXPECT_EQ(after.document["extensionsUsed"],
            json({"KHR_materials_clearcoat", "KHR_texture_transform"}));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0],
            "a.glb: extensions left out of the scene: EXT_of_nobody, KHR_lights_punctual");
  EXPECT_EQ(after.document["asset"]["copyright"], "CC BY Somebody");
  EXPECT_EQ(after.document["asset"]["generator"], "test");
  // Only what is used: no second material, texture or image, no camera.
  EXPECT_EQ(after.document["images"].size(), 1U);
  EXPECT_EQ(after.document["textures"].size(), 1U);
  EXPECT_EQ(after.document["samplers"].size(), 1U);
  EXPECT_EQ(after.document["materials"].size(), 2U) << "b's capsules and the coat";
  EXPECT_FALSE(after.document.contains("cameras"));
  EXPECT_FALSE(after.document.contains("extensions"));
}

TEST(CharacterScene, RealMeshesKeepTheirBytesAndEqualDataAreKeptOnce) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string plain = PlainScene();
  for (const char* file : {"m2m_human-male.glb", "m2m_mixamo-sample-rig.glb", "cesium_man.gltf"}) {
    const GltfClip clip = ReadGltf(CharacterPath(file));
    const RigMotion first = SomeMotion(clip, 3), second = SomeMotion(clip, 4);
    const SceneCharacter a{&clip, &first}, b{&clip, &second};
    const std::string one = FormatCharacterScene(plain, {&a, nullptr});
    const std::string two = FormatCharacterScene(plain, {&a, &b});
    const GltfOracle before(clip.bytes), after(two);
    int meshes = 0;
    for (const auto& node : before.document["nodes"]) {
      if (!node.contains("mesh")) continue;
      const json expected = MeshOf(before, node);
      for (const std::string prefix : {"a character/", "b character/"}) {
        int equal = 0;
        for (const json& other : after.document["nodes"]) {
          if (!other.contains("mesh") || !other["name"].get<std::string>().starts_with(prefix)) {
            continue;
          }
          equal += MeshOf(after, other) == expected;
        }
        EXPECT_EQ(equal, 1) << file << " " << prefix;
        ++meshes;
      }
    }
    EXPECT_GE(meshes, 2);
    EXPECT_LT(two.size(), one.size() + clip.bytes.size() / 4) << file;
  }
}

// Two people in one file: nodes, skins and meshes of the other one stay out.
TEST(CharacterScene, ShowsOnlyTheSelectedCharacter) {
  GltfMaker maker = DressedCharacter();
  const int other = maker.AddNode("other", -1, Vec3(1, 0, 0));
  maker.AddNode("other tip", other, Vec3(0, 1, 0));
  const int hat = maker.AddNode("other hat", other, Vec3(0, 1, 0));
  const int body = maker.AddNode("other mesh", -1, Vec3::Zero());
  auto& document = maker.document;
  document["skins"].push_back({{"name", "else"}, {"joints", {other, other + 1}}});
  document["nodes"][body]["mesh"] = 0;
  document["nodes"][body]["skin"] = 1;
  document["nodes"][hat]["mesh"] = 1;
  // A coarser body that no scene shows.
  const int spare = maker.AddNode("spare", -1, Vec3::Zero());
  document["nodes"][spare]["mesh"] = 0;
  document["nodes"][spare]["skin"] = 0;
  auto& roots = document["scenes"][0]["nodes"];
  roots.erase(roots.size() - 1);
  const std::string plain = PlainScene();
  const GltfClip first = ParseGltf(maker.Glb(), "a.glb", "", {"", "person"});
  const GltfClip second = ParseGltf(maker.Glb(), "a.glb", "", {"", "else"});
  const RigMotion one = SomeMotion(first, 3), two = SomeMotion(second, 4);
  const SceneCharacter a{&first, &one}, b{&second, &two};
  const GltfOracle scene(FormatCharacterScene(plain, {&a, &b}));
  std::set<std::string> names;
  for (const json& node : scene.document["nodes"]) {
    const std::string name = node["name"];
    if (name.find("character") != std::string::npos) names.insert(name);
  }
  EXPECT_EQ(names, (std::set<std::string>{
                       "a character/armature", "a character/turned", "a character/hips",
                       "a character/between", "a character/chest", "a character/joint_5",
                       "a character/leaf", "a character/prop", "a character/chest_8",
                       "a character/mesh", "b character/other", "b character/other tip",
                       "b character/other hat", "b character/other mesh"}));
  EXPECT_EQ(scene.document["skins"].size(), 2U);
}

TEST(CharacterScene, EmbedsFilesOfTheFolderAlone) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "character_scene_test";
  fs::create_directories(folder / "model" / "my textures");
  const auto write = [](const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  };
  const std::string plain = PlainScene();
  for (const std::string uri : {"my%20textures/skin.png", "../skin.png", "nothing.png"}) {
    GltfMaker maker = DressedCharacter(uri);
    maker.document["buffers"][0]["uri"] = "data.bin";
    write(folder / "model" / "a.gltf", maker.Text());
    write(folder / "model" / "data.bin", maker.data);
    write(folder / "model" / "my textures" / "skin.png", kPng);
    write(folder / "skin.png", kPng);
    const GltfClip clip = ReadGltf(folder / "model" / "a.gltf");
    const RigMotion motion = SomeMotion(clip, 3);
    const SceneCharacter a{&clip, &motion};
    std::vector<std::string> notes;
    const std::string bytes = FormatCharacterScene(plain, {&a, nullptr}, &notes);
    const GltfOracle scene(bytes);
    EXPECT_EQ(scene.document["buffers"],
              json::array({json{{"byteLength", scene.buffers[0].size()}}}));
    const json& coat = scene.document["materials"].back();
    if (uri.starts_with("my")) {
      CheckCharacter(bytes, a, "a character/");
      ASSERT_EQ(scene.document["images"].size(), 1U);
      const json& image = scene.document["images"][0];
      EXPECT_EQ(ViewBytes(scene, image["bufferView"]), kPng);
      EXPECT_EQ(image["mimeType"], "image/png");
      EXPECT_EQ(notes.size(), 1U);
      continue;
    }
    EXPECT_FALSE(scene.document.contains("images"));
    EXPECT_FALSE(scene.document.contains("textures"));
    EXPECT_EQ(coat["name"], "coat");
    EXPECT_FALSE(coat["pbrMetallicRoughness"].contains("baseColorTexture"));
    EXPECT_FALSE(coat["extensions"]["KHR_materials_clearcoat"].contains("clearcoatTexture"));
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_NE(notes[0].find("images[1] (\"" + uri + "\") is no file in the model's folder"),
              std::string::npos)
        << notes[0];
  }
  fs::remove_all(folder);
}

TEST(CharacterScene, KnowsTheIndicesInExtensions) {
  GltfMaker maker = DressedCharacter();
  auto& document = maker.document;
  document["textures"][1]["extensions"]["KHR_texture_basisu"]["source"] = 0;
  document["meshes"][0]["primitives"][0]["extensions"] = Parsed(R"(
      {"KHR_draco_mesh_compression": {"bufferView": 1, "attributes": {"POSITION": 40}},
       "KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]}]}})");
  document["nodes"][7]["extensions"] = Parsed(R"(
      {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}, "MSFT_lod": {"ids": [1]}})");
  document["extensionsUsed"] = Parsed(R"(["KHR_mesh_quantization"])");
  document["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_texture_basisu",
                                    "KHR_materials_variants"};
  document["extensions"]["VRMC_vrm"] = Parsed(R"({"humanoid": {"humanBones": {}}})");
  document["extensions"]["VRMC_springBone"] = Parsed(R"({"joints": [{"node": 4}]})");
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  const RigMotion motion = SomeMotion(clip, 3);
  const SceneCharacter a{&clip, &motion};
  std::vector<std::string> notes;
  const GltfOracle after(FormatCharacterScene(PlainScene(), {&a, nullptr}, &notes));
  const GltfOracle before(clip.bytes);
  json expected = MeshOf(before, before.document["nodes"][9]);
  json& primitive = expected["primitives"][0];
  primitive["extensions"].erase("KHR_materials_variants");
  primitive["material"]["extensions"].erase("EXT_of_nobody");
  const json& mesh = after.document["nodes"][NodeCalled(after, "a character/mesh")];
  EXPECT_EQ(MeshOf(after, mesh), expected);
  EXPECT_EQ(after.document["images"].size(), 2U);
  EXPECT_EQ(after.document["images"][1]["mimeType"], "image/png");
  const json& prop = after.document["nodes"][NodeCalled(after, "a character/prop")];
  const json& instances = prop["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  EXPECT_EQ(after.Items(instances["TRANSLATION"]), before.Items(0));
  EXPECT_EQ(prop["extensions"].size(), 1U);
  EXPECT_EQ(after.document["extensionsRequired"],
            json({"KHR_mesh_quantization", "KHR_texture_basisu"}));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0],
            "a.glb: extensions left out of the scene: EXT_of_nobody, KHR_lights_punctual, "
            "KHR_materials_variants, MSFT_lod, VRMC_springBone, VRMC_vrm");
}

// ---- Refusals.

std::string Refusal(const GltfMaker& maker) {
  static const std::string plain = PlainScene();
  GltfMaker copy = maker;
  const GltfClip clip = ParseGltf(copy.Glb(), "a.glb", "");
  const RigMotion motion = SomeMotion(clip, 3);
  const SceneCharacter a{&clip, &motion};
  try {
    FormatCharacterScene(plain, {&a, nullptr});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CharacterScene, RefusesWhatCannotBeShown) {
  GltfMaker maker = DressedCharacter();
  maker.document["extensionsRequired"] = Parsed(R"(["EXT_of_nobody"])");
  EXPECT_EQ(Refusal(maker),
            "a.glb: requires the extension \"EXT_of_nobody\", which a scene of several files "
            "cannot carry, expected a character without it");
  maker = DressedCharacter();
  for (const int node : {7, 9}) maker.document["nodes"][node].erase("mesh");
  EXPECT_EQ(Refusal(maker), "a.glb: no mesh of the character, expected one to show");
  maker = DressedCharacter();
  maker.document["textures"][1]["source"] = 2;
  EXPECT_EQ(Refusal(maker), "a.glb: expected an index of one of 2 images, found 2");
}

// Any member of what the reader does not look at, replaced by something else.
TEST(CharacterScene, BrokenMaterialsAndImagesAreRefusedOrShown) {
  std::mt19937 random(7);
  const std::vector<json> odd = {nullptr,
                                 -1,
                                 0,
                                 1,
                                 99,
                                 1.5,
                                 "x",
                                 json::array(),
                                 json::object(),
                                 json{{"index", 3}},
                                 json{{"index", 0}},
                                 json::array({1, 2})};
  int shown = 0, refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    GltfMaker maker = DressedCharacter();
    const char* arrays[] = {"materials", "textures", "images", "samplers", "meshes", "scenes"};
    nlohmann::ordered_json* place = &maker.document[arrays[random() % 6]];
    while (place->is_structured() && !place->empty() && (place->is_array() || random() % 4 != 0)) {
      place = &*std::next(place->begin(), static_cast<int>(random() % place->size()));
    }
    *place = odd[random() % odd.size()];
    try {
      (Refusal(maker).empty() ? shown : refused) += 1;
    } catch (const InputError&) {  // by the reader
    }
  }
  EXPECT_GT(shown, 30);
  EXPECT_GT(refused, 30);
}

// ---- Khronos' validator.

json Validate(const std::vector<std::string>& files) {
  if (std::system("node --version > /dev/null 2>&1") != 0) return {};
  const std::string verdict = testing::TempDir() + "character_scene_test.json";
  std::string command = "node '" + ProjectPath("tests/tools/validate_glb.mjs") + "'";
  for (const std::string& file : files) command += " '" + file + "'";
  const int status = WEXITSTATUS(std::system((command + " > '" + verdict + "' 2>&1").c_str()));
  const std::string text = ReadWholeFile(verdict);
  std::filesystem::remove(verdict);
  return status == 3 ? json() : json::parse(text);
}

TEST(CharacterScene, AddsNothingToTheValidatorsReport) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "character_scene_validate";
  std::filesystem::create_directories(folder);
  std::vector<std::string> files;
  const auto add = [&](const std::string& name, const std::string& bytes) {
    files.push_back(folder / name);
    std::ofstream(files.back(), std::ios::binary) << bytes;
  };
  const std::string plain = PlainScene();
  const auto add_pair = [&](const std::string& name, const GltfClip& clip) {
    const RigMotion first = SomeMotion(clip, 3), second = SomeMotion(clip, 4);
    const SceneCharacter a{&clip, &first}, b{&clip, &second};
    add("in_" + name, clip.bytes);
    add("out_" + name, FormatCharacterScene(plain, {&a, &b}));
  };
  GltfMaker maker = AwkwardCharacter();
  maker.document["nodes"][9].erase("translation");
  add_pair("awkward.glb", ParseGltf(maker.Glb(), "a.glb", ""));
  for (const char* file : {"m2m_human-male.glb", "m2m_mixamo-sample-rig.glb", "cesium_man.gltf"}) {
    add_pair(file, ReadGltf(CharacterPath(file)));
  }
  const json found = Validate(files);
  std::filesystem::remove_all(folder);
  if (found.is_null()) GTEST_SKIP() << "gltf-validator is not installed";
  for (size_t i = 0; i < files.size(); i += 2) {
    const json &before = found[files[i]], &after = found[files[i + 1]];
    const std::string messages = files[i] + after["messages"].dump().substr(0, 1500);
    for (const char* kind : {"errors", "warnings"}) {  // two of each character
      EXPECT_LE(after[kind].get<int>(), 2 * before[kind].get<int>()) << messages;
    }
  }
}

}  // namespace
}  // namespace retarget::io
