// The two spellings of a glTF file: JSON text, or a binary container (GLB) with a JSON chunk and
// at most one chunk of data. Inner part of io/gltf/clip.h.
#pragma once

#include <string>
#include <string_view>

namespace retarget::io {

// Parts of a file, as views into its bytes.
struct GltfContainer {
  bool binary = false;    // a GLB
  std::string_view json;  // the text; of a GLB, with its padding
  std::string_view data;  // the BIN chunk with its padding; empty where there is none
  std::string_view rest;  // of a GLB: chunks after the data, which readers have to skip
};

// Throws InputError, one line that begins with `name`, where the lengths, the chunks or their order
// are wrong, or the JSON text is nested so deep that it could exhaust a parser's stack.
GltfContainer SplitGltf(std::string_view bytes, const std::string& name);

// The container around a text and data of any length. Throws InputError beyond 4 GiB.
std::string JoinGlb(std::string_view json, std::string_view data, std::string_view rest = {});

}  // namespace retarget::io
