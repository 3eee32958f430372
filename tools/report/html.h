// Pieces of a page: escaped text and tables.
#pragma once

#include <string>
#include <vector>

namespace retarget::report {

// & < > and quotes as entities.
std::string EscapeHtml(const std::string& text);

// left_hand -> left hand.
std::string Humanize(std::string name);

// Escaped; of a frame that the text names ("frame 12"), the words become a span with
// data-frame="12", which the page turns into a jump. -1: none.
std::string WithFrame(const std::string& text, int frame);

// A number with `digits` decimals; an en dash where there is none (NaN).
std::string Decimal(double value, int digits);

struct Cell {
  std::string html;
  const char* kind = "";  // class of the cell: "number", "number bad", "unit", ...
};

class HtmlTable {
 public:
  explicit HtmlTable(const std::vector<Cell>& head);
  void Row(const std::vector<Cell>& cells, const std::string& attributes = "");
  bool empty() const { return rows_ == 0; }
  std::string Html() const;

 private:
  std::string html_;
  int rows_ = 0;
};

}  // namespace retarget::report
