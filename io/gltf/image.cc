#include "io/gltf/image.h"

#include <cctype>
#include <iterator>

#include "io/gltf/load.h"
#include "io/text/read_file.h"

namespace retarget::io {
namespace {

// "%20" is a space, and so on.
std::string Unescaped(const std::string& uri) {
  std::string out;
  for (size_t i = 0; i < uri.size(); ++i) {
    const auto is_digit = [&](size_t at) {
      return at < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[at])) != 0;
    };
    if (uri[i] == '%' && is_digit(i + 1) && is_digit(i + 2)) {
      out.push_back(static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)));
      i += 2;
    } else {
      out.push_back(uri[i]);
    }
  }
  return out;
}

}  // namespace

std::optional<std::string> ReadUri(const std::string& uri, const std::string& folder) {
  if (uri.starts_with("data:")) {
    constexpr std::string_view kMark = ";base64,";
    const size_t at = uri.find(kMark);
    if (at == std::string::npos) return std::nullopt;
    // tinygltf wants one of the media types that it knows.
    const std::string plain = "data:application/octet-stream;base64,";
    std::vector<unsigned char> bytes;
    std::string type;
    if (!tinygltf::DecodeDataURI(&bytes, type, plain + uri.substr(at + kMark.size()), 0, false)) {
      return std::nullopt;
    }
    return std::string(bytes.begin(), bytes.end());
  }
  if (folder.empty()) return std::nullopt;
  const std::string path = folder + "/" + Unescaped(uri);
  if (!IsFileInside(path, folder)) return std::nullopt;
  return TryReadFile(path);
}

std::string MediaTypeOf(std::string_view image) {
  if (image.starts_with("\x89PNG")) return "image/png";
  if (image.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  if (image.starts_with("RIFF") && image.substr(0, 12).ends_with("WEBP")) return "image/webp";
  if (image.starts_with("\xABKTX 20")) return "image/ktx2";
  if (image.substr(0, 12).ends_with("ftypavif")) return "image/avif";
  if (image.starts_with("DDS ")) return "image/vnd-ms.dds";
  return "";
}

}  // namespace retarget::io
