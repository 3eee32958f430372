// What FormatGltf writes, read by the oracle of tests/io/gltf_oracle.h and by Khronos' validator,
// and compared with the input byte by byte.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/gltf/clip.h"
#include "io/gltf/container.h"
#include "tests/io/gltf/gltf_maker.h"
#include "tests/io/gltf/gltf_oracle.h"

namespace retarget::io {
namespace {

std::string CharacterPath(const std::string& file) { return SharedPath("data/characters/") + file; }

constexpr const char* kCharacters[] = {"Fox.glb", "cesium_man.gltf", "rigged_simple.gltf",
                                       "m2m_human-male.glb", "m2m_mixamo-sample-rig.glb"};

// The awkward character with an animation of many kinds, which writing must leave alone.
GltfMaker AnimatedCharacter() {
  GltfMaker maker = AwkwardCharacter();
  std::mt19937 random(11);
  const int a = maker.AddAnimation("captured");
  const int times = maker.AddArray(Times(6, 25, 0.2), "SCALAR");
  maker.AddChannel(a, 0, "translation", times,
                   maker.AddArray(SomeTranslations(&random, 6, Vec3(1, 0, 0)), "VEC3"));
  for (const int node : {4, 5, 8}) {
    maker.AddChannel(a, node, "rotation", times, maker.AddArray(SomeRotations(&random, 6), "VEC4"));
  }
  maker.AddChannel(a, 4, "scale", times, maker.AddArray(std::vector<float>(18, 0.75F), "VEC3"));
  return maker;
}

// Other rotations everywhere, another way of the roots, and one joint pulled out.
RigMotion Changed(const RigMotion& motion, int frames, int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.2);
  RigMotion out = motion;
  out.frames.clear();
  for (int k = 0; k < frames; ++k) {
    RigFrame frame = motion.frames.front();
    for (Quat& q : frame.rotation) {
      q = q * SomeRotation(&random);
      if (k % 2 == 1) q.coeffs() *= -1;
    }
    for (size_t j = 0; j < frame.translation.size(); ++j) {
      const bool moves = motion.rig.joints[j].parent < 0 || j == 3;
      if (moves) frame.translation[j] += Vec3(normal(random), normal(random), normal(random));
    }
    out.frames.push_back(frame);
  }
  return out;
}

// Of a VRM animation the new motion comes first, once and again; the old ones follow as they were.
TEST(GltfWrite, AVrmaBeginsWithTheNewMotion) {
  GltfMaker maker = AnimatedCharacter();
  maker.document["extensions"]["VRMC_vrm_animation"] = {{"specVersion", "1.0"}};
  const auto names = [](const std::string& bytes) {
    const auto document = nlohmann::json::parse(SplitGltf(bytes, "a").json);
    std::vector<std::string> out;
    for (const auto& animation : document.at("animations")) out.push_back(animation.at("name"));
    return out;
  };
  const GltfClip clip = ParseGltf(maker.Glb(), "a.vrma", "");
  const std::string once = FormatGltf(clip, clip.motion, 0, "new");
  EXPECT_EQ(names(once), (std::vector<std::string>{"new", "captured"}));
  GltfSelect select;
  select.animation = "captured";
  const GltfClip again = ParseGltf(once, "a.vrma", "", select);
  EXPECT_EQ(names(FormatGltf(again, again.motion, 0, "new")),
            (std::vector<std::string>{"new", "captured"}));
  EXPECT_EQ(names(FormatGltf(again, again.motion, 0, "captured")),
            (std::vector<std::string>{"captured", "new"}));
  EXPECT_EQ(nlohmann::json::parse(SplitGltf(once, "a").json).at("animations")[1],
            nlohmann::json::parse(SplitGltf(maker.Glb(), "a").json).at("animations")[0]);
}

double AngleBetween(const Matrix4& a, const Matrix4& b) {
  const Mat3 p = a.topLeftCorner<3, 3>().colwise().normalized();
  const Mat3 q = b.topLeftCorner<3, 3>().colwise().normalized();
  return Quat(p).angularDistance(Quat(q)) / kDegree;
}

// ---- The identity: what was read plays as before.

TEST(GltfWrite, WhatWasReadPlaysAsTheInput) {
  SKIP_WITHOUT_SHARED_DATA();
  int compared = 0;
  for (const std::string file : kCharacters) {
    const std::string bytes = ReadWholeFile(CharacterPath(file));
    const GltfOracle before(bytes);
    const int animations =
        before.document.contains("animations") ? int(before.document["animations"].size()) : 0;
    for (int a = std::min(animations - 1, 0); a < animations; ++a) {
      const GltfClip clip = ReadGltf(CharacterPath(file), {a < 0 ? "" : std::to_string(a), ""});
      const GltfOracle after(FormatGltf(clip, clip.motion, 0, "again"));
      const int again = after.AnimationNamed("again");
      ASSERT_EQ(again, animations);
      const auto [begin, end] = after.Span(again);
      double worst_position = 0, worst_angle = 0;
      for (int k = 0; k < clip.motion.num_frames(); ++k) {
        const double offset = k * clip.motion.frame_time;
        const double first = a < 0 ? 0 : before.Span(a).first;
        const double time = clip.key_times.empty() ? first + offset : clip.key_times[k];
        const auto x = before.Globals(a, time);
        const auto y = after.Globals(again, begin + time - first);
        for (size_t n = 0; n < x.size(); ++n, ++compared) {
          worst_position = std::max(worst_position, (x[n] - y[n]).topRightCorner<3, 1>().norm());
          worst_angle = std::max(worst_angle, AngleBetween(x[n], y[n]));
        }
      }
      EXPECT_LT(worst_position, file == "Fox.glb" ? 1e-4 : 1e-6) << file << " " << a;
      EXPECT_LT(worst_angle, 1e-3) << file << " " << a;
      if (!clip.key_times.empty()) {
        EXPECT_EQ(std::pair(begin, end), before.Span(a)) << "the keys keep their times";
      }
    }
  }
  EXPECT_GT(compared, 5000);
}

// ---- A changed motion is what is written.

void CheckWritten(const GltfClip& clip, const RigMotion& motion, const std::string& bytes) {
  const GltfOracle oracle(bytes);
  const int animation = oracle.AnimationNamed("retargeted");
  ASSERT_GE(animation, 0);
  const double begin = oracle.Span(animation).first;
  double worst_position = 0, worst_angle = 0;
  for (int k = 0; k < motion.num_frames(); ++k) {
    const auto globals = oracle.Globals(animation, begin + k * motion.frame_time);
    const PosedRig posed = PoseRig(motion.rig, motion.frames[k]);
    for (size_t j = 0; j < clip.joints.size(); ++j) {
      const Matrix4& g = globals[static_cast<size_t>(clip.joints[j].node)];
      Matrix4 expected = Matrix4::Identity();
      expected.topLeftCorner<3, 3>() = posed.rotation[j].toRotationMatrix();
      worst_position =
          std::max(worst_position, (posed.position[j] - Vec3(g.topRightCorner<3, 1>())).norm());
      worst_angle = std::max(worst_angle, AngleBetween(g, expected));
    }
  }
  EXPECT_LT(worst_position, 1e-5);
  EXPECT_LT(worst_angle, 1e-3);
}

TEST(GltfWrite, UndoesTheFoldingOfAncestorsAndScales) {
  GltfMaker maker = AnimatedCharacter();
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  const RigMotion motion = Changed(clip.motion, 9, 12);
  CheckWritten(clip, motion, FormatGltf(clip, motion));
  maker = AwkwardCharacter();
  const GltfClip still = ParseGltf(maker.Glb(), "a.glb", "");
  CheckWritten(still, Changed(still.motion, 4, 13),
               FormatGltf(still, Changed(still.motion, 4, 13)));
}

TEST(GltfWrite, WritesRealCharacters) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const std::string file : kCharacters) {
    const GltfClip clip = ReadGltf(CharacterPath(file), {file == "Fox.glb" ? "Run" : "", ""});
    RigMotion motion = Changed(clip.motion, 5, 14);
    motion.frame_time = 1.0 / 24;
    const std::string bytes = FormatGltf(clip, motion);
    if (file != "Fox.glb") CheckWritten(clip, motion, bytes);
    const GltfClip again = ParseGltf(bytes, file, "", {"retargeted", ""});
    EXPECT_EQ(again.motion.num_frames(), 5);
    EXPECT_EQ(again.motion.frame_time, 1.0 / 24);
    for (size_t j = 0; j < clip.joints.size(); ++j) {
      EXPECT_EQ(again.motion.rig.joints[j].name, clip.motion.rig.joints[j].name);
      EXPECT_EQ(again.motion.rig.joints[j].parent, clip.motion.rig.joints[j].parent);
    }
  }
}

