// The report page of a program that was built without the one that has players.
#include <fmt/format.h>

#include <algorithm>

#include "tools/report/embedded_page.h"
#include "tools/report/html.h"
#include "tools/report/json_reading.h"
#include "tools/report/page.h"
#include "tools/report/requirement_json.h"
#include "tools/report/svg_plot.h"
#include "tools/report/tables.h"

namespace retarget::report {
namespace {

struct Motion {
  const char *key, *label, *colour, *dash;
};
constexpr Motion kMotions[] = {{"source", "source", "var(--source)", "2 3"},
                               {"baseline", "simulated", "var(--baseline)", "7 3"},
                               {"result", "result", "var(--result)", ""}};

std::vector<double> Numbers(const Json& array) {
  std::vector<double> out;
  for (const Json& v : array) out.push_back(v.is_number() ? v.get<double>() : std::nan(""));
  return out;
}

// Larger of two curves, frame by frame.
std::vector<double> Larger(std::vector<double> one, const std::vector<double>& other) {
  for (size_t k = 0; k < std::min(one.size(), other.size()); ++k) {
    one[k] = std::fmax(one[k], other[k]);
  }
  return one.empty() ? other : one;
}

// A frame's value, the worst of the instants up to the next frame, the next frame's value, ...
std::vector<double> Interleaved(const std::vector<double>& at, const std::vector<double>& between) {
  std::vector<double> out;
  for (size_t t = 0; t < at.size(); ++t) {
    out.push_back(at[t]);
    if (t < between.size()) out.push_back(between[t]);
  }
  return out;
}

// A plot of one line per motion; `curve` takes the values out of a motion's series.
template <typename Curve>
std::string PlotOf(const Json& series, const std::string& title, const std::string& unit,
                   double limit, const Curve& curve, double step = 1) {
  SvgPlot plot;
  plot.step_x = step;
  plot.title = title;
  plot.unit = unit;
  plot.limit = limit;
  for (const Motion& motion : kMotions) {
    const Json& of = At(series, std::string("/") + motion.key);
    if (!of.is_null()) plot.lines.push_back({motion.label, motion.colour, motion.dash, curve(of)});
  }
  return FormatSvg(plot);
}

// The same of what is measured between frames, too.
template <typename Curve>
std::string InstantsPlotOf(const Json& series, const std::string& title, const std::string& unit,
                           double limit, const Curve& curve) {
  return PlotOf(
      series, title, unit, limit,
      [&](const Json& m) { return Interleaved(curve(m), curve(At(m, "/between"))); }, 0.5);
}

std::string CostPlot(const Json& report) {
  SvgPlot plot{
      "Cost", "per iteration, logarithmic", {{"total", "var(--ink)", "", {}}}, 1, std::nan(""),
      true};
  for (const Json& step : At(report, "/solve/history")) {
    plot.lines[0].values.push_back(NumberAt(step, "/cost"));
  }
  return plot.lines[0].values.empty() ? "" : FormatSvg(plot);
}

std::string PlotsHtml(const Json& report, const Json& series) {
  using Kind = solver::RequirementKind;
  const std::vector<ReadRequirement> requirements = RequirementsOf(report);
  const auto limit = [&](Kind kind, double scale, int item = -1) {
    return scale * LimitOf(requirements, kind, -1, item);
  };
  std::string out;
  const size_t tags = At(series, "/result/tangles").size();
  for (size_t k = 0; k < tags; ++k) {
    out += InstantsPlotOf(series, fmt::format("Tag {}: s GLI", k + 1), "turns, by frame",
                          limit(Kind::kTangle, 1, static_cast<int>(k)), [k](const Json& m) {
                            return Numbers(At(m, fmt::format("/tangles/{}", k)));
                          });
  }
  const auto both = [](const char* key) {
    const std::string at = std::string("/") + key;
    return [at](const Json& m) {
      return Larger(Numbers(At(m, at + "/a")), Numbers(At(m, at + "/b")));
    };
  };
  out += InstantsPlotOf(series, "Penetration between the bodies", "cm, by frame",
                        limit(Kind::kPenetration, 100),
                        [](const Json& m) { return Numbers(At(m, "/penetration_cm")); });
  if (!At(series, "/result/hold_cm").empty()) {
    out += InstantsPlotOf(series, "Hold error", "cm, by frame", limit(Kind::kHold, 100),
                          [](const Json& m) {
                            std::vector<double> largest;
                            for (const Json& hold : At(m, "/hold_cm")) {
                              largest = Larger(largest, Numbers(hold));
                            }
                            return largest;
                          });
  }
  out += PlotOf(series, "Speed of planted feet", "cm/s, larger of a and b, by frame", std::nan(""),
                both("foot_speed_cm_s"));
  out += InstantsPlotOf(series, "Below the floor", "cm, by frame", limit(Kind::kFloor, 100),
                        both("floor_cm"));
  out += PlotOf(series, "Penetration of a body with itself", "cm, by frame", std::nan(""),
                both("self_penetration_cm"));
  return out + CostPlot(report);
}

}  // namespace

std::string FormatPlainPage(const Json& report, const Json& series) {
  const std::string_view theme = EmbeddedThemeCss(), style = EmbeddedReportCss();
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n<title>retarget report</title>\n"
         "<style>" +
         std::string(theme) + std::string(style) + "</style>\n</head>\n<body>\n" +
         VerdictHtml(report) +
         "<p class=\"unit\">This program was built without players (RETARGET_STUDIO=OFF): "
         "scene.glb "
         "and source.glb open in any glTF viewer.</p>\n<main>\n<section class=\"charts\">\n" +
         PlotsHtml(report, series) + "</section>\n" + TablesHtml(report) +
         "</main>\n</body>\n</html>\n";
}

}  // namespace retarget::report
