#include "io/text/cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "io/text/quoted.h"
#include "model/geometry/types.h"

namespace retarget::io::bvh {

bool SameWord(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::tolower(static_cast<unsigned char>(x)) ==
                  std::tolower(static_cast<unsigned char>(y));
         });
}

std::string_view Trimmed(std::string_view s) {
  while (!s.empty() && IsSpace(s.front())) s.remove_prefix(1);
  while (!s.empty() && IsSpace(s.back())) s.remove_suffix(1);
  return s;
}

NumberFault ParseNumber(std::string_view token, double* value) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, *value);
  if (stop != end || error == std::errc::invalid_argument) return NumberFault::kNotANumber;
  if (error == std::errc::result_out_of_range) {  // too large, or too close to zero
    *value = std::strtod(std::string(token).c_str(), nullptr);
    if (std::abs(*value) > 1) return NumberFault::kTooLarge;
  }
  if (!std::isfinite(*value)) return NumberFault::kNotFinite;
  return std::abs(*value) > kMaxNumber ? NumberFault::kTooLarge : NumberFault::kNone;
}

Cursor::Cursor(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark
}

void Cursor::Fail(const std::string& found, const std::string& expected) const {
  throw InputError(
      fmt::format("{}:{}: found {}, expected {}", name_, token_line_, found, expected));
}

void Cursor::FailAtToken(std::string_view token, const std::string& expected) const {
  Fail(token.empty() ? "the end of the file" : QuotedWord(token), expected);
}

std::string_view Cursor::Next() {
  while (at_ < text_.size() && IsSpace(text_[at_])) Step();
  token_line_ = line_;
  const size_t begin = at_;
  if (at_ < text_.size() && IsBrace(text_[at_])) ++at_;
  if (at_ == begin) {
    while (at_ < text_.size() && !IsSpace(text_[at_]) && !IsBrace(text_[at_])) ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view Cursor::Peek() const {
  Cursor copy = *this;
  return copy.Next();
}

std::string_view Cursor::RestOfLine() {
  const size_t begin = at_;
  while (at_ < text_.size() && !IsLineEnd(text_[at_])) ++at_;
  token_line_ = line_;
  return text_.substr(begin, at_ - begin);
}

std::string_view Cursor::RestAsName() {
  std::string_view rest = RestOfLine();
  if (const size_t brace = rest.find('{'); brace != std::string_view::npos) {
    at_ -= rest.size() - brace;
    rest = rest.substr(0, brace);
  }
  return Trimmed(rest);
}

bool Cursor::NextLine(std::string_view* line) {
  while (at_ < text_.size()) {
    *line = Trimmed(RestOfLine());
    if (at_ < text_.size()) Step();
    if (!line->empty()) return true;
  }
  token_line_ = line_;
  *line = {};
  return false;
}

double Cursor::Number(std::string_view token, const char* what) const {
  double value = 0;
  switch (ParseNumber(token, &value)) {
    case NumberFault::kNone:
      return value;
    case NumberFault::kNotANumber:
      FailAtToken(token, what);
    case NumberFault::kNotFinite:
      FailAtToken(token, "a finite number");
    case NumberFault::kTooLarge:
      FailAtToken(token, fmt::format("a number of at most {:g}", kMaxNumber));
  }
  return value;
}

void Cursor::Step() {
  const char c = text_[at_++];
  if (c == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
  if (IsLineEnd(c)) ++line_;
}

}  // namespace retarget::io::bvh
