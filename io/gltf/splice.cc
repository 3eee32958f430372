#include "io/gltf/splice.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace retarget::io {

JsonSplice::JsonSplice(std::string_view text) : text_(text) {
  root_.begin = text.find('{');  // past spaces and a byte order mark
  root_.end = SkipValue(root_.begin);
}

size_t JsonSplice::SkipSpace(size_t at) const {
  while (at < text_.size() && std::string_view(" \t\r\n").find(text_[at]) != std::string::npos) {
    ++at;
  }
  return at;
}

size_t JsonSplice::SkipString(size_t at) const {
  for (++at; at < text_.size() && text_[at] != '"'; ++at) {
    if (text_[at] == '\\') ++at;
  }
  return std::min(at + 1, text_.size());
}

size_t JsonSplice::SkipValue(size_t at) const {
  int depth = 0;
  do {
    at = SkipSpace(at);
    if (at >= text_.size()) break;
    const char c = text_[at];
    if (c == '"') {
      at = SkipString(at);
    } else if (c == '{' || c == '[') {
      ++depth;
      ++at;
    } else if (c == '}' || c == ']') {
      --depth;
      ++at;
    } else if (c == ',' || c == ':') {
      ++at;
    } else {
      while (at < text_.size() &&
             std::string_view(",:]} \t\r\n").find(text_[at]) == std::string::npos) {
        ++at;
      }
    }
  } while (depth > 0);
  return at;
}

std::vector<JsonSplice::Entry> JsonSplice::Entries(Span object) const {
  std::vector<Entry> out;
  size_t at = SkipSpace(object.begin + 1);
  while (at < object.end && text_[at] == '"') {
    Entry entry;
    entry.key = {at, SkipString(at)};
    entry.value.begin = SkipSpace(SkipSpace(entry.key.end) + 1);  // past the colon
    entry.value.end = SkipValue(entry.value.begin);
    out.push_back(entry);
    at = SkipSpace(entry.value.end);
    if (at < object.end && text_[at] == ',') at = SkipSpace(at + 1);
  }
  return out;
}

std::vector<JsonSplice::Span> JsonSplice::Elements(Span array) const {
  std::vector<Span> out;
  size_t at = SkipSpace(array.begin + 1);
  while (at < array.end && text_[at] != ']') {
    out.push_back({at, SkipValue(at)});
    at = SkipSpace(out.back().end);
    if (at < array.end && text_[at] == ',') at = SkipSpace(at + 1);
  }
  return out;
}

std::optional<JsonSplice::Entry> JsonSplice::Find(Span object, std::string_view key) const {
  std::optional<Entry> found;
  for (const Entry& entry : Entries(object)) {
    const std::string_view raw = text_.substr(entry.key.begin, entry.key.end - entry.key.begin);
    const bool same = raw.find('\\') == std::string_view::npos
                          ? raw.substr(1, raw.size() - 2) == key
                          : nlohmann::json::parse(raw) == nlohmann::json(key);
    if (same) found = entry;
  }
  return found;
}

std::optional<JsonSplice::Span> JsonSplice::Member(Span object, std::string_view key) const {
  const std::optional<Entry> entry = Find(object, key);
  return entry ? std::optional<Span>(entry->value) : std::nullopt;
}

void JsonSplice::Replace(Span value, std::string with) {
  edits_.emplace_back(value, std::move(with));
}

void JsonSplice::ReplaceMember(Span object, std::string_view key, std::string with) {
  if (const std::optional<Entry> entry = Find(object, key)) {
    Replace({entry->key.begin, entry->value.end}, std::move(with));
  }
}

void JsonSplice::Append(const std::string& key, const std::string& value) {
  for (auto& [array, values] : appended_) {
    if (array != key) continue;
    values += "," + value;
    return;
  }
  appended_.emplace_back(key, value);
}

std::string JsonSplice::Finish() {
  const std::vector<Entry> members = Entries(root_);
  std::string made;  // arrays that were not there
  for (const auto& [key, values] : appended_) {
    const std::optional<Span> array = Member(root_, key);
    if (!array) {
      made += (members.empty() && made.empty() ? "\"" : ",\"") + key + "\":[" + values + "]";
      continue;
    }
    const std::vector<Span> elements = Elements(*array);
    const size_t at = elements.empty() ? array->begin + 1 : elements.back().end;
    Replace({at, at}, (elements.empty() ? "" : ",") + values);
  }
  if (!made.empty()) {
    const size_t at = members.empty() ? root_.begin + 1 : members.back().value.end;
    Replace({at, at}, made);
  }
  // Among edits at one place, what ends there comes before what is inserted.
  std::stable_sort(edits_.begin(), edits_.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.begin, a.first.end) < std::pair(b.first.begin, b.first.end);
  });
  std::string out;
  size_t at = 0;
  for (const auto& [span, with] : edits_) {
    out += text_.substr(at, span.begin - at);
    out += with;
    at = span.end;
  }
  out += text_.substr(at);
  return out;
}

}  // namespace retarget::io
