// The text of an ASF or AMC file as lines of words. Inner part of io/acclaim/acclaim.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace retarget::io::acclaim {

// Walks the lines that hold words. '#' begins a comment; commas and parentheses are blanks.
class LineReader {
 public:
  LineReader(std::string_view text, std::string name);

  // The next line with words; false at the end.
  bool Next();

  // Of the present line; none at the end. Never empty after Next() returned true.
  const std::vector<std::string_view>& words() const { return words_; }
  // The first word, or an empty one at the end.
  std::string_view key() const { return words_.empty() ? std::string_view() : words_[0]; }
  size_t line_begin() const { return line_begin_; }  // in the text
  size_t PositionOf(std::string_view word) const {
    return static_cast<size_t>(word.data() - text_.data());
  }

  // Throws InputError "name:line: found ..., expected ...".
  [[noreturn]] void Fail(const std::string& found, const std::string& expected) const;
  [[noreturn]] void FailAtWord(std::string_view word, const std::string& expected) const;

  // Word `index` as a number; fails, expecting `what`, where it is none or missing.
  double Number(size_t index, const std::string& what) const;

 private:
  std::string_view text_;
  std::string name_;
  size_t at_ = 0, line_begin_ = 0;
  int line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace retarget::io::acclaim
