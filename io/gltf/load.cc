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

// Required extensions without which the numbers of a motion cannot be read.
void RefuseCompression(const json& document, const std::string& name) {
  const auto required = document.find("extensionsRequired");
  if (required == document.end() || !required->is_array()) return;
  for (const json& extension : *required) {
    if (!extension.is_string()) continue;
    const std::string text = extension;
    if (text.ends_with("_meshopt_compression")) {
      throw InputError(fmt::format("{}: its data are compressed ({}): export it uncompressed", name,
                                   Printable(text)));
    }
  }
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
  const std::string checked = CheckedGltf(document, name).dump();
  RefuseCompression(document, name);
  LoadedGltf out;
  out.model = LoadModel(checked, container, name, folder);
  SortNodes(name, &out);
  const auto extensions = document.find("extensions");
  out.extensions = extensions == document.end() ? "{}" : extensions->dump();
  return out;
}

}  // namespace retarget::io
