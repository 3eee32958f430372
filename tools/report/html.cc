#include "tools/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace retarget::report {

std::string EscapeHtml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string Humanize(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string WithFrame(const std::string& text, int frame) {
  std::string html = EscapeHtml(text);
  if (frame < 0) return html;
  const std::string words = fmt::format("frame {}", frame);
  const size_t at = html.find(words), end = at + words.size();
  const bool whole = at != std::string::npos &&
                     (end == html.size() || !std::isdigit(static_cast<unsigned char>(html[end])));
  if (!whole) return html;
  return html.replace(at, words.size(),
                      fmt::format("<span data-frame=\"{}\">{}</span>", frame, words));
}

std::string Decimal(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  const std::string text = fmt::format("{:.{}f}", value, digits);
  // A rounded zero has no sign.
  return text.find_first_not_of("-0.") == std::string::npos && text[0] == '-' ? text.substr(1)
                                                                              : text;
}

HtmlTable::HtmlTable(const std::vector<Cell>& head) {
  html_ = "<table>";
  if (!head.empty()) html_ += "<thead><tr>";
  for (const Cell& cell : head) {
    html_ += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>", cell.kind, cell.html);
  }
  html_ += head.empty() ? "<tbody>\n" : "</tr></thead><tbody>\n";
}

void HtmlTable::Row(const std::vector<Cell>& cells, const std::string& attributes) {
  html_ += "<tr" + (attributes.empty() ? "" : " " + attributes) + ">";
  for (size_t k = 0; k < cells.size(); ++k) {
    const char* tag = k == 0 ? "th scope=\"row\"" : "td";
    html_ += fmt::format("<{} class=\"{}\">{}</{}>", tag, cells[k].kind, cells[k].html,
                         k == 0 ? "th" : "td");
  }
  html_ += "</tr>\n";
  ++rows_;
}

std::string HtmlTable::Html() const { return html_ + "</tbody></table>"; }

}  // namespace retarget::report
