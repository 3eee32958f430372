// Typed values of a tree; yaml_parse.cc makes the tree.
#include "io/text/yaml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <system_error>

#include "io/text/nearest_name.h"
#include "io/text/yaml_message.h"

namespace retarget::io {
namespace {

using Kind = YamlValue::Kind;

constexpr size_t kMaxFile = size_t{4} << 20;  // bytes
constexpr size_t kMaxShown = 60;              // bytes of a value in a message

std::string Describe(const YamlValue& value) {
  switch (value.kind) {
    case Kind::kNothing:
      return "nothing";
    case Kind::kScalar:
      return (value.quoted ? "the text " : "") + ShownText(value.text);
    case Kind::kList:
      return fmt::format("a list of {}", value.children.size());
    case Kind::kMap:
      break;
  }
  return "a map";
}

// A finite decimal number, and nothing else.
std::optional<double> ParseNumber(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

bool IsPlainScalar(const YamlValue& value) { return value.kind == Kind::kScalar && !value.quoted; }

std::string WithUnit(const std::string& unit) { return unit.empty() ? "" : " (" + unit + ")"; }

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

std::string ShownText(const std::string& text) {
  size_t length = std::min(text.size(), kMaxShown);
  if (length < text.size()) {  // not within a character of several bytes
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) --length;
  }
  std::string shown = text.substr(0, length);
  std::replace_if(shown.begin(), shown.end(), IsControl, '?');
  return "\"" + shown + (length < text.size() ? "...\"" : "\"");
}

const YamlValue* YamlValue::Find(std::string_view wanted) const {
  for (const YamlValue& child : children) {
    if (child.key == wanted) return &child;
  }
  return nullptr;
}

std::string ReadTextFile(const std::string& path, const std::string& expected) {
  std::ifstream in(path, std::ios::binary);
  std::string text(kMaxFile + 1, '\0');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in.is_open() || in.bad()) {
    throw InputError(path + ": found no readable file, expected " + expected);
  }
  if (in) throw InputError(path + ": found more than 4 MB, expected " + expected);
  text.resize(static_cast<size_t>(in.gcount()));
  return text;
}

void Refuse(const YamlValue& value, const std::string& message) {
  throw InputError(value.place + ": " + (value.path.empty() ? "" : value.path + ": ") + message);
}

void RefuseExpecting(const YamlValue& value, const std::string& expected) {
  Refuse(value, "expected " + expected + ", found " + Describe(value));
}

void CheckKeys(const YamlValue& value, const std::vector<std::string>& known) {
  if (value.kind != Kind::kMap) RefuseExpecting(value, "a map of keys and values");
  for (const YamlValue& child : value.children) {
    if (std::find(known.begin(), known.end(), child.key) != known.end()) continue;
    throw InputError(child.place + ": unknown key \"" + child.path + "\"" +
                     Suggestion(child.key, known, JoinPath(value.path, "")));
  }
}

const YamlValue& Require(const YamlValue& map, const std::string& key) {
  const YamlValue* value = map.Find(key);
  if (!value) {
    throw InputError(map.place + ": missing key \"" + JoinPath(map.path, key) + "\"");
  }
  return *value;
}

const std::vector<YamlValue>& ReadList(const YamlValue& value) {
  if (value.kind != Kind::kList) RefuseExpecting(value, "a list");
  return value.children;
}

double ReadNumber(const YamlValue& value, double least, double most, const std::string& unit) {
  const auto number = IsPlainScalar(value) ? ParseNumber(value.text) : std::nullopt;
  if (!number || *number < least || *number > most) {
    RefuseExpecting(value, fmt::format("a number from {} to {}{}", least, most, WithUnit(unit)));
  }
  return *number;
}

int ReadInteger(const YamlValue& value, int least, int most) {
  const std::string& text = value.text;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!IsPlainScalar(value) || error != std::errc() || end != text.data() + text.size() ||
      number < least || number > most) {
    RefuseExpecting(value, fmt::format("a whole number from {} to {}", least, most));
  }
  return number;
}

VecX ReadNumbers(const YamlValue& value, int count, double least, double most,
                 const std::string& unit) {
  if (value.kind != Kind::kList || static_cast<int>(value.children.size()) != count) {
    RefuseExpecting(value, fmt::format("a list of {} numbers{}", count, WithUnit(unit)));
  }
  VecX numbers(count);
  for (int i = 0; i < count; ++i) {
    numbers[i] = ReadNumber(value.children[i], least, most, unit);
  }
  return numbers;
}

bool ReadBool(const YamlValue& value) {
  const bool is_true = value.text == "true";
  if (!IsPlainScalar(value) || (!is_true && value.text != "false")) {
    RefuseExpecting(value, "true or false");
  }
  return is_true;
}

std::string ReadText(const YamlValue& value) {
  if (value.kind != Kind::kScalar) RefuseExpecting(value, "text");
  return value.text;
}

int ReadName(const YamlValue& value, const std::string& what,
             const std::vector<std::string>& names) {
  if (value.kind != Kind::kScalar) RefuseExpecting(value, "the name of a " + what);
  const auto found = std::find(names.begin(), names.end(), value.text);
  if (found == names.end()) {
    Refuse(value, "unknown " + what + " " + ShownText(value.text) + Suggestion(value.text, names));
  }
  return static_cast<int>(found - names.begin());
}

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
