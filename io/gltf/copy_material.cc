// Materials, textures and images of io/gltf/copy.h.
#include <fmt/format.h>

#include "io/gltf/copy.h"
#include "io/gltf/image.h"
#include "io/text/quoted.h"

namespace retarget::io {

using nlohmann::json;

// The places of textures are known by their form, in glTF's own members as in extensions': a member
// called "...Texture" with an `index`.
void GltfCopier::MendMaterial(json* material) {
  if (!material->is_object()) return;
  for (auto it = material->begin(); it != material->end();) {
    bool there = true;
    if (it.key() != "extras") {
      if (it.key().ends_with("Texture") && it->is_object() && it->contains("index")) {
        const int texture = CopyTexture((*it)["index"]);
        there = texture >= 0;
        if (there) (*it)["index"] = texture;
      }
      if (there) MendMaterial(&*it);
    }
    it = there ? std::next(it) : material->erase(it);
  }
}

int GltfCopier::CopyTexture(const json& index) {
  const size_t old = CheckedIndex("textures", index);
  const auto known = copied_.find({"textures", old});
  if (known != copied_.end()) return known->second;
  json texture = source_.document["textures"][old];
  KeepKnownExtensions(&texture);
  bool there = false;
  const auto mend = [&](json* object) {
    if (!object->is_object() || !object->contains("source")) return;
    const int image = CopyImage((*object)["source"]);
    if (image < 0) {
      object->erase("source");
    } else {
      (*object)["source"] = image;
      there = true;
    }
  };
  mend(&texture);
  const auto extensions = texture.find("extensions");
  if (extensions != texture.end()) {
    for (auto it = extensions->begin(); it != extensions->end();) {
      mend(&*it);
      it = it->is_object() && it->contains("source") ? std::next(it) : extensions->erase(it);
    }
    if (extensions->empty()) texture.erase(extensions);
  }
  Follow(&texture, "sampler", "samplers", &GltfCopier::MendNothing);
  return copied_[{"textures", old}] = there ? target_.Add("textures", std::move(texture)) : -1;
}

int GltfCopier::CopyImage(const json& index) {
  const size_t old = CheckedIndex("images", index);
  const auto known = copied_.find({"images", old});
  if (known != copied_.end()) return known->second;
  json image = source_.document["images"][old];
  KeepKnownExtensions(&image);
  bool there = true;
  if (image.contains("bufferView")) {
    image["bufferView"] = CopyView(image["bufferView"]);
  } else {
    const auto uri = image.find("uri");
    const std::string text = uri != image.end() && uri->is_string() ? uri->get<std::string>() : "";
    const std::optional<std::string> bytes = ReadUri(text, source_.folder);
    const std::string type = bytes ? MediaTypeOf(*bytes) : "";
    there = !type.empty();
    if (there) {
      image.erase("uri");
      image["mimeType"] = type;
      image["bufferView"] = target_.AddView(json::object(), *bytes);
    } else {
      missing_.push_back(fmt::format(
          "{}: images[{}] ({}) is {}: what it covers is shown without it", source_.name, old,
          text.starts_with("data:") ? "data" : "\"" + Printable(text) + "\"",
          bytes ? "no image of a known format" : "no file in the model's folder or below"));
    }
  }
  return copied_[{"images", old}] = there ? target_.Add("images", std::move(image)) : -1;
}

}  // namespace retarget::io
