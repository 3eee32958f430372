// YamlText of io/text/yaml.h.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/text/quoted.h"
#include "io/text/yaml.h"

namespace retarget::io {
namespace {

// Plain words that YAML gives a meaning of its own, here or in other readers.
bool IsReserved(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const char* reserved : {"null", "true", "false", "yes", "no", "on", "off", "y", "n"}) {
    if (word == reserved) return true;
  }
  return false;
}

bool IsPlainText(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_plain = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || std::string_view("_-. ").find(c) != size_t(-1);
  };
  return !text.empty() && is_letter(text.front()) && text.back() != ' ' && !IsReserved(text) &&
         std::all_of(text.begin(), text.end(), is_plain);
}

}  // namespace

std::string YamlText(const std::string& text) {
  if (IsPlainText(text)) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (IsControl(c)) {
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace retarget::io
