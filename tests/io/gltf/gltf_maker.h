// Small glTF files of our own making, for the tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

// A document and its data, open to be damaged.
struct GltfMaker {
  nlohmann::ordered_json document = {{"asset", {{"version", "2.0"}}}};
  std::string data;

  int Size(const char* array) const {
    return document.contains(array) ? static_cast<int>(document[array].size()) : 0;
  }

  // Returns the accessor. T is float or an integer type, which is taken as normalised.
  template <typename T>
  int AddArray(const std::vector<T>& numbers, const std::string& type, bool normalised = false) {
    const int components = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    const int component_type = std::is_same_v<T, float>          ? 5126
                               : std::is_same_v<T, std::int8_t>  ? 5120
                               : std::is_same_v<T, std::uint8_t> ? 5121
                               : std::is_same_v<T, std::int16_t> ? 5122
                                                                 : 5123;
    while (data.size() % 4 != 0) data.push_back('\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", numbers.size() * sizeof(T)}});
    data.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    nlohmann::ordered_json accessor = {{"bufferView", Size("bufferViews") - 1},
                                       {"componentType", component_type},
                                       {"count", numbers.size() / components},
                                       {"type", type}};
    if (normalised) accessor["normalized"] = true;
    if (type != "MAT4" && !normalised && components < 4 && !numbers.empty()) {
      for (int c = 0; c < components; ++c) {
        T least = numbers[c], most = numbers[c];
        for (size_t i = c; i < numbers.size(); i += components) {
          least = std::min(least, numbers[i]);
          most = std::max(most, numbers[i]);
        }
        accessor["min"].push_back(static_cast<double>(least));
        accessor["max"].push_back(static_cast<double>(most));
      }
    }
    document["accessors"].push_back(accessor);
    return Size("accessors") - 1;
  }

  int AddNode(const std::string& name, int parent, const Vec3& translation,
              const Quat& q = Quat::Identity(), double scale = 1) {
    nlohmann::ordered_json node = nlohmann::ordered_json::object();
    if (!name.empty()) node["name"] = name;
    node["translation"] = {translation.x(), translation.y(), translation.z()};
    if (q.w() != 1) node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    if (scale != 1) node["scale"] = {scale, scale, scale};
    document["nodes"].push_back(node);
    const int n = Size("nodes") - 1;
    if (parent >= 0) {
      document["nodes"][parent]["children"].push_back(n);
    } else {
      document["scenes"][0]["nodes"].push_back(n);
    }
    return n;
  }

  int AddAnimation(const std::string& name) {
    document["animations"].push_back({{"name", name},
                                      {"channels", nlohmann::ordered_json::array()},
                                      {"samplers", nlohmann::ordered_json::array()}});
    return Size("animations") - 1;
  }

  void AddChannel(int animation, int node, const std::string& path, int input, int output,
                  const std::string& interpolation = "LINEAR") {
    auto& a = document["animations"][animation];
    a["channels"].push_back(
        {{"sampler", a["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    a["samplers"].push_back(
        {{"input", input}, {"output", output}, {"interpolation", interpolation}});
  }

  std::string Text(int indent = -1) {
    if (!data.empty()) document["buffers"][0]["byteLength"] = data.size();
    return document.dump(indent);
  }

  static void AppendWord(size_t word, std::string* out) {
    for (int i = 0; i < 4; ++i) out->push_back(static_cast<char>(word >> 8 * i));
  }

  static std::string Container(std::string text, std::string chunk) {
    while (text.size() % 4 != 0) text.push_back(' ');
    while (chunk.size() % 4 != 0) chunk.push_back('\0');
    std::string out = "glTF";
    AppendWord(2, &out);
    AppendWord(20 + text.size() + (chunk.empty() ? 0 : 8 + chunk.size()), &out);
    AppendWord(text.size(), &out);
    out += "JSON" + text;
    if (chunk.empty()) return out;
    AppendWord(chunk.size(), &out);
    return out + std::string("BIN\0", 4) + chunk;
  }

  std::string Glb() { return Container(Text(), data); }
};

inline std::vector<float> Floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

inline Quat SomeRotation(std::mt19937* random, double size = 1) {
  std::normal_distribution<double> normal;
  return Quat(1, size * normal(*random), size * normal(*random), size * normal(*random))
      .normalized();
}

// Even key times, then values of a random walk: translations about `start`, or rotations.
inline std::vector<float> Times(int count, double rate, double begin = 0) {
  std::vector<float> out;
  for (int k = 0; k < count; ++k) out.push_back(static_cast<float>(begin + k / rate));
  return out;
}

inline std::vector<float> SomeTranslations(std::mt19937* random, int count, const Vec3& start) {
  std::normal_distribution<double> normal(0, 0.1);
  std::vector<float> out;
  for (int k = 0; k < count; ++k) {
    for (int c = 0; c < 3; ++c) out.push_back(static_cast<float>(start[c] + normal(*random)));
  }
  return out;
}

inline std::vector<float> SomeRotations(std::mt19937* random, int count) {
  std::vector<float> out;
  for (int k = 0; k < count; ++k) {
    const Quat q = SomeRotation(random, 0.5);
    for (const double c : {q.x(), q.y(), q.z(), q.w()}) out.push_back(static_cast<float>(c));
  }
  return out;
}

// A character that has all that makes files awkward. Nodes:
//   0 armature (90 degrees about X, scale 0.01, shifted) > 1 matrix node > 2 hips (joint, matrix)
//   > 3 a node that is no joint > 4 chest (joint) > 5 nameless joint > 6 leaf without mesh,
//   7 a prop with a mesh below the hips, 8 a second "chest" below the hips (joint), 9 the mesh.
// Units below the armature are centimetres. Its skin has no animation yet.
inline GltfMaker AwkwardCharacter() {
  GltfMaker maker;
  maker.document["scene"] = 0;
  maker.AddNode("armature", -1, Vec3(0.3, 0.1, -0.2),
                Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX())), 0.01);
  maker.AddNode("turned", 0, Vec3::Zero());
  maker.document["nodes"][1].erase("translation");
  maker.document["nodes"][1]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1};
  maker.AddNode("hips", 1, Vec3::Zero());
  maker.document["nodes"][2].erase("translation");
  maker.document["nodes"][2]["matrix"] = {2, 0, 0, 0, 0, 0, 2, 0, 0, -2, 0, 0, 1, 90, 2, 1};
  std::mt19937 random(5);
  maker.AddNode("between", 2, Vec3(0, 10, 0), SomeRotation(&random));
  maker.AddNode("chest", 3, Vec3(1, 20, -3), SomeRotation(&random), 0.5);
  maker.AddNode("", 4, Vec3(-2, 30, 1), SomeRotation(&random));
  maker.AddNode("leaf", 5, Vec3(0, 8, 0));
  maker.AddNode("prop", 2, Vec3(10, 0, 0));
  maker.AddNode("chest", 2, Vec3(-10, 0, 0), SomeRotation(&random));
  maker.AddNode("mesh", -1, Vec3::Zero());
  const int position = maker.AddArray<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int joints = maker.AddArray<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0}, "VEC4");
  const int weights = maker.AddArray<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  auto& document = maker.document;
  document["meshes"].push_back(
      {{"primitives",
        {{{"attributes",
           {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}}}}});
  document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", position}}}}}}});
  document["nodes"][7]["mesh"] = 1;
  document["nodes"][9]["mesh"] = 0;
  document["nodes"][9]["skin"] = 0;
  document["skins"].push_back({{"name", "person"}, {"joints", {2, 4, 5, 8}}});
  return maker;
}

}  // namespace retarget::io
