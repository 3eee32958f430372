// Text of a file in a message or a table.
#pragma once

#include <string>
#include <string_view>

namespace retarget::io {

// The first 60 characters, '?' for control characters, so that a line stays a line.
inline std::string Printable(std::string_view text) {
  std::string out;
  for (char c : text.substr(0, 60)) {
    out += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  }
  return out;
}

}  // namespace retarget::io
