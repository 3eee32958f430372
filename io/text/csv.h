// Comma-separated values (RFC 4180): cells in quotes may hold commas, line breaks and doubled
// quotes.
#pragma once

#include <string>
#include <vector>

namespace retarget::io {

struct CsvRow {
  int line = 0;  // where it begins, from 1
  std::vector<std::string> cells;
};

// The rows of `text`, without those that are blank; `name` stands for the file in messages. Blanks
// round a cell that is not in quotes are dropped. Throws InputError
//   name:line: a quote is not closed
//   name:line: found text after a closing quote, expected a comma
std::vector<CsvRow> ParseCsv(const std::string& text, const std::string& name);

// `text` as a cell, in quotes where it needs them.
std::string CsvCell(const std::string& text);

}  // namespace retarget::io