// ---- Form.

TEST(GltfWrite, HasLinearChannelsOfContinuousUnitQuaternions) {
  GltfMaker maker = AnimatedCharacter();
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  const GltfOracle oracle(FormatGltf(clip, Changed(clip.motion, 9, 15)));
  const json animation = oracle.document["animations"][1];
  std::map<std::string, std::vector<int>> nodes;
  int quaternions = 0;
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"][channel["sampler"].get<size_t>()];
    EXPECT_EQ(sampler["interpolation"], "LINEAR");
    nodes[channel["target"]["path"]].push_back(channel["target"]["node"]);
    const json& input = oracle.document["accessors"][sampler["input"].get<size_t>()];
    const auto times = oracle.Items(sampler["input"]);
    EXPECT_EQ(input["min"], json(times.front()));
    EXPECT_EQ(input["max"], json(times.back()));
    if (channel["target"]["path"] != "rotation") continue;
    const auto values = oracle.Items(sampler["output"]);
    for (size_t k = 0; k < values.size(); ++k, ++quaternions) {
      const auto unit = Eigen::Map<const Eigen::Vector4d>(values[k].data());
      EXPECT_NEAR(unit.norm(), 1, 2e-7);
      if (k > 0) {
        EXPECT_GE(unit.dot(Eigen::Map<const Eigen::Vector4d>(values[k - 1].data())), 0);
      }
    }
  }
  for (auto& [path, list] : nodes) std::sort(list.begin(), list.end());
  EXPECT_EQ(quaternions, 9 * 8);
  EXPECT_EQ(nodes["rotation"], (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 8}));
  EXPECT_EQ(nodes["translation"], (std::vector<int>{0, 3})) << "the root, and the one pulled out";
  EXPECT_EQ(nodes["scale"], (std::vector<int>{4})) << "the captured animation had it";
}

