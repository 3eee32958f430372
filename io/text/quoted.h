// A user's text in a message or a table: short, on one line, without control characters.
#pragma once

#include <string>
#include <string_view>

namespace retarget::io {

inline bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

// The first 60 bytes, '?' for control characters.
std::string Printable(std::string_view text);

// The same in quotes: "left_hnad", or "left_..." where it is longer.
std::string Quoted(std::string_view text);

// A word of a file of motion, where names hold double quotes: 'left_hnad', of ASCII, 40 bytes.
std::string QuotedWord(std::string_view word);

// What a library says, cut to one line of 160 bytes.
std::string OneLine(std::string_view text);

}  // namespace retarget::io
