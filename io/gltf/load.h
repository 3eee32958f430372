// Loading a glTF document by tinygltf, after a strict check of what tinygltf takes on trust.
// Inner part of io/gltf/clip.h and io/scene/scene_motion.h.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <string_view>
#include <vector>

namespace retarget::io {

// tinygltf sees only nodes, skins, animations, meshes' skinning and what they refer to: images are
// never opened, extras and unknown extensions never parsed. All indices of the model are valid.
struct LoadedGltf {
  tinygltf::Model model;
  std::string extensions;   // the document's extensions, as JSON; "{}" where it has none
  std::vector<int> parent;  // [nodes] -1 for a root; the hierarchy is known to be a forest
  std::vector<int> order;   // [nodes] parents before children, each branch in one piece
  // The extension that compresses meshes or all data, empty where none does. Buffer views that only
  // it can read have it among their extensions.
  std::string compression;
};

// `folder` holds external buffers; a path that leads out of it is refused, and so is every path
// where it is empty. Throws InputError, one line that begins with `name`.
LoadedGltf LoadGltf(std::string_view bytes, const std::string& name, const std::string& folder);

// Whether `path` is a regular file in `folder` or below it, links resolved.
bool IsFileInside(const std::string& path, const std::string& folder);

}  // namespace retarget::io
