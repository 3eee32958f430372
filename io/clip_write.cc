// The writing half of io/clip_file.h.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/clip_file.h"
#include "io/gltf/container.h"
#include "io/text/read_file.h"

namespace retarget::io {
namespace {

namespace fs = std::filesystem;

// A character or an animation of VRM keeps the ending by which its programs know it.
std::string ExtensionOf(const GltfClip& clip, const std::string& usual) {
  std::string own = fs::path(clip.name).extension().string();
  std::ranges::transform(own, own.begin(), [](unsigned char c) { return std::tolower(c); });
  return own == ".vrm" || own == ".vrma" ? own : usual;
}

// Files beside a .gltf that it names by a relative path: buffers and images.
std::vector<std::string> ExternalFiles(const GltfClip& clip) {
  std::vector<std::string> files;
  const nlohmann::json document =
      nlohmann::json::parse(SplitGltf(clip.bytes, clip.name).json, nullptr, false);
  for (const char* kind : {"buffers", "images"}) {
    if (!document.is_object() || !document.contains(kind)) continue;
    for (const auto& item : document.at(kind)) {
      if (!item.is_object() || !item.contains("uri") || !item.at("uri").is_string()) continue;
      const std::string uri = item.at("uri");
      if (uri.rfind("data:", 0) == 0 || uri.find("://") != std::string::npos) continue;
      const fs::path path = fs::path(uri).lexically_normal();
      if (path.is_absolute() || path.begin()->string() == "..") continue;
      std::error_code error;
      if (fs::is_regular_file(clip.folder + "/" + path.string(), error))
        files.push_back(path.string());
    }
  }
  return files;
}

}  // namespace

ScaledGltf ScaleGltf(const GltfClip& original, const RigMotion& motion, double ratio) {
  ScaledGltf scaled{original, motion};
  if (ratio == 1) return scaled;
  for (size_t j = 0; j < motion.rig.joints.size(); ++j) {
    if (motion.rig.joints[j].parent < 0) {
      scaled.clip.joints[j].scale *= ratio;
      scaled.clip.joints[j].size *= ratio;
      continue;
    }
    for (RigFrame& frame : scaled.motion.frames) frame.translation[j] /= ratio;
  }
  return scaled;
}

std::vector<std::string> NamesOfClipFile(const ClipFile& original, const std::string& stem) {
  if (const auto* gltf = std::get_if<GltfClip>(&original.original)) {
    if (gltf->bytes.rfind("glTF", 0) == 0) return {stem + ExtensionOf(*gltf, ".glb")};
    std::vector<std::string> names = {stem + ExtensionOf(*gltf, ".gltf")};
    for (const std::string& file : ExternalFiles(*gltf)) names.push_back(file);
    return names;
  }
  if (original.format == "Acclaim") return {stem + ".amc", stem + ".asf"};
  return {stem + ".bvh"};
}

std::vector<NamedBytes> FormatClipFile(const ClipFile& original, const RigMotion& motion,
                                       const std::string& stem, double stature_ratio) {
  if (const auto* bvh = std::get_if<BvhFile>(&original.original)) {
    return {{stem + ".bvh", FormatBvh(*bvh, motion, stature_ratio)}};
  }
  if (const auto* acclaim = std::get_if<AcclaimFile>(&original.original)) {
    return {{stem + ".amc", FormatAmc(*acclaim, motion, stature_ratio)},
            {stem + ".asf", FormatAsf(*acclaim, stature_ratio)}};
  }
  const auto& gltf = std::get<GltfClip>(original.original);
  std::vector<NamedBytes> files;
  for (const std::string& name : NamesOfClipFile(original, stem)) {
    if (!files.empty()) {
      files.push_back({name, ReadFile(gltf.folder + "/" + name)});
      continue;
    }
    const ScaledGltf scaled = ScaleGltf(gltf, motion, stature_ratio);
    files.push_back({name, FormatGltf(scaled.clip, scaled.motion, 0, kAnimationName)});
  }
  return files;
}

PlayedFile PlayedFileOf(const ClipFile& original, const std::vector<NamedBytes>& files) {
  PlayedFile played;
  played.format = original.format;
  played.name = files[0].name;
  played.bytes = files[0].bytes;
  if (const auto* bvh = std::get_if<BvhFile>(&original.original)) {
    for (size_t j = 0; j < bvh->adds_offset.size(); ++j) {
      if (bvh->adds_offset[j]) played.displaced.push_back(static_cast<int>(j));
    }
  }
  if (original.format == "Acclaim") {
    played.skeleton = files[1].bytes;
    played.fps = 1 / original.motion.frame_time;
  }
  if (const auto* gltf = std::get_if<GltfClip>(&original.original)) {
    played.folder = gltf->folder;
    played.animation = kAnimationName;
  }
  return played;
}

PlayedJoint JointInFile(const ClipFile& original, int joint) {
  PlayedJoint played{original.motion.rig.joints[joint].name};
  if (const auto* gltf = std::get_if<GltfClip>(&original.original)) {
    played.node = gltf->joints[joint].node;
  }
  return played;
}

}  // namespace retarget::io
