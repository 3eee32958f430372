#include "io/text/quoted.h"

#include <algorithm>

namespace retarget::io {
namespace {

constexpr size_t kLongest = 60, kLongestWord = 40, kLongestLine = 160;  // bytes

// Cut, but not within a character of several bytes.
std::string_view Cut(std::string_view text) {
  size_t length = std::min(text.size(), kLongest);
  if (length < text.size()) {
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) --length;
  }
  return text.substr(0, length);
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string shown(Cut(text));
  std::replace_if(shown.begin(), shown.end(), IsControl, '?');
  return shown;
}

std::string Quoted(std::string_view text) {
  return "\"" + Printable(text) + (Cut(text).size() < text.size() ? "...\"" : "\"");
}

std::string QuotedWord(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, kLongestWord)) out += (c >= ' ' && c <= '~') ? c : '?';
  return out + (word.size() > kLongestWord ? "...'" : "'");
}

std::string OneLine(std::string_view text) {
  std::string line(text.substr(0, kLongestLine));
  if (text.size() > kLongestLine) line += "...";
  std::replace_if(line.begin(), line.end(), IsControl, ' ');
  while (line.ends_with(' ')) line.pop_back();
  return line;
}

}  // namespace retarget::io