TEST(GltfWrite, KeepsKeyTimesOrCountsFromZeroOrSamples) {
  GltfMaker maker = AnimatedCharacter();
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  const auto times = [&](const RigMotion& motion, double fps) {
    const GltfOracle oracle(FormatGltf(clip, motion, fps));
    std::vector<double> out;
    const json& samplers = oracle.document["animations"][1]["samplers"];
    for (const auto& item : oracle.Items(samplers[0]["input"])) out.push_back(item[0]);
    return out;
  };
  EXPECT_EQ(times(clip.motion, 0), clip.key_times);
  EXPECT_EQ(times(clip.motion, 25), clip.key_times);
  RigMotion shorter = clip.motion;
  shorter.frames.resize(3);
  EXPECT_EQ(times(shorter, 0), (std::vector<double>{0, 0.04F, 0.08F}));
  const std::vector<double> finer = times(clip.motion, 100);
  EXPECT_EQ(finer.size(), 21U);
  EXPECT_EQ(finer.back(), 0.2F);
  RigMotion hasty = clip.motion;
  hasty.frame_time = 1e-60;
  EXPECT_THROW(FormatGltf(clip, hasty), InputError);
}

// ---- All else keeps its bytes.

// Spelt as no library would: numbers, blanks, key order, escapes, unknown members.
constexpr const char* kOddText = R"({
  "extras" : { "z": 1.500, "a": [1E-3, -0.0,  12345678901234567890], "t": "\u00e4\/ ]}\"" },
  "scene":0, "unknown": null,
  "nodes": [ { "name": "root \u0041", "matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0.10,0,0,1.0],
               "extras": {"matrix": "[]"} , "children" : [1] },
             { "name": "tip", "translation": [0, 1.0000000000000000001, 0], "mesh": 0, "skin": 0 } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] } ],
  "materials": [ {"name": "accessors", "alphaCutoff": 5e-1 } ],
  "skins": [ { "joints": [ 0, 1 ] } ],
  "accessors": [ {"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3",
    "min": [1.0,2.00,3], "max": [1,2,3e0] }  ],
  "bufferViews": [ { "byteLength": 12, "buffer": 0 } ],
  "scenes": [ { "nodes": [ 0 ] } ],
  "buffers": [ { "extras": { "byteLength": 9 }, "byteLength" : 12 %s} ],
  "asset": { "generator": "by hand", "version": "2.0" }
}
)";

