#include "tools/batch/manifest_paths.h"

#include <fmt/format.h>

#include <filesystem>

#include "model/geometry/types.h"

namespace retarget::batch {
namespace {

namespace fs = std::filesystem;

// One file, without selection.
std::string FileFrom(const std::string& folder, const std::string& path) {
  if (folder.empty() || fs::path(path).is_absolute()) return path;
  const std::string beside = (fs::path(folder) / path).lexically_normal().string();
  std::error_code error;
  const bool there = fs::exists(beside, error), here = fs::exists(path, error);
  if (there && here && !fs::equivalent(beside, path, error)) {
    throw InputError(
        fmt::format("{} is beside the manifest and in the current folder, and they "
                    "are two files; give the whole path",
                    path));
  }
  return there || !here ? beside : path;
}

}  // namespace

bool IsPathColumn(const std::string& column) {
  return column == "clip-a" || column == "clip-b" || column == "template" || column == "config" ||
         column.starts_with("map-") || column.starts_with("character-");
}

bool IsWholeColumn(const std::string& column) { return IsPathColumn(column) || column == "also"; }

std::string PathFrom(const std::string& folder, const std::string& text) {
  std::error_code error;
  if (fs::exists(fs::path(folder) / text, error) || fs::exists(text, error)) {
    return FileFrom(folder, text);
  }
  const size_t colon = text.find(".asf:");
  if (colon != std::string::npos) {
    const std::string motion = PathFrom(folder, text.substr(colon + 5));
    return FileFrom(folder, text.substr(0, colon + 4)) + ":" + motion;
  }
  const size_t hash = text.rfind('#');
  if (hash == std::string::npos) return FileFrom(folder, text);
  return FileFrom(folder, text.substr(0, hash)) + text.substr(hash);
}

}  // namespace retarget::batch
