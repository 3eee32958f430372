#include "tools/report/gallery_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/comparison_tables.h"
#include "tools/report/embedded_page.h"
#include "tools/report/html.h"
#include "tools/report/json_reading.h"

namespace retarget::report {
namespace {

// Larger of a's and b's.
double OfBoth(const Json& metrics, const std::string& key) {
  return std::fmax(NumberAt(metrics, "/a/" + key), NumberAt(metrics, "/b/" + key));
}

double HoldError(const Json& metrics) {
  double largest = std::nan("");
  for (const Json& h : At(metrics, "/hold_m")) {
    if (h.is_number()) largest = std::fmax(largest, 100 * h.get<double>());
  }
  return largest;
}

// Of the summary: a head, and what a motion's metrics say.
struct Column {
  const char *head, *unit;
  int digits;
  double (*value)(const Json& metrics);
};
constexpr Column kColumns[] = {
    {"kept", "% of frames", 1, [](const Json& m) { return NumberAt(m, "/tangle_kept_percent"); }},
    {"smallest s GLI", "turns", 2,
     [](const Json& m) {
       return std::fmin(NumberAt(m, "/smallest_gli"), NumberAt(m, "/smallest_gli_between_frames"));
     }},
    {"pass-throughs", "", 0, [](const Json& m) { return NumberAt(m, "/pass_throughs"); }},
    {"penetration", "cm", 2, [](const Json& m) { return 100 * NumberAt(m, "/penetration_m"); }},
    {"hold error", "cm", 2, HoldError},
    {"foot drift", "cm", 2, [](const Json& m) { return 100 * OfBoth(m, "foot_drift_m"); }},
    {"feet over 1 cm/s", "% of stance", 1,
     [](const Json& m) { return OfBoth(m, "foot_speed_over_1cm_s_percent"); }},
    {"pose error", "cm", 1, [](const Json& m) { return OfBoth(m, "pose_error_cm"); }},
    {"jerk", "x source", 2, [](const Json& m) { return OfBoth(m, "jerk_ratio_larger"); }}};

bool Met(const Json& report) { return report.value("requirements_met", false); }

std::string SummaryHtml(const std::vector<GalleryEntry>& entries) {
  std::vector<Cell> head = {{"hold"}, {""}, {"tags", "number"}};
  for (const Column& c : kColumns) {
    head.push_back({fmt::format("{}<br><small>{}</small>", c.head, c.unit), "number"});
  }
  head.push_back({"solve<br><small>frames/s</small>", "number"});
  HtmlTable table(head);
  for (const GalleryEntry& entry : entries) {
    for (const char* motion : {"result", "baseline"}) {
      const bool result = motion[0] == 'r';
      const Json& metrics = At(entry.report, std::string("/metrics/") + motion);
      if (metrics.is_null()) continue;
      std::vector<Cell> cells;
      if (result) {
        cells.push_back({fmt::format("<a href=\"#{0}\">{1}</a>", EscapeHtml(entry.name),
                                     EscapeHtml(Humanize(entry.name)))});
        cells.push_back({Met(entry.report) ? "result: every requirement met"
                                           : "result: a requirement is missed ✕",
                         Met(entry.report) ? "" : "bad"});
        cells.push_back({fmt::format("{}", At(entry.report, "/tangles").size()), "number"});
      } else {
        cells = {{""}, {"simulated"}, {""}};
      }
      for (const Column& c : kColumns) {
        cells.push_back({Decimal(c.value(metrics), c.digits), "number"});
      }
      cells.push_back(
          {result ? Decimal(NumberAt(entry.report, "/timings/frames_per_s"), 0) : "", "number"});
      table.Row(cells, result ? "class=\"result\"" : "class=\"simulated\"");
    }
  }
  return "<div class=\"scroll\">" + table.Html() + "</div>";
}

// Paragraphs at blank lines; the rest of Markdown stays as it is.
std::string Paragraphs(const std::string& text) {
  std::string out;
  for (size_t first = 0; first < text.size();) {
    const size_t end = std::min(text.find("\n\n", first), text.size());
    const std::string paragraph = text.substr(first, end - first);
    if (paragraph.find_first_not_of(" \n\t") != std::string::npos) {
      out += "<p>" + EscapeHtml(paragraph) + "</p>";
    }
    first = end + 2;
  }
  return out;
}

std::string EntryHtml(const GalleryEntry& entry) {
  const std::string name = EscapeHtml(entry.name);
  const std::string title = TextAt(entry.report, "/inputs/template/name");
  return fmt::format(
      "<section id=\"{0}\">\n<h2>{1}</h2>\n{2}"
      "<p><a href=\"{0}/report.html\">Report with players</a> · <a href=\"{0}/scene.glb\">scene.glb"
      "</a></p>\n<img src=\"{0}/strip.png\" loading=\"lazy\" alt=\"{1}: rows are source, simulated "
      "and solved; columns are the start, the middle from two sides, and the end\">\n"
      "<details><summary>All metrics</summary><div class=\"scroll\">{3}{4}{5}</div></details>\n"
      "</section>\n",
      name, EscapeHtml(title.empty() ? Humanize(entry.name) : title), Paragraphs(entry.text),
      MetricsTableHtml(entry.report), TagsTableHtml(entry.report), HoldsTableHtml(entry.report));
}

constexpr const char* kStyle = R"(
section { margin-top: 36px; }
section p { max-width: 76ch; margin: 6px 0; color: var(--muted); }
section img { display: block; max-width: 100%; height: auto; margin: 12px 0; border: 1px solid var(--rule); }
.scroll { overflow-x: auto; margin: 14px 0; }
tr.simulated td { color: var(--muted); }
tr.result td { border-bottom: 0; }
td.bad { color: var(--bad); }
)";

}  // namespace

std::string FormatGallery(const std::vector<GalleryEntry>& entries) {
  const long met = std::count_if(entries.begin(), entries.end(),
                                 [](const GalleryEntry& e) { return Met(e.report); });
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Holds</title>\n<style>";
  html += EmbeddedThemeCss();
  html += kStyle;
  html += fmt::format(
      "</style>\n</head>\n<body>\n<h1>Holds</h1>\n<p>Two clips each, captured alone, joined by one "
      "command with the default settings. {} of {} meet every requirement.</p>\n",
      met, entries.size());
  html += SummaryHtml(entries);
  for (const GalleryEntry& entry : entries) html += EntryHtml(entry);
  return html + "</body>\n</html>\n";
}

std::string GalleryLine(const Json& report) {
  const Json &result = At(report, "/metrics/result"), &baseline = At(report, "/metrics/baseline");
  return fmt::format(
      "{:<7} {} tags, s GLI {:.2f} (simulated {:.2f}), penetration {:.2f} cm, hold {:.2f} cm, pose "
      "{:.1f} cm, {:.0f} frames/s",
      Met(report) ? "met" : "MISSED", At(report, "/tangles").size(), kColumns[1].value(result),
      kColumns[1].value(baseline), kColumns[3].value(result), HoldError(result),
      OfBoth(result, "pose_error_cm"), NumberAt(report, "/timings/frames_per_s"));
}

}  // namespace retarget::report
