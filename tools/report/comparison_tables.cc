#include "tools/report/comparison_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "tools/report/html.h"
#include "tools/report/json_reading.h"
#include "tools/report/requirement_json.h"

namespace retarget::report {
namespace {

using Kind = solver::RequirementKind;

constexpr const char* kMotions[3] = {"source", "baseline", "result"};
constexpr const char* kHeads[3] = {"source", "simulated", "result"};

// A row of the metrics: what, unit, decimals, value of a motion's metrics, and the requirement that
// limits it (nothing for none), of a figure where it is not -1.
struct MetricRow {
  std::string label, unit;
  int digits;
  std::function<double(const Json& metrics)> value;
  std::optional<Kind> requirement = std::nullopt;
  int figure = -1;
  bool at_least() const { return requirement == Kind::kTangle; }
};

MetricRow Plain(const char* label, const char* unit, int digits, const std::string& pointer,
                double scale, std::optional<Kind> requirement = {}, int figure = -1) {
  return {label,       unit,
          digits,      [pointer, scale](const Json& m) { return scale * NumberAt(m, pointer); },
          requirement, figure};
}

double Larger(const Json& m, const char* one, const char* other, double sign) {
  const double x = NumberAt(m, one), y = NumberAt(m, other);
  return std::isnan(y) ? x : sign * std::max(sign * x, sign * y);
}

std::vector<MetricRow> MetricRows() {
  std::vector<MetricRow> rows = {
      {"tangles kept", "% of frames", 1,
       [](const Json& m) { return NumberAt(m, "/tangle_kept_percent"); }},
      {"smallest s GLI", "turns", 2,
       [](const Json& m) { return Larger(m, "/smallest_gli", "/smallest_gli_between_frames", -1); },
       Kind::kTangle},
      Plain("pass-throughs", "", 0, "/pass_throughs", 1, Kind::kPassThroughs),
      {"deepest penetration", "cm", 2,
       [](const Json& m) {
         return 100 * Larger(m, "/penetration_m", "/penetration_between_frames_m", 1);
       },
       Kind::kPenetration},
      Plain("penetration over 1 cm", "% of frames", 1, "/penetration_over_1cm_percent", 1,
            Kind::kPenetrationOver1cm),
      {"largest hold error", "cm", 2,
       [](const Json& m) {
         double largest = std::nan("");
         for (const Json& h : At(m, "/hold_m")) {
           if (h.is_number()) largest = std::fmax(largest, 100 * h.get<double>());
         }
         return largest;
       },
       Kind::kHold},
  };
  for (int f = 0; f < 2; ++f) {
    const std::string who = kFigure[f];
    const auto add = [&](const char* label, const char* unit, int digits, const char* key,
                         double scale, std::optional<Kind> requirement = {}) {
      rows.push_back(Plain(label, unit, digits, "/" + who + "/" + key, scale, requirement, f));
      rows.back().label += " " + who;
    };
    add("foot drift,", "cm", 2, "foot_drift_m", 100, Kind::kFootDrift);
    add("fastest planted foot,", "cm/s", 1, "foot_speed_max_m_s", 100);
    add("foot faster than 1 cm/s,", "% of stance", 1, "foot_speed_over_1cm_s_percent", 1);
    add("foot travel near the floor,", "cm", 1, "near_floor_travel_m", 100, Kind::kFootTravel);
    add("foot acceleration at contact edges,", "m/s²", 1, "edge_acceleration_m_s2", 1,
        Kind::kFootAcceleration);
    add("gap of holding hands,", "cm", 1, "holding_hand_gap_m", 100);
    add("below the floor,", "cm", 2, "floor_m", 100, Kind::kFloor);
    add("self-penetration,", "cm", 2, "self_penetration_m", 100);
    add("pose error,", "cm", 2, "pose_error_cm", 1);
    add("joint edit,", "degrees", 2, "joint_edit_deg", 1);
    add("jerk, to the larger source,", "x", 2, "jerk_ratio_larger", 1);
  }
  return rows;
}

// The limit that a report sets; NaN for none. Lengths in cm.
double Limit(const Json& report, std::optional<Kind> kind, int figure = -1) {
  if (!kind) return std::nan("");
  for (const ReadRequirement& r : RequirementsOf(report)) {
    if (!r.Is(*kind) || (figure >= 0 && r.figure != figure)) continue;
    return r.limit * (r.unit == "m" ? 100 : 1);
  }
  return std::nan("");
}

std::string FrameHtml(int frame) { return WithFrame(fmt::format("frame {}", frame), frame); }

Cell Judged(double value, int digits, bool bad) {
  return {Decimal(value, digits) + (bad ? " ✕" : ""), bad ? "number bad" : "number"};
}

}  // namespace

std::string MetricsTableHtml(const Json& report) {
  HtmlTable table({{""},
                   {kHeads[0], "number"},
                   {kHeads[1], "number"},
                   {kHeads[2], "number"},
                   {"allowed", "number"},
                   {""}});
  for (const MetricRow& row : MetricRows()) {
    const double limit = Limit(report, row.requirement, row.figure);
    std::vector<Cell> cells = {{row.label}};
    bool known = false;
    for (const char* motion : kMotions) {
      const double value = row.value(At(report, std::string("/metrics/") + motion));
      known = known || !std::isnan(value);
      cells.push_back(Judged(value, row.digits, row.at_least() ? value <= limit : value > limit));
    }
    if (!known) continue;
    cells.push_back(
        {std::isnan(limit) ? "" : (row.at_least() ? "> " : "") + Decimal(limit, row.digits),
         "number unit"});
    cells.push_back({row.unit, "unit"});
    table.Row(cells);
  }
  return table.Html();
}

std::string TagsTableHtml(const Json& report) {
  HtmlTable table({{"tag"},
                   {"path on a"},
                   {"path on b"},
                   {"in the template", "number"},
                   {"robustness ρ", "number"},
                   {"smallest s GLI: source", "number"},
                   {"simulated", "number"},
                   {"result", "number"},
                   {"frames lost: source", "number"},
                   {"simulated", "number"},
                   {"result", "number"},
                   {"tightest"}});
  const Json& tags = At(report, "/tangles");
  const double limit = Limit(report, Kind::kTangle);
  for (size_t k = 0; k < tags.size(); ++k) {
    const auto path = [&](const char* figure) {
      const std::string at = std::string("/") + figure;
      return Cell{
          EscapeHtml(Humanize(TextAt(tags[k], at + "/0") + " … " + TextAt(tags[k], at + "/1")))};
    };
    std::vector<Cell> cells = {{std::to_string(k + 1)},
                               path("a"),
                               path("b"),
                               {Decimal(NumberAt(tags[k], "/template_gli"), 2), "number"},
                               {Decimal(NumberAt(tags[k], "/rho"), 2), "number"}};
    const auto of = [&](const char* motion, const char* key) {
      return NumberAt(report, fmt::format("/metrics/{}/tangles/{}/{}", motion, k, key));
    };
    for (const char* motion : kMotions) {
      const double value =
          std::fmin(of(motion, "min_signed_gli"), of(motion, "min_signed_gli_between_frames"));
      cells.push_back(Judged(value, 2, value <= limit));
    }
    for (const char* motion : kMotions) {
      const double lost = of(motion, "frames_below_half");
      cells.push_back(Judged(lost, 0, lost > 0));
    }
    const double worst = of("result", "worst_frame");
    cells.push_back({std::isnan(worst) ? "" : FrameHtml(static_cast<int>(worst))});
    table.Row(cells, fmt::format("data-tag=\"{}\"", k));
  }
  return table.empty() ? "" : table.Html();
}

std::string HoldsTableHtml(const Json& report) {
  HtmlTable table({{"hold"},
                   {"held together"},
                   {"source, cm", "number"},
                   {"simulated", "number"},
                   {"result", "number"},
                   {"worst"}});
  const Json& holds = At(report, "/holds");
  const double limit = Limit(report, Kind::kHold);
  const auto point = [](const Json& p) {
    const std::string figure = TextAt(p, "/figure");
    return figure == "world" ? "the world" : figure + " " + Humanize(TextAt(p, "/node"));
  };
  for (size_t k = 0; k < holds.size(); ++k) {
    std::vector<Cell> cells = {
        {std::to_string(k + 1)},
        {EscapeHtml(point(At(holds[k], "/from")) + " – " + point(At(holds[k], "/to")) +
                    (At(holds[k], "/rotation") == true ? ", with its rotation" : ""))}};
    for (const char* motion : kMotions) {
      const double value = 100 * NumberAt(report, fmt::format("/metrics/{}/hold_m/{}", motion, k));
      cells.push_back(Judged(value, 2, value > limit));
    }
    cells.push_back({FrameHtml(holds[k].value("frame", 0))});
    table.Row(cells);
  }
  return table.empty() ? "" : table.Html();
}

}  // namespace retarget::report
