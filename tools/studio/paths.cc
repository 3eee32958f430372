#include "tools/studio/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "model/geometry/types.h"

namespace retarget::studio {
namespace {

namespace fs = std::filesystem;

constexpr size_t kLongestId = 120;  // bytes

}  // namespace

fs::path ShippedDataFolder() {
  const char* data = std::getenv("RETARGET_DATA_DIR");
  if (data && *data) return data;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share" / "retarget";
  if (!error && fs::is_directory(installed, error)) return installed;
  return RETARGET_DATA_DIR;
}

fs::path UserTemplateFolder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  const fs::path base =
      data && *data == '/' ? fs::path(data) : fs::path(home ? home : "/") / ".local" / "share";
  return base / "retarget" / "templates";
}

bool IsPlainName(const std::string& name) {
  return !name.empty() && name[0] != '.' && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

std::string CheckedId(const std::string& name) {
  std::string id = name;
  if (id.ends_with(".yaml")) id.resize(id.size() - 5);
  const bool plain =
      IsPlainName(id) && id.size() <= kLongestId &&
      std::none_of(id.begin(), id.end(), [](unsigned char c) {
        return c < ' ' || c == 0x7f || std::string("\\:*?\"<>|").find(c) != std::string::npos;
      });
  if (!plain || id.back() == ' ' || id.back() == '.') {
    throw InputError(fmt::format(
        "expected a name for a file, of at most {} bytes, without any of / \\ : * ? \" < > | and "
        "no point at its ends, found \"{}\"",
        kLongestId, io::Printable(name)));
  }
  return id;
}

bool IsWithin(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return false;
  const fs::path root = fs::weakly_canonical(folder, error);
  if (error) return false;
  return std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
}

bool IsFileWithin(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(path, error) && IsWithin(path, folder);
}

std::string ReadAtMost(const fs::path& path, uintmax_t most) {
  std::error_code error;
  const uintmax_t size = fs::file_size(path, error);
  if (!error && size > most) {
    throw InputError(
        fmt::format("{}: has {} bytes, expected at most {}", path.filename().string(), size, most));
  }
  return io::ReadFile(path.string());
}

std::vector<fs::path> PhotosOf(const fs::path& path) {
  std::vector<fs::path> photos;
  for (const char* extension : {"jpg", "png", "webp"}) {
    photos.push_back(path.parent_path() /
                     fmt::format("{}.photo.{}", path.stem().string(), extension));
  }
  return photos;
}

fs::path ThumbnailOf(const fs::path& path) { return fs::path(path).replace_extension(".png"); }

}  // namespace retarget::studio