std::string OddText(const std::string& uri) {
  std::string text = kOddText;
  return text.replace(text.find("%s"), 2, uri);
}

const std::string kPoint =
    GltfMaker::Container("", std::string("\0\0\x80?\0\0\0@\0\0@@", 12)).substr(28);

// `text` with `with` in place of the only `what`.
std::string Replaced(std::string text, const std::string& what, const std::string& with) {
  EXPECT_EQ(text.find(what), text.rfind(what)) << what;
  return text.replace(text.find(what), what.size(), with);
}

TEST(GltfWrite, ChangesNoOtherByteOfADocument) {
  ASSERT_EQ(kPoint.size(), 12U);
  const std::string uri = ", \"uri\": \"data:application/octet-stream;base64,AACAPwAAAEAAAEBA\" ";
  for (const bool binary : {true, false}) {
    const std::string before = OddText(binary ? "" : uri);
    const std::string bytes = binary ? GltfMaker::Container(before, kPoint) : before;
    const GltfClip clip = ParseGltf(bytes, "odd", "");
    const std::string written = FormatGltf(clip, Changed(clip.motion, 3, 16));
    const GltfOracle after(written);
    // What was added, as its own JSON says it; then the text without it must be the text before.
    const auto added = [&](const char* array, size_t first) {
      std::string out;
      for (size_t i = first; i < after.document[array].size(); ++i) {
        out += "," + nlohmann::ordered_json::parse(after.json_text)[array][i].dump();
      }
      return out;
    };
    std::string expected = before;
    expected = Replaced(expected, "3e0] }", "3e0] }" + added("accessors", 1));
    expected = Replaced(expected, "\"buffer\": 0 }", "\"buffer\": 0 }" + added("bufferViews", 1));
    expected = Replaced(expected, "\"matrix\":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0.10,0,0,1.0]",
                        "\"translation\":[0.1,0,0],\"rotation\":[0,0,0,1],\"scale\":[1,1,1]");
    expected = Replaced(
        expected, "\"version\": \"2.0\" }",
        "\"version\": \"2.0\" },\"animations\":[" + added("animations", 0).substr(1) + "]");
    if (binary) {
      expected = Replaced(expected, "\"byteLength\" : 12 }",
                          "\"byteLength\" : " + std::to_string(after.buffers[0].size()) + " }");
    } else {
      expected = Replaced(expected, uri + "}", uri + "}" + added("buffers", 1));
    }
    const auto trimmed = [](const std::string& text) {
      return text.substr(0, text.find_last_not_of(' ') + 1);
    };
    EXPECT_EQ(trimmed(after.json_text), trimmed(expected));
    if (binary) {
      EXPECT_EQ(after.buffers[0].substr(0, 12), kPoint);
    }
  }
}

TEST(GltfWrite, KeepsTheBytesOfRealCharacters) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const std::string file : kCharacters) {
    const GltfClip clip = ReadGltf(CharacterPath(file), {file == "Fox.glb" ? "Run" : "", ""});
    const GltfOracle before(clip.bytes);
    const GltfOracle after(FormatGltf(clip, clip.motion));
    for (size_t b = 0; b < before.buffers.size(); ++b) {
      EXPECT_EQ(after.buffers[b].substr(0, before.buffers[b].size()), before.buffers[b]);
    }
    // Apart from the arrays that grow, buffers and nodes, every member is spelt as it was.
    auto x = nlohmann::ordered_json::parse(before.json_text);
    auto y = nlohmann::ordered_json::parse(after.json_text);
    for (const char* key : {"accessors", "bufferViews", "animations"}) {
      if (!x.contains(key)) x[key] = nlohmann::ordered_json::array();
      while (y[key].size() > x[key].size()) y[key].erase(y[key].size() - 1);
    }
    while (y["buffers"].size() > x["buffers"].size()) y["buffers"].erase(y["buffers"].size() - 1);
    y["buffers"][0]["byteLength"] = x["buffers"][0]["byteLength"];
    for (size_t n = 0; n < x["nodes"].size(); ++n) {
      if (!x["nodes"][n].contains("matrix") || y["nodes"][n].contains("matrix")) continue;
      for (const char* key : {"translation", "rotation", "scale"}) y["nodes"][n].erase(key);
      x["nodes"][n].erase("matrix");
    }
    EXPECT_EQ(x.dump(), y.dump()) << file;
  }
}

