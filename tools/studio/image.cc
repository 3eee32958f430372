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

}  // namespace retarget::studio
