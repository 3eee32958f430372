// JSON of others as a document (io/text/document.h).
#pragma once

#include <string>
#include <string_view>

#include "io/text/document.h"

namespace retarget::io {

// Throws InputError where the text is no JSON, or nested deeper than 24 levels. A key that is given
// twice has its last value.
Document ParseJson(std::string_view text);

// `text` as a JSON string, ASCII alone.
std::string JsonText(const std::string& text);

}  // namespace retarget::io
