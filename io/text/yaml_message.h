// Pieces of the messages about YAML. Inner part of io/text/yaml_reader.h.
#pragma once

#include <string>

namespace retarget::io {

inline bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

// A user's text in a message: in quotes, without control characters, not too long.
std::string ShownText(const std::string& text);

// "a.root" and "position" to "a.root.position".
inline std::string JoinPath(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

}  // namespace retarget::io
