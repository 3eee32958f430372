// Plots that stand still, as inline SVG: for pages without a script.
#pragma once

#include <string>
#include <vector>

namespace retarget::report {

struct SvgLine {
  std::string label, colour, dash;  // colour and dash as CSS writes them
  std::vector<double> values;       // NaN: a gap
};

struct SvgPlot {
  std::string title, unit;
  std::vector<SvgLine> lines;
  double first_x = 0;  // of the first value
  double step_x = 1;   // to the next
  double limit;        // a dashed line; NaN for none
  bool logarithmic = false;
};

std::string FormatSvg(const SvgPlot& plot);

}  // namespace retarget::report
