// Base64 (RFC 4648, padded).
#pragma once

#include <string>
#include <string_view>

namespace retarget::io {

std::string EncodeBase64(std::string_view bytes);

// Throws InputError where the text is no base64.
std::string DecodeBase64(std::string_view text);

}  // namespace retarget::io
