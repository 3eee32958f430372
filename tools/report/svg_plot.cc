#include "tools/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/html.h"

namespace retarget::report {
namespace {

constexpr double kWidth = 620, kHeight = 180, kLeft = 46, kRight = 8, kTop = 8, kBottom = 22;

struct Axes {
  double low = 0, high = 1;              // of y, as drawn
  double first = 0, last = 1, step = 1;  // of x
  bool logarithmic = false;

  double Drawn(double y) const { return logarithmic ? std::log10(std::max(y, 1e-300)) : y; }
  double X(double x) const {
    return kLeft + (kWidth - kLeft - kRight) * (x - first) / std::max(1e-9, last - first);
  }
  double Y(double y) const {
    const double part = (Drawn(y) - low) / std::max(1e-12, high - low);
    return kHeight - kBottom - (kHeight - kTop - kBottom) * std::clamp(part, 0.0, 1.0);
  }
};

Axes AxesOf(const SvgPlot& plot) {
  Axes axes;
  axes.logarithmic = plot.logarithmic;
  double least = 1e300, most = -1e300;
  size_t count = 1;
  for (const SvgLine& line : plot.lines) {
    count = std::max(count, line.values.size());
    for (const double v : line.values) {
      if (!std::isfinite(v) || (plot.logarithmic && v <= 0)) continue;
      least = std::min(least, v);
      most = std::max(most, v);
    }
  }
  if (least > most) least = most = 0;
  if (std::isfinite(plot.limit)) most = std::max(most, plot.limit);
  axes.first = plot.first_x;
  axes.step = plot.step_x;
  axes.last = plot.first_x + plot.step_x * static_cast<double>(count - 1);
  if (plot.logarithmic) {
    axes.low = std::floor(axes.Drawn(std::max(least, 1e-4 * most)));
    axes.high = std::max(axes.low + 1, std::ceil(axes.Drawn(most)));
  } else {
    axes.low = std::min(0.0, 1.1 * least);
    axes.high = most > axes.low ? axes.low + 1.12 * (most - axes.low) : axes.low + 1;
  }
  return axes;
}

// A step of 1, 2 or 5 times a power of ten that makes about `wanted` of `range`.
double Step(double range, double wanted) {
  const double power = std::pow(10, std::floor(std::log10(range / wanted)));
  for (const double m : {1.0, 2.0, 5.0}) {
    if (m * power * wanted >= range) return m * power;
  }
  return 10 * power;
}

std::string Text(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"11\" "
      "fill=\"var(--muted)\">{}</text>\n",
      x, y, anchor, text);
}

std::string Rule(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" style=\"{}\"/>\n", x1, y1, x2,
      y2, style);
}

std::string GridSvg(const Axes& axes) {
  std::string out;
  const double step = axes.logarithmic ? 1 : Step(axes.high - axes.low, 4);
  for (double k = std::ceil(axes.low / step); k * step <= axes.high + 1e-9; ++k) {
    const double value = axes.logarithmic ? std::pow(10, k) : k * step;
    const double y = axes.Y(value);
    out += Rule(kLeft, y, kWidth - kRight, y, "stroke:var(--rule)");
    out += Text(kLeft - 6, y + 4, "end", fmt::format("{:.4g}", value + 0.0));
  }
  const double frames = std::max(1.0, Step(std::max(1.0, axes.last - axes.first), 8));
  for (double x = std::ceil(axes.first / frames) * frames; x <= axes.last; x += frames) {
    out += Text(axes.X(x), kHeight - 6, "middle", fmt::format("{:.0f}", x));
  }
  return out;
}

// One polyline per run of numbers.
std::string LineSvg(const Axes& axes, const SvgLine& line) {
  std::string out, points;
  const auto finish = [&] {
    if (!points.empty()) {
      out += fmt::format(
          "<polyline points=\"{}\" style=\"fill:none;stroke:{};stroke-width:2;stroke-dasharray:{};"
          "stroke-linejoin:round\"/>\n",
          points, line.colour, line.dash.empty() ? "none" : line.dash);
    }
    points.clear();
  };
  for (size_t k = 0; k < line.values.size(); ++k) {
    const double v = line.values[k];
    if (!std::isfinite(v) || (axes.logarithmic && v <= 0)) {
      finish();
      continue;
    }
    points += fmt::format("{:.1f},{:.1f} ", axes.X(axes.first + axes.step * static_cast<double>(k)),
                          axes.Y(v));
  }
  finish();
  return out;
}

}  // namespace

std::string FormatSvg(const SvgPlot& plot) {
  const Axes axes = AxesOf(plot);
  std::string key, curves;
  for (const SvgLine& line : plot.lines) {
    key += fmt::format(
        "<span><svg class=\"swatch\" viewBox=\"0 0 22 8\" style=\"display:inline\"><line x1=\"0\" "
        "y1=\"4\" x2=\"22\" y2=\"4\" "
        "style=\"stroke:{};stroke-width:2;stroke-dasharray:{}\"/></svg> "
        "{}</span>",
        line.colour, line.dash.empty() ? "none" : line.dash, EscapeHtml(line.label));
    curves += LineSvg(axes, line);
  }
  const double y = axes.Y(plot.limit);
  const std::string limit =
      std::isfinite(plot.limit)
          ? Rule(kLeft, y, kWidth - kRight, y, "stroke:var(--bad);stroke-dasharray:5 3")
          : "";
  return fmt::format(
      "<figure class=\"plot\"><figcaption><h3>{0} <small>{1}</small></h3><p class=\"key\">{2}</p>"
      "</figcaption><svg viewBox=\"0 0 {3} {4}\" role=\"img\" aria-label=\"{0}\">\n{5}{6}{7}</svg>"
      "</figure>\n",
      EscapeHtml(plot.title), EscapeHtml(plot.unit), key, kWidth, kHeight, GridSvg(axes), limit,
      curves);
}

}  // namespace retarget::report
