// Arrays as numpy stores them (NEP 1, format 1.0): little-endian, C order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace retarget::io {

// The bytes of a .npy file; `shape` empty: a scalar. Each has as many values as the shape says.
std::string FormatNpy(const std::vector<double>& values, const std::vector<size_t>& shape);
std::string FormatNpy(const std::vector<int32_t>& values, const std::vector<size_t>& shape);
std::string FormatNpy(const std::vector<bool>& values, const std::vector<size_t>& shape);
// ASCII texts, [n].
std::string FormatNpy(const std::vector<std::string>& texts);

}  // namespace retarget::io
