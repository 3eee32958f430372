#include "tools/batch/sweep_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "tools/report/html.h"
#include "tools/report/metrics_table.h"

namespace retarget::batch {
namespace {

using report::EscapeHtml;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kWidth = 264, kHeight = 140, kLeft = 56, kRight = 10, kTop = 8, kBottom = 20;
// A curve that stays within this share of its largest value does not change.
constexpr double kUnchanged = 1e-3;
// Okabe and Ito's colours, which the colour-blind can tell apart.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#7f7f7f"};

struct Curve {
  std::string name;
  std::vector<const IndexRow*> at;  // for each value; null: there is none
};

struct Sweep {
  std::vector<std::string> values;  // as they are written, from small to large
  std::vector<double> x;            // 0 to 1
  std::vector<Curve> curves;
};

double NumberOf(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(number) ? number : kNone;
}

// Numbers where they belong, on a logarithmic axis where they span more than a factor of eight;
// else side by side.
std::vector<double> PlacesOf(const std::vector<std::string>& values) {
  std::vector<double> x;
  for (const std::string& value : values) x.push_back(NumberOf(value));
  const bool numbers = std::none_of(x.begin(), x.end(), [](double v) { return std::isnan(v); });
  if (numbers && x.front() > 0 && x.back() > 8 * x.front()) {
    for (double& v : x) v = std::log(v);
  }
  const double first = x.front(), range = x.back() - first;
  for (size_t k = 0; k < x.size(); ++k) {
    x[k] = numbers && range > 0 ? (x[k] - first) / range
                                : (static_cast<double>(k) + 0.5) / static_cast<double>(x.size());
  }
  return x;
}

// The pair's id but for the swept column.
std::string CurveName(const Pair& pair, const std::string& column) {
  std::string name = pair.row_id;
  for (const std::string& other : pair.swept) {
    if (other != column) name += fmt::format(", {} {}", other, pair.Column(other));
  }
  return name;
}

Sweep SweepOf(const std::vector<IndexRow>& rows, const std::string& column) {
  Sweep sweep;
  std::vector<const IndexRow*> swept;
  for (const IndexRow& row : rows) {
    const auto& names = row.pair.swept;
    if (std::find(names.begin(), names.end(), column) == names.end()) continue;
    swept.push_back(&row);
    const std::string value = row.pair.Column(column);
    if (std::find(sweep.values.begin(), sweep.values.end(), value) == sweep.values.end()) {
      sweep.values.push_back(value);
    }
  }
  const auto is_number = [](const std::string& value) { return !std::isnan(NumberOf(value)); };
  if (std::all_of(sweep.values.begin(), sweep.values.end(), is_number)) {
    std::stable_sort(
        sweep.values.begin(), sweep.values.end(),
        [](const std::string& a, const std::string& b) { return NumberOf(a) < NumberOf(b); });
  }
  sweep.x = PlacesOf(sweep.values);
  for (const IndexRow* row : swept) {
    const std::string name = CurveName(row->pair, column);
    auto curve = std::find_if(sweep.curves.begin(), sweep.curves.end(),
                              [&](const Curve& c) { return c.name == name; });
    if (curve == sweep.curves.end()) {
      sweep.curves.push_back({name, std::vector<const IndexRow*>(sweep.values.size(), nullptr)});
      curve = sweep.curves.end() - 1;
    }
    const auto value =
        std::find(sweep.values.begin(), sweep.values.end(), row->pair.Column(column));
    curve->at[static_cast<size_t>(value - sweep.values.begin())] = row;
  }
  return sweep;
}

double ValueAt(const IndexRow* row, const std::string& label) {
  return row && row->record ? NumberIn(row->record->metrics, label) : kNone;
}

// Of all curves; and whether one of them changes.
struct Range {
  double least = 1e300, most = -1e300;
  bool changes = false;
};

Range RangeOf(const Sweep& sweep, const std::string& label) {
  Range range;
  for (const Curve& curve : sweep.curves) {
    double least = 1e300, most = -1e300;
    for (const IndexRow* row : curve.at) {
      const double value = ValueAt(row, label);
      if (std::isnan(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (least > most) continue;
    range.changes |= most - least > kUnchanged * std::max(std::abs(least), std::abs(most));
    range.least = std::min(range.least, least);
    range.most = std::max(range.most, most);
  }
  return range;
}

double LimitOf(const Sweep& sweep, const std::string& label) {
  for (const Curve& curve : sweep.curves) {
    for (const IndexRow* row : curve.at) {
      const double limit = row && row->record ? NumberIn(row->record->limits, label) : kNone;
      if (!std::isnan(limit)) return limit;
    }
  }
  return kNone;
}

class Plot {
 public:
  Plot(double least, double most) {
    const double margin = 0.06 * (most - least);
    low_ = least - margin;
    high_ = most + margin;
  }
  static double X(double share) { return kLeft + (kWidth - kLeft - kRight) * share; }
  double Y(double value) const {
    return kHeight - kBottom - (kHeight - kTop - kBottom) * (value - low_) / (high_ - low_);
  }
  bool Shows(double value) const { return value >= low_ && value <= high_; }

 private:
  double low_, high_;
};

std::string Text(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"10\" "
      "fill=\"var(--muted)\">{}</text>",
      x, y, anchor, EscapeHtml(text));
}

std::string CurveSvg(const Sweep& sweep, size_t k, const std::string& label, const Plot& plot) {
  const char* colour = kColours[k % std::size(kColours)];
  std::string line, points;
  bool drawing = false;
  for (size_t v = 0; v < sweep.values.size(); ++v) {
    const double value = ValueAt(sweep.curves[k].at[v], label);
    drawing &= !std::isnan(value);
    if (std::isnan(value)) continue;
    const double x = Plot::X(sweep.x[v]), y = plot.Y(value);
    line += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", x, y);
    points += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"><title>{}: {:.4g}</title>"
        "</circle>",
        x, y, colour, EscapeHtml(sweep.values[v]), value);
    drawing = true;
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>{}", line,
                     colour, points);
}

std::string PlotHtml(const Sweep& sweep, const std::string& label, const Range& range) {
  const double limit = LimitOf(sweep, label);
  // The limit is drawn where it is near what is shown.
  const double spread = range.most - range.least;
  double least = range.least, most = range.most;
  if (!std::isnan(limit) && limit > least - 2 * spread && limit < most + 2 * spread) {
    least = std::min(least, limit);
    most = std::max(most, limit);
  }
  const Plot plot(least, most);
  std::string svg =
      fmt::format("<svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">", kWidth, kHeight);
  for (const double value : {least, most}) {
    svg += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"var(--rule)\"/>",
        Plot::X(0), Plot::X(1), plot.Y(value), plot.Y(value));
    svg += Text(kLeft - 4, plot.Y(value) + 3, "end", fmt::format("{:.3g}", value));
  }
  double last = -1e300;
  for (size_t v = 0; v < sweep.values.size(); ++v) {
    const double x = Plot::X(sweep.x[v]);
    if (x - last < 24) continue;
    svg += Text(x, kHeight - 6, "middle", sweep.values[v].substr(0, 12));
    last = x;
  }
  if (!std::isnan(limit) && plot.Shows(limit)) {
    svg += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"var(--bad)\" "
        "stroke-dasharray=\"4 3\"/>",
        Plot::X(0), Plot::X(1), plot.Y(limit), plot.Y(limit));
  }
  for (size_t k = 0; k < sweep.curves.size(); ++k) svg += CurveSvg(sweep, k, label, plot);
  return fmt::format("<figure><figcaption><small>{}</small></figcaption>{}</svg></figure>\n",
                     EscapeHtml(label), svg);
}

}  // namespace

double NumberIn(const report::Json& numbers, const std::string& key) {
  const auto at = numbers.find(key);
  return at != numbers.end() && at->is_number() ? at->get<double>() : kNone;
}

std::string SweepHtml(const std::vector<IndexRow>& rows, const std::string& column) {
  const Sweep sweep = SweepOf(rows, column);
  std::string html = fmt::format("<h2>{}</h2>\n<p class=\"key\">", EscapeHtml(column));
  for (size_t k = 0; k < sweep.curves.size(); ++k) {
    html += fmt::format("<span><i style=\"color: {}\"></i>{}</span>",
                        kColours[k % std::size(kColours)], EscapeHtml(sweep.curves[k].name));
  }
  html += "</p>\n<div class=\"plots\">\n";
  std::string unchanged;
  for (const report::MetricRow& row : report::MetricRows()) {
    const std::string label = LabelOf(row);
    const Range range = RangeOf(sweep, label);
    if (range.changes) {
      html += PlotHtml(sweep, label, range);
    } else if (range.least <= range.most) {
      unchanged += (unchanged.empty() ? "" : "; ") + EscapeHtml(row.name);
    }
  }
  html += "</div>\n";
  if (!unchanged.empty()) html += "<p><small>Does not change: " + unchanged + "</small></p>\n";
  return html;
}

}  // namespace retarget::batch
