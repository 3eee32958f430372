// Files that are wrong: refused with one line, or right all the same; never a crash, a hang or a
// great allocation.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <random>

#include "io/gltf/clip.h"
#include "tests/io/gltf/gltf_maker.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

// The message of a refusal; empty where the file is taken, and then all that can be done with it
// has been done.
std::string Refusal(const std::string& bytes, const std::string& folder = "") {
  try {
    const GltfClip clip = ParseGltf(bytes, "bad", folder);
    EXPECT_FALSE(clip.motion.frames.empty());
    for (const RigFrame& frame : clip.motion.frames) {
      for (size_t j = 0; j < clip.joints.size(); ++j) {
        EXPECT_TRUE(frame.translation[j].allFinite());
        EXPECT_NEAR(frame.rotation[j].norm(), 1, 1e-9);
      }
    }
    try {
      BoneRadii(clip);
    } catch (const InputError&) {  // a mesh may be damaged where the motion is not
    }
    const std::string written = FormatGltf(clip, clip.motion);
    ParseGltf(written, "again", folder, {"retargeted", ""});
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 500U) << message;
    return message;
  }
  return "";
}

// A healthy file: the awkward character, with matrices of its skin, and an animation.
GltfMaker Healthy() {
  GltfMaker maker = AwkwardCharacter();
  maker.document["nodes"][2].erase("matrix");
  std::vector<float> inverse;
  for (int i = 0; i < 4 * 16; ++i) inverse.push_back(i % 16 % 5 == 0 ? 1.0F : 0.0F);
  const int matrices = maker.AddArray(inverse, "MAT4");
  maker.document["skins"][0]["inverseBindMatrices"] = matrices;
  std::mt19937 random(21);
  const int a = maker.AddAnimation("walk");
  const int times = maker.AddArray(Times(4, 30), "SCALAR");
  const int rotations = maker.AddArray(SomeRotations(&random, 4), "VEC4");
  const int translations = maker.AddArray(SomeTranslations(&random, 4, Vec3(0, 90, 0)), "VEC3");
  maker.AddChannel(a, 2, "rotation", times, rotations);
  maker.AddChannel(a, 2, "translation", times, translations);
  maker.AddChannel(a, 4, "rotation", times, rotations);
  return maker;
}

