// Which glTF extensions can be copied from one document into another. Inner part of
// io/scene/character_scene.h.
#pragma once

#include <string_view>

namespace retarget::io {

// Whether an extension's objects may be copied: their indices, if they have any, are known to
// io/gltf/copy.h.
bool IsCopiedExtension(std::string_view name);

// Whether a copied extension says something about numbers and has no object of its own.
bool HasNoObject(std::string_view name);

// Whether a document can do without an extension although it requires it: it is about what is left
// out (lights, animations), or about another choice of what there is.
bool CanBeLeftOut(std::string_view name);

}  // namespace retarget::io