TEST(GltfWrite, ReplacesAnAnimationOfTheSameNameAndAddsOthers) {
  GltfMaker maker = AnimatedCharacter();
  const GltfClip clip = ParseGltf(maker.Glb(), "a.glb", "");
  const RigMotion first = Changed(clip.motion, 4, 17), second = Changed(clip.motion, 5, 18);
  const GltfClip once = ParseGltf(FormatGltf(clip, first), "a.glb", "", {"retargeted", ""});
  const std::string twice = FormatGltf(once, second);
  CheckWritten(once, second, twice);
  const GltfOracle oracle(twice);
  EXPECT_EQ(oracle.document["animations"].size(), 2U);
  EXPECT_EQ(oracle.document["animations"][0], GltfOracle(maker.Glb()).document["animations"][0]);
  const GltfOracle other(FormatGltf(once, second, 0, "\"third\"\n\xFF"));
  EXPECT_EQ(other.document["animations"].size(), 3U);
}

TEST(GltfWrite, AddsABufferWhereAFileHasNone) {
  GltfMaker maker;
  maker.AddNode("root", -1, Vec3(0, 1, 0));
  maker.document["skins"].push_back({{"joints", {0}}});
  for (const std::string& bytes : {maker.Glb(), maker.Text()}) {
    const GltfClip clip = ParseGltf(bytes, "a", "");
    const RigMotion motion = Changed(clip.motion, 3, 19);
    CheckWritten(clip, motion, FormatGltf(clip, motion));
  }
}

// ---- Khronos' validator.

// What it finds in each file: an object of `errors`, `warnings`, `messages`. Null where it is not
// installed.
json Validate(const std::vector<std::string>& files) {
  if (std::system("node --version > /dev/null 2>&1") != 0) return {};
  const std::string verdict = testing::TempDir() + "gltf_write_test.json";
  std::string command = "node '" + ProjectPath("tests/tools/validate_glb.mjs") + "'";
  for (const std::string& file : files) command += " '" + file + "'";
  const int status = WEXITSTATUS(std::system((command + " > '" + verdict + "' 2>&1").c_str()));
  const std::string text = ReadWholeFile(verdict);
  std::filesystem::remove(verdict);
  return status == 3 ? json() : json::parse(text);
}

TEST(GltfWrite, AddsNothingToTheValidatorsReport) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "gltf_write_test";
  std::filesystem::create_directories(folder);
  std::vector<std::string> files;
  const auto add = [&](const std::string& name, const std::string& bytes) {
    files.push_back(folder / name);
    std::ofstream(files.back(), std::ios::binary) << bytes;
  };
  const auto add_pair = [&](const std::string& name, const GltfClip& clip) {
    add("in_" + name, clip.bytes);
    add("out_" + name, FormatGltf(clip, Changed(clip.motion, clip.motion.num_frames(), 20)));
  };
  GltfMaker maker = AnimatedCharacter();
  maker.document["nodes"][9].erase("translation");
  add_pair("awkward.glb", ParseGltf(maker.Glb(), "a.glb", ""));
  if (std::filesystem::exists(CharacterPath(""))) {
    for (const std::string file : kCharacters) {
      add_pair(file, ReadGltf(CharacterPath(file), {file == "Fox.glb" ? "Walk" : "", ""}));
    }
  }
  const json found = Validate(files);
  std::filesystem::remove_all(folder);
  if (found.is_null()) GTEST_SKIP() << "gltf-validator is not installed";
  for (size_t i = 0; i < files.size(); i += 2) {
    const json &before = found[files[i]], &after = found[files[i + 1]];
    for (const char* kind : {"errors", "warnings"}) {
      EXPECT_LE(after[kind].get<int>(), before[kind].get<int>())
          << files[i] << after["messages"].dump().substr(0, 1000);
    }
  }
  EXPECT_EQ(found[files[1]]["errors"], 0) << "the made character is valid";
}

}  // namespace
}  // namespace retarget::io
