#include "io/text/csv.h"

#include <fmt/format.h>

#include "model/geometry/types.h"

namespace retarget::io {
namespace {

std::string Trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

class CsvReader {
 public:
  CsvReader(const std::string& text, const std::string& name) : text_(text), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
  }

  std::vector<CsvRow> Read() {
    std::vector<CsvRow> rows;
    while (at_ < text_.size()) {
      CsvRow row{line_, {}};
      do {
        row.cells.push_back(Cell());
      } while (Take(','));
      Take('\n');
      if (row.cells.size() > 1 || !row.cells[0].empty()) rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  bool Take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    if (c == '\n') ++line_;
    return true;
  }

  std::string Cell() {
    const size_t first = text_.find_first_not_of(" \t", at_);
    if (first != std::string::npos && text_[first] == '"') {
      at_ = first + 1;
      return Quoted();
    }
    const size_t end = std::min(text_.find_first_of(",\n", at_), text_.size());
    const std::string cell = Trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return cell;
  }

  std::string Quoted() {
    const int begin = line_;
    std::string cell;
    for (;;) {
      if (at_ >= text_.size()) {
        throw InputError(fmt::format("{}:{}: a quote is not closed", name_, begin));
      }
      if (Take('"')) {
        if (!Take('"')) break;
        cell += '"';
        continue;
      }
      if (text_[at_] == '\n') ++line_;
      cell += text_[at_++];
    }
    const size_t end = std::min(text_.find_first_of(",\n", at_), text_.size());
    if (!Trimmed(text_.substr(at_, end - at_)).empty()) {
      throw InputError(
          fmt::format("{}:{}: found text after a closing quote, expected a comma", name_, line_));
    }
    at_ = end;
    return cell;
  }

  const std::string& text_;
  const std::string& name_;
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<CsvRow> ParseCsv(const std::string& text, const std::string& name) {
  return CsvReader(text, name).Read();
}

std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos && Trimmed(text) == text) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

}  // namespace retarget::io
