// Nodes, skins, meshes and data; gltf_copy_material.cc copies materials and images.
#include "io/gltf/copy.h"

#include <fmt/format.h>

#include <functional>

#include "io/gltf/container.h"
#include "io/gltf/extensions.h"
#include "io/text/quoted.h"
#include "model/geometry/types.h"

namespace retarget::io {

using nlohmann::json;

namespace {

// A member that is an object, or null.
json* ObjectIn(json* object, const char* key) {
  const auto it = object->find(key);
  return it != object->end() && it->is_object() ? &*it : nullptr;
}

json* ExtensionOf(json* object, const char* name) {
  json* extensions = ObjectIn(object, "extensions");
  return extensions != nullptr ? ObjectIn(extensions, name) : nullptr;
}

}  // namespace

GltfSource::GltfSource(std::string_view bytes, const std::string& file,
                       const std::string& files_folder)
    : name(file), folder(files_folder), gltf(LoadGltf(bytes, file, files_folder)) {
  document = json::parse(SplitGltf(bytes, file).json);
}

int GltfTarget::Add(const char* array, json item) {
  document[array].push_back(std::move(item));
  return static_cast<int>(document[array].size()) - 1;
}

size_t GltfTarget::Place(std::string_view bytes) {
  const size_t hash = std::hash<std::string_view>()(bytes);
  const auto [begin, end] = places_.equal_range(hash);
  for (auto it = begin; it != end; ++it) {
    const auto [offset, length] = it->second;
    if (std::string_view(data_).substr(offset, length) == bytes) return offset;
  }
  data_.append((4 - data_.size() % 4) % 4, '\0');
  const size_t offset = data_.size();
  data_ += bytes;
  places_.emplace(hash, std::pair(offset, bytes.size()));
  return offset;
}

int GltfTarget::AddView(json view, std::string_view bytes) {
  view["buffer"] = 0;
  view["byteOffset"] = Place(bytes);
  view["byteLength"] = bytes.size();
  return Add("bufferViews", std::move(view));
}

std::string GltfTarget::Finish() {
  if (!data_.empty()) document["buffers"][0]["byteLength"] = data_.size();
  for (const std::string& name : used) document["extensionsUsed"].push_back(name);
  for (const std::string& name : required) {
    if (used.contains(name)) document["extensionsRequired"].push_back(name);
  }
  return JoinGlb(document.dump(-1, ' ', false, json::error_handler_t::replace), data_);
}

GltfCopier::GltfCopier(const GltfSource& source, GltfTarget* target)
    : source_(source), target_(*target) {
  const auto names = [&](const char* key) {
    std::vector<std::string> out;
    const auto it = source.document.find(key);
    if (it == source.document.end() || !it->is_array()) return out;
    for (const json& name : *it) {
      if (name.is_string()) out.push_back(name);
    }
    return out;
  };
  for (const std::string& name : names("extensionsRequired")) {
    if (IsCopiedExtension(name)) {
      target_.required.insert(name);
    } else if (!CanBeLeftOut(name)) {
      throw InputError(
          fmt::format("{}: requires the extension \"{}\", which a scene of several files cannot "
                      "carry, expected a character without it",
                      source.name, Printable(name)));
    }
  }
  for (const std::string& name : names("extensionsUsed")) {
    if (HasNoObject(name)) target_.used.insert(name);
  }
  const auto extensions = source.document.find("extensions");
  if (extensions == source.document.end() || !extensions->is_object()) return;
  for (const auto& [name, object] : extensions->items()) left_out_.insert(name);
}

size_t GltfCopier::CheckedIndex(const char* array, const json& index) const {
  const auto it = source_.document.find(array);
  const size_t size = it != source_.document.end() && it->is_array() ? it->size() : 0;
  if (!index.is_number_unsigned() || index.get<size_t>() >= size) {
    throw InputError(fmt::format("{}: expected an index of one of {} {}, found {}", source_.name,
                                 size, array, Printable(index.dump())));
  }
  if (!(*it)[index.get<size_t>()].is_object()) {
    throw InputError(
        fmt::format("{}: {}[{}]: expected an object", source_.name, array, index.get<size_t>()));
  }
  return index;
}

int GltfCopier::Copy(const char* array, const json& index, Mend mend) {
  const size_t old = CheckedIndex(array, index);
  const auto known = copied_.find({array, old});
  if (known != copied_.end()) return known->second;
  json item = source_.document[array][old];
  KeepKnownExtensions(&item);
  (this->*mend)(&item);
  return copied_[{array, old}] = target_.Add(array, std::move(item));
}

void GltfCopier::Follow(json* object, const char* key, const char* array, Mend mend) {
  const auto it = object->find(key);
  if (it != object->end()) *it = Copy(array, *it, mend);
}

void GltfCopier::FollowAll(json* object, const char* array, Mend mend) {
  if (object == nullptr || !object->is_object()) return;
  for (json& index : *object) index = Copy(array, index, mend);
}

// Of an object and all within it.
void GltfCopier::KeepKnownExtensions(json* value) {
  if (value->is_object()) {
    if (json* extensions = ObjectIn(value, "extensions")) {
      for (auto it = extensions->begin(); it != extensions->end();) {
        const bool known = IsCopiedExtension(it.key());
        (known ? target_.used : left_out_).insert(it.key());
        it = known ? std::next(it) : extensions->erase(it);
      }
      if (extensions->empty()) value->erase("extensions");
    }
    for (auto it = value->begin(); it != value->end(); ++it) {
      if (it.key() != "extras") KeepKnownExtensions(&*it);
    }
  } else if (value->is_array()) {
    for (json& item : *value) KeepKnownExtensions(&item);
  }
}

std::vector<int> GltfCopier::CopyNodes(const std::vector<bool>& kept) {
  json& nodes = target_.document["nodes"];
  if (nodes.is_null()) nodes = json::array();
  new_node_.assign(kept.size(), -1);
  int next = static_cast<int>(nodes.size());
  for (size_t n = 0; n < kept.size(); ++n) {
    if (kept[n]) new_node_[n] = next++;
  }
  for (size_t n = 0; n < kept.size(); ++n) {
    if (!kept[n]) continue;
    json node = source_.document["nodes"][n];
    KeepKnownExtensions(&node);
    MendNode(&node);
    target_.Add("nodes", std::move(node));
  }
  return new_node_;
}

int GltfCopier::CopyAccessor(const json& index) {
  return Copy("accessors", index, &GltfCopier::MendAccessor);
}

void GltfCopier::MendNode(json* node) {
  json children = json::array();
  for (const json& child : node->value("children", json::array())) {
    const int copy = new_node_[child.get<size_t>()];
    if (copy >= 0) children.push_back(copy);
  }
  node->erase("children");
  if (!children.empty()) (*node)["children"] = std::move(children);
  node->erase("camera");
  Follow(node, "mesh", "meshes", &GltfCopier::MendMesh);
  Follow(node, "skin", "skins", &GltfCopier::MendSkin);
  if (json* instances = ExtensionOf(node, "EXT_mesh_gpu_instancing")) {
    FollowAll(ObjectIn(instances, "attributes"), "accessors", &GltfCopier::MendAccessor);
  }
}

void GltfCopier::MendSkin(json* skin) {
  for (json& joint : (*skin)["joints"]) joint = new_node_[joint.get<size_t>()];
  if (skin->contains("skeleton")) {
    const int top = new_node_[(*skin)["skeleton"].get<size_t>()];
    if (top >= 0) {
      (*skin)["skeleton"] = top;
    } else {
      skin->erase("skeleton");
    }
  }
  Follow(skin, "inverseBindMatrices", "accessors", &GltfCopier::MendAccessor);
}

void GltfCopier::MendMesh(json* mesh) {
  for (json& primitive : (*mesh)["primitives"]) {
    FollowAll(ObjectIn(&primitive, "attributes"), "accessors", &GltfCopier::MendAccessor);
    Follow(&primitive, "indices", "accessors", &GltfCopier::MendAccessor);
    Follow(&primitive, "material", "materials", &GltfCopier::MendMaterial);
    const auto targets = primitive.find("targets");
    if (targets != primitive.end() && targets->is_array()) {
      for (json& shape : *targets) FollowAll(&shape, "accessors", &GltfCopier::MendAccessor);
    }
    if (json* draco = ExtensionOf(&primitive, "KHR_draco_mesh_compression")) {
      if (draco->contains("bufferView")) (*draco)["bufferView"] = CopyView((*draco)["bufferView"]);
    }
  }
}

void GltfCopier::MendAccessor(json* accessor) {
  const auto mend = [&](json* object) {
    if (object == nullptr || !object->contains("bufferView")) return;
    (*object)["bufferView"] = CopyView((*object)["bufferView"]);
  };
  mend(accessor);
  if (json* sparse = ObjectIn(accessor, "sparse")) {
    mend(ObjectIn(sparse, "indices"));
    mend(ObjectIn(sparse, "values"));
  }
}

int GltfCopier::CopyView(const json& index) {
  const size_t old = CheckedIndex("bufferViews", index);
  const auto known = copied_.find({"bufferViews", old});
  if (known != copied_.end()) return known->second;
  json view = source_.document["bufferViews"][old];
  view.erase("extensions");  // compression besides plain data, which are what is copied
  const std::vector<unsigned char>& data =
      source_.gltf.model.buffers[view["buffer"].get<size_t>()].data;
  const size_t begin = view.value("byteOffset", size_t{0}), length = view["byteLength"];
  if (begin > data.size() || length > data.size() - begin) {
    throw InputError(
        fmt::format("{}: bufferViews[{}] reaches beyond its buffer", source_.name, old));
  }
  const std::string_view bytes(reinterpret_cast<const char*>(data.data()) + begin, length);
  return copied_[{"bufferViews", old}] = target_.AddView(std::move(view), bytes);
}

}  // namespace retarget::io
