// Numbers as bytes, least significant first, whatever the machine.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace retarget::io {

template <typename T>
void AppendLittle(T value, std::string* out) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) {
    for (size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(bytes[k], bytes[sizeof(T) - 1 - k]);
  }
  out->append(bytes, sizeof(T));
}

}  // namespace retarget::io
