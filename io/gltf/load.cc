#include "io/gltf/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/gltf/check.h"
#include "io/gltf/container.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "model/geometry/types.h"

namespace retarget::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json ParseJson(std::string_view text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw InputError(fmt::format("{}: not glTF: {}", name, OneLine(error.what())));
  }
}

bool Lists(const json& document, const char* key, const std::string& extension) {
  const auto list = document.find(key);
  return list != document.end() && list->is_array() &&
         std::find(list->begin(), list->end(), json(extension)) != list->end();
}

constexpr const char* kMeshCompression = "KHR_draco_mesh_compression";
constexpr const char* kDataCompressions[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

std::string CompressionOf(const json& document) {
  for (const char* extension : kDataCompressions) {
    if (Lists(document, "extensionsRequired", extension)) return extension;
  }
  return Lists(document, "extensionsUsed", kMeshCompression) ? kMeshCompression : "";
}

bool HasExtension(const json& object, const std::string& extension) {
  if (!object.is_object()) return false;
  const auto extensions = object.find("extensions");
  return extensions != object.end() && extensions->is_object() && extensions->contains(extension);
}

// Which views of a document only that extension can read. Their own buffer holds nothing then, and
// need not exist: a byte takes its place in `checked`.
std::vector<bool> CompressedViews(const json& document, const std::string& compression,
                                  json* checked) {
  std::vector<bool> compressed;
  if (compression.empty() || compression == kMeshCompression) return compressed;
  for (const json& view : document.value("bufferViews", json::array())) {
    compressed.push_back(HasExtension(view, compression));
    if (!compressed.back()) continue;
    json& buffer =
        (*checked)["buffers"]
                  [(*checked)["bufferViews"][compressed.size() - 1]["buffer"].get<size_t>()];
    const bool fallback = HasExtension(
        document["buffers"]
                [(*checked)["bufferViews"][compressed.size() - 1]["buffer"].get<size_t>()],
        compression);
    if (fallback)
      buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  }
  return compressed;
}

// The loader's only way to disk: everything else is "not found".
tinygltf::FsCallbacks Sandbox(std::string* folder) {
  tinygltf::FsCallbacks callbacks;
  callbacks.user_data = folder;
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.FileExists = [](const std::string& path, void* user) {
    const std::string& base = *static_cast<std::string*>(user);
    return !base.empty() && path.starts_with(base) && IsFileInside(path, base);
  };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*,
                               const std::string& path, void*) {
    const std::optional<std::string> bytes = TryReadFile(path);
    if (bytes) out->assign(bytes->begin(), bytes->end());
    return bytes.has_value();
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
  return callbacks;
}

tinygltf::Model LoadModel(const std::string& checked, const GltfContainer& container,
                          const std::string& name, std::string folder) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](auto...) { return true; }, nullptr);
  loader.SetFsCallbacks(Sandbox(&folder));
  tinygltf::Model model;
  std::string errors, warnings;
  bool loaded = false;
  try {
    if (container.binary) {
      const std::string glb = JoinGlb(checked, container.data);
      loaded = loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                           reinterpret_cast<const unsigned char*>(glb.data()),
                                           static_cast<unsigned>(glb.size()), folder);
    } else {
      loaded = loader.LoadASCIIFromString(&model, &errors, &warnings, checked.data(),
                                          static_cast<unsigned>(checked.size()), folder);
    }
  } catch (const std::exception& error) {
    errors = error.what();
    loaded = false;
  }
  if (!loaded) throw InputError(fmt::format("{}: not readable: {}", name, OneLine(errors)));
  return model;
}

// Fills parents and order.
void SortNodes(const std::string& name, LoadedGltf* gltf) {
  const std::vector<tinygltf::Node>& nodes = gltf->model.nodes;
  const int count = static_cast<int>(nodes.size());
  gltf->parent.assign(nodes.size(), -1);
  for (int n = 0; n < count; ++n) {
    for (const int child : nodes[n].children) {
      if (gltf->parent[child] >= 0) {
        throw InputError(fmt::format("{}: nodes[{}] has two parents, {} and {}", name, child,
                                     gltf->parent[child], n));
      }
      gltf->parent[child] = n;
    }
  }
  std::vector<int> open;
  for (int n = count - 1; n >= 0; --n) {
    if (gltf->parent[n] < 0) open.push_back(n);
  }
  while (!open.empty()) {
    const int n = open.back();
    open.pop_back();
    gltf->order.push_back(n);
    open.insert(open.end(), nodes[n].children.rbegin(), nodes[n].children.rend());
  }
  // What is not reached from the roots is in a loop.
  if (static_cast<int>(gltf->order.size()) != count) {
    throw InputError(name + ": the node hierarchy has a loop");
  }
}

}  // namespace

bool IsFileInside(const std::string& path, const std::string& folder) {
  std::error_code error;
  const fs::path base = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path file = fs::canonical(path, error);
  if (error || !fs::is_regular_file(file, error)) return false;
  return std::mismatch(base.begin(), base.end(), file.begin(), file.end()).first == base.end();
}

LoadedGltf LoadGltf(std::string_view bytes, const std::string& name, const std::string& folder) {
  const GltfContainer container = SplitGltf(bytes, name);
  const json document = ParseJson(container.json, name);
  json checked = CheckedGltf(document, name);
  LoadedGltf out;
  out.compression = CompressionOf(document);
  const std::vector<bool> compressed = CompressedViews(document, out.compression, &checked);
  out.model = LoadModel(checked.dump(), container, name, folder);
  for (size_t v = 0; v < compressed.size() && v < out.model.bufferViews.size(); ++v) {
    if (compressed[v]) out.model.bufferViews[v].extensions[out.compression] = tinygltf::Value();
  }
  SortNodes(name, &out);
  const auto extensions = document.find("extensions");
  out.extensions = extensions == document.end() ? "{}" : extensions->dump();
  return out;
}

}  // namespace retarget::io
