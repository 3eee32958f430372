// Copying parts of glTF documents into one, with all that they refer to. Inner part of
// io/scene/character_scene.h.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/gltf/load.h"

namespace retarget::io {

// A document to copy from. What should not be copied may be erased from `document` before.
struct GltfSource {
  // Throws InputError as LoadGltf does.
  GltfSource(std::string_view bytes, const std::string& file, const std::string& files_folder);

  std::string name, folder;  // for messages; where its external files are
  LoadedGltf gltf;           // hierarchy and buffers
  nlohmann::json document;
};

// The document that is put together. All data go into its one buffer, equal data once.
class GltfTarget {
 public:
  nlohmann::json document;
  std::set<std::string> used, required;  // extensions

  // Appends to an array of the document. Returns the index.
  int Add(const char* array, nlohmann::json item);
  // Appends a view of `bytes`; `view` says the rest of it.
  int AddView(nlohmann::json view, std::string_view bytes);
  // The bytes of the GLB.
  std::string Finish();

 private:
  size_t Place(std::string_view bytes);  // in the buffer, a multiple of 4

  std::string data_;
  std::unordered_multimap<size_t, std::pair<size_t, size_t>> places_;  // by hash: offset, length
};

// Copies from one source. What is referred to is copied once and on demand.
class GltfCopier {
 public:
  // Both must outlive this object. Throws InputError where the source requires an extension that
  // cannot be copied.
  GltfCopier(const GltfSource& source, GltfTarget* target);

  // Copies the `kept` nodes, children of which only kept ones remain. A skin must come with its
  // joints. Returns the new indices, -1 where a node was not kept. [nodes]
  std::vector<int> CopyNodes(const std::vector<bool>& kept);
  int CopyAccessor(const nlohmann::json& index);

  const std::set<std::string>& left_out() const { return left_out_; }   // names of extensions
  const std::vector<std::string>& missing() const { return missing_; }  // images, as sentences

 private:
  using Mend = void (GltfCopier::*)(nlohmann::json* item);
  size_t CheckedIndex(const char* array, const nlohmann::json& index) const;
  // Copies an item once; `mend` gives it its new indices.
  int Copy(const char* array, const nlohmann::json& index, Mend mend);
  void Follow(nlohmann::json* object, const char* key, const char* array, Mend mend);
  void FollowAll(nlohmann::json* object, const char* array, Mend mend);
  void KeepKnownExtensions(nlohmann::json* value);

  void MendNode(nlohmann::json* node);
  void MendSkin(nlohmann::json* skin);
  void MendMesh(nlohmann::json* mesh);
  void MendAccessor(nlohmann::json* accessor);
  void MendMaterial(nlohmann::json* material);
  void MendNothing(nlohmann::json*) {}
  int CopyView(const nlohmann::json& index);
  // -1 where its image is not there: then the material does without.
  int CopyTexture(const nlohmann::json& index);
  int CopyImage(const nlohmann::json& index);

  const GltfSource& source_;
  GltfTarget& target_;
  std::map<std::pair<std::string, size_t>, int> copied_;  // by array and old index
  std::vector<int> new_node_;
  std::set<std::string> left_out_;
  std::vector<std::string> missing_;
};

}  // namespace retarget::io
