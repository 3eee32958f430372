#include "tools/studio/image.h"

#include <cstdint>

#include "model/geometry/types.h"

namespace retarget::studio {

std::optional<ImageKind> ImageKindOf(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return ImageKind{"image/png", "png"};
  if (bytes.starts_with("\xff\xd8\xff")) return ImageKind{"image/jpeg", "jpg"};
  if (bytes.starts_with("RIFF") && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") {
    return ImageKind{"image/webp", "webp"};
  }
  return std::nullopt;
}

std::string FromBase64(std::string_view text) {
  const auto refuse = [] { throw InputError("expected base64"); };
  if (text.size() % 4 != 0) refuse();
  size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  uint32_t bits = 0;
  for (size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = c - 'A';
    } else if (c >= 'a' && c <= 'z') {
      digit = c - 'a' + 26;
    } else if (c >= '0' && c <= '9') {
      digit = c - '0' + 52;
    } else if (c == '+') {
      digit = 62;
    } else if (c == '/') {
      digit = 63;
    } else if (c != '=' || k < text.size() - padding) {
      refuse();
    }
    bits = bits << 6 | digit;
    if (k % 4 != 3) continue;
    for (const int shift : {16, 8, 0}) bytes += static_cast<char>(bits >> shift & 0xff);
  }
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace retarget::studio
