// The parts of a glTF document that motions need, with every type and index checked. Inner part of
// io/gltf/load.h.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace retarget::io {

// A document with only the known members of nodes, skins, animations, meshes, accessors, views and
// buffers of `document`. Throws InputError that names the member: a wrong type, a missing one, an
// index out of range, a value that cannot be.
nlohmann::json CheckedGltf(const nlohmann::json& document, const std::string& name);

}  // namespace retarget::io
