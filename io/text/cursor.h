// The text of a BVH file as words, lines and numbers. Inner part of io/bvh/bvh.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace retarget::io::bvh {

// No position in any unit and no angle is larger; beyond it squares and sums lose their meaning.
inline constexpr double kMaxNumber = 1e9;

inline bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
inline bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }
inline bool IsSpace(char c) { return IsBlank(c) || IsLineEnd(c); }

// Equal but for case.
bool SameWord(std::string_view a, std::string_view b);

std::string_view Trimmed(std::string_view s);

enum class NumberFault { kNone, kNotANumber, kNotFinite, kTooLarge };
NumberFault ParseNumber(std::string_view token, double* value);

// A place in the text: words, lines and the message that names the line.
class Cursor {
 public:
  Cursor(std::string_view text, std::string name);

  // Throws InputError "name:line: found ..., expected ...", with the line of the last word or line.
  [[noreturn]] void Fail(const std::string& found, const std::string& expected) const;
  [[noreturn]] void FailAtToken(std::string_view token, const std::string& expected) const;

  // The next word on this or a later line; a brace is a word of its own. Empty at the end.
  std::string_view Next();

  // The next word, left in place.
  std::string_view Peek() const;

  // What is left of this line, without its end.
  std::string_view RestOfLine();

  // The rest of the line as a name, which may hold blanks; up to an opening brace, which is left.
  std::string_view RestAsName();

  // The next line that is not blank; false at the end of the text.
  bool NextLine(std::string_view* line);

  // The token as a number; fails, expecting `what`, where it is none.
  double Number(std::string_view token, const char* what) const;

  size_t position() const { return at_; }
  int line() const { return token_line_; }

 private:
  static bool IsBrace(char c) { return c == '{' || c == '}'; }

  // Over one character; over both of CR LF. A lone CR ends a line too.
  void Step();

  std::string_view text_;
  std::string name_;
  size_t at_ = 0;
  int line_ = 1, token_line_ = 1;
};

}  // namespace retarget::io::bvh
