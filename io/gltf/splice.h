// Edits of a JSON text that leave every other byte as it was. Inner part of io/gltf/clip.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace retarget::io {

class JsonSplice {
 public:
  // A place in the text, [begin, end).
  struct Span {
    size_t begin = 0, end = 0;
  };

  // `text` must be valid JSON, an object, and outlive this object.
  explicit JsonSplice(std::string_view text);

  Span root() const { return root_; }
  // The value of an object's member, the last one where several have the key.
  std::optional<Span> Member(Span object, std::string_view key) const;
  std::vector<Span> Elements(Span array) const;
  std::string Text(Span span) const {
    return std::string(text_.substr(span.begin, span.end - span.begin));
  }

  // Edits must not overlap. They are done by Finish.
  void Replace(Span value, std::string with);
  // Replaces key and value of a member by the text of other members.
  void ReplaceMember(Span object, std::string_view key, std::string with);
  // Appends a value to an array that is a member of the root; makes the array where there is none.
  void Append(const std::string& key, const std::string& value);

  std::string Finish();

 private:
  struct Entry {
    Span key, value;
  };
  size_t SkipSpace(size_t at) const;
  size_t SkipString(size_t at) const;  // from its first quote
  size_t SkipValue(size_t at) const;
  std::vector<Entry> Entries(Span object) const;
  std::optional<Entry> Find(Span object, std::string_view key) const;

  std::string_view text_;
  Span root_;
  std::vector<std::pair<Span, std::string>> edits_;
  std::vector<std::pair<std::string, std::string>> appended_;  // array, values between commas
};

}  // namespace retarget::io
