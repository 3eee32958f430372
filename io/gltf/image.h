// The encoded bytes of a glTF image, wherever the file keeps them. Inner part of
// io/scene/character_scene.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace retarget::io {

// What a URI stands for: the content of a data URI, or of a file in `folder` or below it. Nothing
// where there is none; an empty `folder` has no files.
std::optional<std::string> ReadUri(const std::string& uri, const std::string& folder);

// "image/png" and the like, by the first bytes; empty where the format is none that glTF and its
// extensions know.
std::string MediaTypeOf(std::string_view image);

}  // namespace retarget::io
