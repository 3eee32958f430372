// Pictures that the studio keeps, as bytes: it looks at their first few and never decodes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace retarget::studio {

struct ImageKind {
  const char* type;       // "image/png"
  const char* extension;  // "png"
};

// By content; nothing where it is neither PNG, JPEG nor WebP.
std::optional<ImageKind> ImageKindOf(std::string_view bytes);

}  // namespace retarget::studio
