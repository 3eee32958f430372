// A bitmap font of 5 x 7 pixels for the printable ASCII characters, drawn for this project.
#pragma once

#include <array>

namespace retarget::io {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7;

// Rows from the top; bit 4 of a row is its leftmost pixel. A hollow box for unknown characters.
const std::array<unsigned char, kGlyphHeight>& GlyphOf(char c);

}  // namespace retarget::io
