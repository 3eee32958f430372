#include "io/acclaim/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/text/cursor.h"
#include "io/text/quoted.h"
#include "model/geometry/types.h"

namespace retarget::io::acclaim {
namespace {

bool Separates(char c) { return bvh::IsBlank(c) || c == ',' || c == '(' || c == ')'; }

}  // namespace

LineReader::LineReader(std::string_view text, std::string name)
    : text_(text), name_(std::move(name)) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark
}

bool LineReader::Next() {
  words_.clear();
  while (at_ < text_.size() && words_.empty()) {
    ++line_;
    line_begin_ = at_;
    const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    const std::string_view code = line.substr(0, line.find('#'));
    for (size_t k = 0; k < code.size();) {
      const size_t begin = k;
      while (k < code.size() && !Separates(code[k])) ++k;
      if (k > begin) words_.push_back(code.substr(begin, k - begin));
      while (k < code.size() && Separates(code[k])) ++k;
    }
    at_ = end;
    if (text_.substr(at_).starts_with("\r\n")) ++at_;
    if (at_ < text_.size()) ++at_;
  }
  return !words_.empty();
}

void LineReader::Fail(const std::string& found, const std::string& expected) const {
  throw InputError(
      fmt::format("{}:{}: found {}, expected {}", name_, std::max(line_, 1), found, expected));
}

void LineReader::FailAtWord(std::string_view word, const std::string& expected) const {
  Fail(QuotedWord(word), expected);
}

double LineReader::Number(size_t index, const std::string& what) const {
  if (index >= words_.size()) {
    Fail(words_.empty() ? "the end of the file" : "the end of the line", what);
  }
  double value = 0;
  switch (bvh::ParseNumber(words_[index], &value)) {
    case bvh::NumberFault::kNone:
      break;
    case bvh::NumberFault::kNotANumber:
      FailAtWord(words_[index], what);
    case bvh::NumberFault::kNotFinite:
      FailAtWord(words_[index], "a finite number");
    case bvh::NumberFault::kTooLarge:
      FailAtWord(words_[index], fmt::format("a number of at most {:g}", bvh::kMaxNumber));
  }
  return value;
}

}  // namespace retarget::io::acclaim
