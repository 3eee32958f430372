// Writes small sound files of every kind into a folder, for gltf_fuzz to begin with.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/io/gltf/gltf_maker.h"

namespace retarget {
namespace {

std::string Base64Zeros(size_t bytes) { return std::string((bytes + 2) / 3 * 4, 'A'); }

GltfMaker Animated(const std::string& kind, bool in_bytes) {
  GltfMaker maker = AwkwardCharacter();
  std::mt19937 random(1);
  const int a = maker.AddAnimation(kind);
  const int count = kind == "CUBICSPLINE" ? 9 : 3;
  const int times = maker.AddArray(Times(3, 30), "SCALAR");
  const std::vector<float> rotations = SomeRotations(&random, count);
  std::vector<std::int8_t> bytes;
  for (const float v : rotations) bytes.push_back(static_cast<std::int8_t>(127 * v));
  const int rotation =
      in_bytes ? maker.AddArray(bytes, "VEC4", true) : maker.AddArray(rotations, "VEC4");
  const int translation = maker.AddArray(SomeTranslations(&random, count, Vec3(0, 1, 0)), "VEC3");
  maker.AddChannel(a, 0, "translation", times, translation, kind);
  maker.AddChannel(a, 4, "rotation", times, rotation, kind);
  maker.AddChannel(a, 5, "scale", times, translation, kind);
  return maker;
}

void WriteSeeds(const std::filesystem::path& folder) {
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  write("still.glb", AwkwardCharacter().Glb());
  for (const char* kind : {"LINEAR", "STEP", "CUBICSPLINE"}) {
    write(std::string(kind) + ".glb", Animated(kind, false).Glb());
    write(std::string(kind) + "_bytes.glb", Animated(kind, true).Glb());
  }
  GltfMaker maker = Animated("LINEAR", false);
  maker.Text();
  maker.document["buffers"][0]["uri"] =
      "data:application/octet-stream;base64," + Base64Zeros(maker.data.size());
  write("text.gltf", maker.Text());
  maker.document["buffers"][0]["uri"] = "outside.bin";
  write("external.gltf", maker.Text());

  maker = Animated("LINEAR", false);
  const int indices = maker.AddArray<std::uint16_t>({1}, "SCALAR");
  const int values = maker.AddArray<float>({0.04F}, "SCALAR");
  maker.document["accessors"][3]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  maker.document["skins"].push_back({{"joints", {7}}});
  maker.document["skins"].push_back({{"joints", {9}}});
  write("sparse_two_skins.glb", maker.Glb());

  maker = Animated("LINEAR", false);
  auto& extensions = maker.document["extensions"];
  for (const char* key : {"VRMC_vrm", "VRMC_vrm_animation"}) {
    extensions = {
        {key,
         {{"humanoid", {{"humanBones", {{"hips", {{"node", 2}}}, {"spine", {{"node", 4}}}}}}}}}};
    write(std::string(key) + ".glb", maker.Glb());
  }
  extensions = {
      {"VRM",
       {{"humanoid",
         {{"humanBones", {{{"bone", "hips"}, {"node", 2}}, {{"bone", "head"}, {"node", 5}}}}}}}}};
  write("VRM.glb", maker.Glb());
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: gltf_seeds FOLDER\n";
    return 2;
  }
  retarget::WriteSeeds(argv[1]);
  return 0;
}
