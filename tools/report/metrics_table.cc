#include "tools/report/metrics_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/requirement_text.h"

namespace retarget::report {
namespace {

using Kind = solver::RequirementKind;

// NaN: nothing measured, or a report from before the metric.
double Number(const Json& metrics, const char* key) {
  const auto at = metrics.find(key);
  return at != metrics.end() && at->is_number() ? at->get<double>() : std::nan("");
}

std::vector<MetricRow> PairRows() {
  return {{"tangles kept",
           "% of frames",
           {},
           -1,
           1,
           [](const Json& m) { return Number(m, "tangle_kept_percent"); }},
          {"smallest s GLI, also between frames", "turns", Kind::kTangle, -1, 1,
           [](const Json& m) {
             return std::min(Number(m, "smallest_gli"), Number(m, "smallest_gli_between_frames"));
           }},
          {"pass-throughs", "", Kind::kPassThroughs, -1, 1,
           [](const Json& m) { return Number(m, "pass_throughs"); }},
          {"deepest penetration", "cm", Kind::kPenetration, -1, 100,
           [](const Json& m) {
             return 100 *
                    std::max(Number(m, "penetration_m"), Number(m, "penetration_between_frames_m"));
           }},
          {"penetration over 1 cm", "% of frames", Kind::kPenetrationOver1cm, -1, 1,
           [](const Json& m) { return Number(m, "penetration_over_1cm_percent"); }},
          {"hold error", "cm", Kind::kHold, -1, 100, [](const Json& m) {
             const std::vector<double> holds = m.at("hold_m");
             return holds.empty() ? std::nan("")
                                  : 100 * *std::max_element(holds.begin(), holds.end());
           }}};
}

void AddFigureRows(int figure, std::vector<MetricRow>* rows) {
  const char* who = kFigure[figure];
  const auto add = [&](const char* name, const char* unit, std::optional<Kind> requirement,
                       double scale, const char* key) {
    rows->push_back({fmt::format("{} {}", name, who), unit, requirement, figure, scale,
                     [who, scale, key](const Json& m) { return scale * Number(m.at(who), key); }});
  };
  add("foot drift", "cm", Kind::kFootDrift, 100, "foot_drift_m");
  add("foot speed over 1 cm/s", "% of stance", {}, 1, "foot_speed_over_1cm_s_percent");
  add("foot travel near the floor", "cm", Kind::kFootTravel, 100, "near_floor_travel_m");
  add("foot acceleration at contact edges", "m/s^2", Kind::kFootAcceleration, 1,
      "edge_acceleration_m_s2");
  add("gap of holding hands", "cm", {}, 100, "holding_hand_gap_m");
  add("below the floor", "cm", Kind::kFloor, 100, "floor_m");
  add("self-penetration", "cm", {}, 100, "self_penetration_m");
  add("pose error", "cm", {}, 1, "pose_error_cm");
  add("joint edit", "deg", {}, 1, "joint_edit_deg");
  add("jerk, to the larger source", "x", {}, 1, "jerk_ratio_larger");
  add("jerk, to its own source", "x", Kind::kJerk, 1, "jerk_ratio_plausible");
  add("largest pose error", "cm", Kind::kPoseError, 100, "largest_pose_error_m");
  add("tilt of the trunk", "deg", Kind::kTrunkTilt, 1, "trunk_tilt_deg");
  add("floating", "cm", Kind::kFloating, 100, "floating_m");
  add("beyond a joint's range", "deg", Kind::kJointLimit, 1, "beyond_joint_limit_deg");
}

bool Misses(const MetricRow& row, double value, double limit) {
  return row.requirement == Kind::kTangle ? value <= limit : value > limit;
}

}  // namespace

std::vector<MetricRow> MetricRows() {
  std::vector<MetricRow> rows = PairRows();
  for (int f = 0; f < 2; ++f) AddFigureRows(f, &rows);
  return rows;
}

Json LimitOf(const MetricRow& row, const Json& requirements) {
  if (!row.requirement) return nullptr;
  for (const Json& check : requirements) {
    check.at("name").get_ref<const std::string&>();  // else it is no requirement
    const ReadRequirement read = RequirementFromJson(check);
    if (!read.Is(*row.requirement) || (row.figure >= 0 && read.figure != row.figure)) continue;
    return row.scale * check.at("limit").get<double>();
  }
  return nullptr;
}

std::string MetricCell(const MetricRow& row, const Json& metrics, const Json& limit) {
  const double value = row.value(metrics);
  if (std::isnan(value)) return "none ";
  const bool missed = !limit.is_null() && Misses(row, value, limit);
  return fmt::format("{:.2f}{}", value, missed ? "*" : " ");
}

std::string RequiredCell(const MetricRow& row, const Json& limit) {
  if (limit.is_null()) return "";
  return fmt::format("{}{:.2f}",
                     row.requirement == Kind::kTangle ? "> " : "<= ", limit.get<double>());
}

std::string MetricsTable(const solver::MetricsContext& subject, const solver::Metrics& source,
                         const solver::Metrics* baseline, const solver::Metrics& result,
                         const std::vector<solver::RequirementCheck>& checks,
                         const char* last_column) {
  const Json requirements = ChecksJson(checks, subject.body);
  std::vector<std::pair<const char*, Json>> columns = {{"source", MetricsJson(subject, source)}};
  if (baseline) columns.emplace_back("baseline", MetricsJson(subject, *baseline));
  columns.emplace_back(last_column, MetricsJson(subject, result));
  std::string out = fmt::format("{:<36}", "");
  for (const auto& [name, metrics] : columns) out += fmt::format("{:>11} ", name);
  out += fmt::format("{:>11}\n", "required");
  for (const MetricRow& row : MetricRows()) {
    const Json limit = LimitOf(row, requirements);
    out += fmt::format("{:<36}", row.name);
    for (const auto& [name, metrics] : columns) {
      out += fmt::format("{:>12}", MetricCell(row, metrics, limit));
    }
    out += fmt::format("{:>11} {}\n", RequiredCell(row, limit), row.unit);
  }
  if (out.find('*') != std::string::npos) out += kStarNote;
  for (size_t k = 0; k < subject.tangles.size(); ++k) {
    const Tangle& t = subject.tangles[k].tag.tangle;
    out += fmt::format(
        "tag {}: {}: template {:.2f}, smallest {:.3f}{}\n", k + 1,
        TangleText(subject.body[0], subject.body[1], t), t.gli, result.tangles[k].min_signed_gli,
        baseline ? fmt::format(" (baseline {:.3f})", baseline->tangles[k].min_signed_gli) : "");
  }
  for (const solver::RequirementCheck& c : checks) {
    if (c.met) continue;
    const std::string where = WorstPlace(c, subject.body);
    out += fmt::format("MISSED {}: {:.4g} {}, required {:.4g}{}{}\n", NameOf(c), c.value,
                       UnitOf(c.kind), c.limit, where.empty() ? "" : " at ", where);
  }
  return out;
}

}  // namespace retarget::report