void SetFloat(GltfMaker* maker, int accessor, int number, float value) {
  const auto& a = maker->document["accessors"][accessor];
  const auto& view = maker->document["bufferViews"][a["bufferView"].get<int>()];
  std::memcpy(maker->data.data() + view["byteOffset"].get<size_t>() + 4 * number, &value, 4);
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(GltfMalformed, SaysWhatIsWrong) {
  EXPECT_EQ(Refusal(Healthy().Glb()), "");
  // Accessors of the healthy file: 3 matrices, 4 times, 5 rotations, 6 translations.
  const std::vector<std::pair<std::function<void(GltfMaker*)>, std::string>> damages = {
      {[](GltfMaker* m) { SetFloat(m, 5, 3, kNan); }, "accessors[5]: a number is not finite"},
      {[](GltfMaker* m) { SetFloat(m, 6, 3, kInfinity); }, "accessors[6]: a number is not finite"},
      {[](GltfMaker* m) { SetFloat(m, 4, 2, kNan); }, "accessors[4]: a number is not finite"},
      {[](GltfMaker* m) { SetFloat(m, 4, 2, 0.0F); }, "key times do not ascend"},
      {[](GltfMaker* m) { SetFloat(m, 4, 0, -1.0F); }, "key times begin before zero"},
      {[](GltfMaker* m) { SetFloat(m, 4, 3, 1e30F); }, "too long for"},
      {[](GltfMaker* m) {
         SetFloat(m, 6, 3, 3e38F);
         SetFloat(m, 6, 4, -3e38F);
       },
       ""},
      {[](GltfMaker* m) {
         for (int c = 0; c < 4; ++c) SetFloat(m, 5, c, 0.0F);
       },
       "key 0 is no unit quaternion"},
      {[](GltfMaker* m) { SetFloat(m, 3, 3, 0.5F); },
       "skins[0]: inverse bind matrix 0 has another last row"},
      {[](GltfMaker* m) { SetFloat(m, 3, 0, kNan); }, "accessors[3]: a number is not finite"},
      {[](GltfMaker* m) { SetFloat(m, 3, 0, 0.0F); }, ""},  // singular: no rest pose in it
      {[](GltfMaker* m) { m->document["nodes"][6]["children"] = {0}; }, "has a loop"},
      {[](GltfMaker* m) { m->document["nodes"][6]["children"] = {8}; }, "nodes[8] has two parents"},
      {[](GltfMaker* m) { m->document["nodes"][6]["children"] = {77}; },
       "nodes[6].children: expected an index of one of 10 nodes, found 77"},
      {[](GltfMaker* m) { m->document["nodes"][6]["children"] = {-1}; }, "nodes[6].children"},
      {[](GltfMaker* m) { m->document["nodes"][6]["children"] = 5; }, "nodes[6].children"},
      {[](GltfMaker* m) {
         m->document["nodes"][4]["rotation"] = {1, 1, 1, 1};
       },
       "nodes[4]: rotation is no unit quaternion"},
      {[](GltfMaker* m) {
         m->document["nodes"][4]["rotation"] = {0, 0, 1};
       },
       "nodes[4].rotation: expected 4 numbers"},
      {[](GltfMaker* m) { m->document["nodes"][4]["translation"] = "here"; },
       "nodes[4].translation: expected 3 numbers"},
      {[](GltfMaker* m) {
         m->document["nodes"][4]["scale"] = {1, -1, 1};
       },
       "nodes[4]: a negative scale mirrors"},
      {[](GltfMaker* m) {
         m->document["nodes"][4]["scale"] = {0, 0, 0};
       },
       ""},
      {[](GltfMaker* m) {
         m->document["nodes"][1]["translation"] = {1, 2, 3};
       },
       "nodes[1]: expected either a matrix or"},
      {[](GltfMaker* m) { m->document["nodes"][1]["matrix"][5] = 1; },
       "nodes[1]: its matrix shears"},
      {[](GltfMaker* m) {
         for (int i = 0; i < 3; ++i) m->document["nodes"][1]["matrix"][i] = 0;
       },
       "nodes[1]: its matrix is singular"},
      {[](GltfMaker* m) { m->document["skins"][0]["joints"][1] = 10; }, "skins[0].joints"},
      {[](GltfMaker* m) { m->document["skins"][0]["joints"][1] = 9; }, "no common root"},
      {[](GltfMaker* m) { m->document["skins"][0]["joints"].push_back(3); },
       "4 inverse bind matrices for 5 joints"},
      {[](GltfMaker* m) { m->document["skins"][0].erase("joints"); },
       "skins[0]: expected the member \"joints\""},
      {[](GltfMaker* m) { m->document["accessors"][5]["count"] = 5; }, "5 values for 4 keys"},
      {[](GltfMaker* m) { m->document["accessors"][5]["count"] = 2147483647; },
       "values for 4 keys"},
      {[](GltfMaker* m) {
         for (const int a : {4, 5, 6}) m->document["accessors"][a]["count"] = 2147483647;
       },
       "accessors[4]: the file holds too many numbers"},
      {[](GltfMaker* m) {
         for (const int a : {4, 5, 6}) m->document["accessors"][a]["count"] = 1000000;
       },
       "accessors[4]: it reaches beyond its data"},
      {[](GltfMaker* m) {
         for (const int a : {4, 5, 6}) m->document["accessors"][a]["count"] = 0;
       },
       "accessors[4]: it is empty"},
      {[](GltfMaker* m) { m->document["accessors"][5]["type"] = "VEC3"; },
       "accessors[5]: expected items of 4 numbers"},
      {[](GltfMaker* m) { m->document["accessors"][5]["type"] = "VEC9"; }, "not readable"},
      {[](GltfMaker* m) { m->document["accessors"][5]["componentType"] = 5123; },
       "values must be floats, or normalised integers"},
      {[](GltfMaker* m) { m->document["accessors"][5]["componentType"] = 1; }, "not readable"},
      {[](GltfMaker* m) { m->document["accessors"][5]["byteOffset"] = 1 << 30; },
       "accessors[5]: it reaches beyond its data"},
      {[](GltfMaker* m) { m->document["accessors"][5].erase("bufferView"); },
       "accessors[5]: it has no data"},
      {[](GltfMaker* m) { m->document["bufferViews"][5]["byteLength"] = 1 << 30; },
       "accessors[5]: it reaches beyond its data"},
      {[](GltfMaker* m) { m->document["bufferViews"][5]["byteOffset"] = 1 << 30; },
       "accessors[5]: it reaches beyond its data"},
      {[](GltfMaker* m) { m->document["bufferViews"][5]["byteStride"] = 252; },
       "accessors[5]: it reaches beyond its data"},
      {[](GltfMaker* m) { m->document["bufferViews"][5]["buffer"] = 1; }, "bufferViews[5].buffer"},
      {[](GltfMaker* m) { m->document["animations"][0]["channels"][0]["sampler"] = 3; },
       "animations[0].channels[0].sampler: expected an index of one of 3 samplers, found 3"},
      {[](GltfMaker* m) { m->document["animations"][0]["channels"][0]["target"]["node"] = 10; },
       "animations[0].channels[0].target.node"},
      {[](GltfMaker* m) { m->document["animations"][0]["channels"][2]["target"]["node"] = 2; },
       "a second track for the same property"},
      {[](GltfMaker* m) { m->document["animations"][0]["samplers"][0]["output"] = 99; },
       "animations[0].samplers[0].output"},
      {[](GltfMaker* m) { m->document["animations"][0]["samplers"][0]["interpolation"] = "ODD"; },
       "interpolation \"ODD\", expected LINEAR, STEP or CUBICSPLINE"},
      {[](GltfMaker* m) {
         m->document["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
       },
       "4 values for 4 keys, expected 12"},
      {[](GltfMaker* m) { m->document["animations"][0].erase("samplers"); },
       "animations[0]: expected the member \"samplers\""},
      {[](GltfMaker* m) { m->document["animations"] = 7; }, "animations: expected an array"},
      {[](GltfMaker* m) { m->document["asset"]["version"] = "1.0"; },
       "asset.version: expected \"2.0\", found \"1.0\""},
      {[](GltfMaker* m) { m->document.erase("asset"); }, "asset: expected an object"},
      {[](GltfMaker* m) {
         m->document["extensionsRequired"] = {"EXT_meshopt_compression"};
         for (auto& view : m->document["bufferViews"]) {
           view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
         }
       },
       "its data are compressed (EXT_meshopt_compression)"},
      {[](GltfMaker* m) { m->document["nodes"][4]["extras"] = kNan; }, ""},
      {[](GltfMaker* m) {
         m->document["images"] = {{{"uri", "/etc/passwd"}}, 5};
       },
       ""},
  };
  int refused = 0;
  for (size_t i = 0; i < damages.size(); ++i) {
    GltfMaker maker = Healthy();
    damages[i].first(&maker);
    const std::string message = Refusal(maker.Glb());
    if (damages[i].second.empty()) {
      EXPECT_EQ(message, "") << "damage " << i;
    } else {
      EXPECT_NE(message.find(damages[i].second), std::string::npos) << i << ": " << message;
      ++refused;
    }
  }
  EXPECT_GT(refused, 45);
}

TEST(GltfMalformed, MendsRotationsALittleOffUnitLength) {
  for (const double factor : {1.0005, 1.004, 0.994, 1.009, 0.99}) {
    GltfMaker maker = Healthy();
    const auto& view = maker.document["bufferViews"][5];
    float* q = reinterpret_cast<float*>(maker.data.data() + view["byteOffset"].get<size_t>());
    for (int c = 0; c < 4; ++c) q[c] *= static_cast<float>(factor);
    // The limit of Khronos' validator is 0.00769.
    EXPECT_EQ(Refusal(maker.Glb()).empty(), std::abs(factor - 1) < 0.007) << factor;
    if (std::abs(factor - 1) > 0.007) continue;
    const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
    EXPECT_EQ(clip.notes.size(), std::abs(factor - 1) > 0.001 ? 1U : 0U) << factor;
  }
}

TEST(GltfMalformed, TakesWhatIsOnlyUntidy) {
  GltfMaker maker = Healthy();
  maker.document["accessors"][4].erase("min");  // Khronos: an error, but nothing needs them here
  maker.document["accessors"][4].erase("max");
  auto& channels = maker.document["animations"][0]["channels"];
  channels.push_back({{"sampler", 0}, {"target", {{"path", "pointer"}}}});
  channels.push_back({{"sampler", 0}, {"target", {{"node", 9}, {"path", "weights"}}}});
  maker.document["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 9, 0, 1};
  EXPECT_EQ(Refusal(maker.Glb()), "") << "a matrix on an animated node, too";
  // Sparse key times: two of four are replaced.
  maker = Healthy();
  const int indices = maker.AddArray<std::uint16_t>({2, 3}, "SCALAR");
  const int values = maker.AddArray<float>({0.5F, 0.75F}, "SCALAR");
  maker.document["accessors"][4]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  EXPECT_EQ(clip.motion.num_frames(), 46) << "60 per second meet all four";
  maker.document["accessors"][4]["sparse"]["count"] = 1000;
  EXPECT_NE(Refusal(maker.Glb()), "");
  maker.document["accessors"][4]["sparse"]["count"] = 2;
  maker.document["accessors"][4]["count"] = 3;
  EXPECT_NE(Refusal(maker.Glb()).find("a sparse index is out of range"), std::string::npos);
}

TEST(GltfMalformed, RefusesBombs) {
  const auto begin = std::chrono::steady_clock::now();
  // Deep nesting, in places that are read and in others.
  for (const char* key : {"extras", "nodes", "extensions"}) {
    std::string text = "{\"asset\":{\"version\":\"2.0\"},\"" + std::string(key) + "\":";
    text += std::string(200000, '[') + std::string(200000, ']') + "}";
    EXPECT_NE(Refusal(text).find("nested too deep"), std::string::npos);
  }
  // Many channels that share their data.
  GltfMaker maker;
  maker.AddNode("n0", -1, Vec3::Zero());
  const int count = 20000;
  const int times = maker.AddArray(Times(count, 30), "SCALAR");
  const int values = maker.AddArray(std::vector<float>(3 * count, 1.0F), "VEC3");
  const int a = maker.AddAnimation("a");
  for (int n = 1; n < 3000; ++n) {
    maker.AddNode("n" + std::to_string(n), n - 1, Vec3::Zero());
    maker.AddChannel(a, n, "translation", times, values);
  }
  EXPECT_NE(Refusal(maker.Glb()).find("too many numbers"), std::string::npos);
  // Few keys that ask for many frames of many joints.
  auto& channels = maker.document["animations"][0]["channels"];
  channels.erase(channels.begin() + 200, channels.end());
  for (const int accessor : {times, values}) maker.document["accessors"][accessor]["count"] = 3;
  SetFloat(&maker, times, 2, 3000);
  EXPECT_NE(Refusal(maker.Glb()).find("are too many"), std::string::npos);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(spent.count(), 5);
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 2'000'000) << "kB";
}

TEST(GltfMalformed, RefusesTruncatedFiles) {
  const std::string bytes = Healthy().Glb();
  int checked = 0;
  for (size_t size = 0; size < bytes.size(); size += size < 40 ? 1 : 13, ++checked) {
    ASSERT_NE(Refusal(bytes.substr(0, size)), "") << size;
  }
  for (size_t cut = 1; cut <= 24; ++cut)
    ASSERT_NE(Refusal(bytes.substr(0, bytes.size() - cut)), "");
  EXPECT_GT(checked, 200);
  // Whole chunks missing, with a length that says so.
  GltfMaker maker = Healthy();
  EXPECT_NE(Refusal(GltfMaker::Container(maker.Text(), "")), "");
  EXPECT_NE(Refusal(GltfMaker::Container("", maker.data)), "");
  maker.document["buffers"][0]["byteLength"] = maker.data.size() + 100;
  EXPECT_NE(Refusal(GltfMaker::Container(maker.document.dump(), maker.data)), "");
}

TEST(GltfMalformed, SurvivesFlippedBytes) {
  const std::string glb = Healthy().Glb(), text = glb.substr(0, glb.find("BIN"));
  std::mt19937 random(22);
  int refused = 0, taken = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const size_t range = trial % 3 == 0 ? glb.size() : text.size();
    std::string flipped = glb;
    for (int n = 0; n <= trial % 4; ++n) {
      char& c = flipped[20 * (trial % 3 != 0) + random() % (range - 20)];
      c = trial % 2 == 0 ? static_cast<char>(random()) : "0123456789[]{},:\"-"[random() % 18];
    }
    (Refusal(flipped).empty() ? taken : refused) += 1;
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(taken, 100);
}

// Other people's bad files, with what Khronos' validator says of them beside some.
TEST(GltfMalformed, RefusesWhatOthersKeepAsBadExamples) {
  SKIP_WITHOUT_SHARED_DATA();
  namespace fs = std::filesystem;
  const std::set<std::string> sound = {"ignored_parent_transform.gltf",
                                       "skeleton_non_joint_root.glb"};
  int files = 0, with_errors = 0;
  for (const auto& entry : fs::recursive_directory_iterator(SharedPath("data/malformed_gltf"))) {
    const fs::path path = entry.path();
    if (path.extension() != ".gltf" && path.extension() != ".glb") continue;
    ++files;
    const std::string message = Refusal(ReadWholeFile(path), path.parent_path());
    const std::string report = path.string() + ".report.json";
    int errors = 0;
    if (fs::exists(report)) {
      errors = nlohmann::json::parse(ReadWholeFile(report))["issues"]["numErrors"];
    }
    if (errors > 0) {
      EXPECT_NE(message, "") << path;
      ++with_errors;
    }
    EXPECT_EQ(message.empty(), sound.contains(path.filename())) << path << message;
  }
  EXPECT_EQ(files, 34);
  EXPECT_EQ(with_errors, 25);
}

}  // namespace
}  // namespace retarget::io
