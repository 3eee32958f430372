// Metrics as rows, for every table that shows them: the terminal's and `retarget compare`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/report/requirement_json.h"

namespace retarget::report {

// One line: what it is called, and how it is read from the metrics of report.json.
struct MetricRow {
  std::string name, unit;
  std::optional<solver::RequirementKind> requirement;  // the checks it answers to; nothing: none
  int figure = -1;                                     // of the figure's checks; -1: of all
  double scale = 1;                                    // from the requirement's unit to this row's
  std::function<double(const Json& metrics)> value;    // NaN: nothing to measure
};
std::vector<MetricRow> MetricRows();

// "pose error a, cm".
std::string LabelOf(const MetricRow& row);
// Whether a value (not NaN) is on the wrong side of the row's limit.
bool Misses(const MetricRow& row, double value, double limit);
// The limit of a row (in its unit) among the requirements of report.json; null where there is none.
Json LimitOf(const MetricRow& row, const Json& requirements);
// "12.34*", the star where the limit is missed; "-" where there is nothing to measure.
std::string MetricCell(const MetricRow& row, const Json& metrics, const Json& limit);
std::string RequiredCell(const MetricRow& row, const Json& limit);
inline constexpr const char* kStarNote = "* misses what is required\n";

// "metric | source | baseline | result | required", one line each, with what is missed marked.
// `baseline` may be null; `last_column` heads the motion that the checks are about.
std::string MetricsTable(const solver::MetricsContext& subject, const solver::Metrics& source,
                         const solver::Metrics* baseline, const solver::Metrics& result,
                         const std::vector<solver::RequirementCheck>& checks,
                         const char* last_column = "result");

}  // namespace retarget::report
