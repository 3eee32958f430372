// The one way to read a whole file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace retarget::io {

// Bytes of the file; nothing where there is none that can be read, or a folder.
std::optional<std::string> TryReadFile(const std::string& path);

// The same; `expected` says what it should be ("a BVH file"). Throws InputError
//   path: found no readable file, expected a BVH file
//   path: found no readable file (it is a folder), expected a BVH file
//   path: found more than 4 MB, expected a BVH file
std::string ReadFile(const std::string& path, const std::string& expected = "a file",
                     size_t most_bytes = std::string::npos);

// The same of a file that says nothing where it is empty: then there is no readable file.
std::string ReadFilledFile(const std::string& path, const std::string& expected);

}  // namespace retarget::io
