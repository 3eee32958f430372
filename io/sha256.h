// SHA-256 (FIPS 180-4), for what must not be changed unnoticed.
#pragma once

#include <string>

namespace retarget::io {

// Of the bytes, as "sha256:" and 64 hexadecimal digits.
std::string Sha256Of(const std::string& bytes);

}  // namespace retarget::io
