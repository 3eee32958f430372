#include "io/text/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "model/geometry/types.h"

namespace retarget::io {
namespace {

constexpr size_t kPiece = size_t{1} << 20;  // bytes read at once

bool IsFolder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

// At most `most_bytes` of it.
std::optional<std::string> ReadUpTo(const std::string& path, size_t most_bytes) {
  if (IsFolder(path)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::string bytes;
  while (in && bytes.size() < most_bytes) {
    const size_t had = bytes.size();
    bytes.resize(had + std::min(std::max(kPiece, had), most_bytes - had));
    in.read(bytes.data() + had, static_cast<std::streamsize>(bytes.size() - had));
    bytes.resize(had + static_cast<size_t>(in.gcount()));
  }
  if (in.bad()) return std::nullopt;
  return bytes;
}

}  // namespace

std::optional<std::string> TryReadFile(const std::string& path) {
  return ReadUpTo(path, std::string::npos);
}

std::string ReadFile(const std::string& path, const std::string& expected, size_t most_bytes) {
  if (IsFolder(path)) {
    throw InputError(path + ": found no readable file (it is a folder), expected " + expected);
  }
  const bool limited = most_bytes != std::string::npos;
  std::optional<std::string> bytes = ReadUpTo(path, limited ? most_bytes + 1 : most_bytes);
  if (!bytes) throw InputError(path + ": found no readable file, expected " + expected);
  if (limited && bytes->size() > most_bytes) {
    throw InputError(
        fmt::format("{}: found more than {} MB, expected {}", path, most_bytes >> 20, expected));
  }
  return *std::move(bytes);
}

std::string ReadFilledFile(const std::string& path, const std::string& expected) {
  std::string bytes = ReadFile(path, expected);
  if (bytes.empty()) throw InputError(path + ": found no readable file, expected " + expected);
  return bytes;
}

}  // namespace retarget::io
