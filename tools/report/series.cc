#include "tools/report/series.h"

#include <cmath>

namespace retarget::report {
namespace {

// NaN and infinity have no place in JSON: null.
Json Rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale + 0.0;  // + 0.0 makes -0 a 0
}

using Instants = std::vector<solver::InstantMetrics>;

// [instants] of value(instant).
template <typename Value>
Json Curve(const Instants& instants, int digits, const Value& value) {
  Json out = Json::array();
  for (const solver::InstantMetrics& at : instants) out.push_back(Rounded(value(at), digits));
  return out;
}

Json Curve(const std::vector<double>& values, double scale, int digits) {
  Json out = Json::array();
  for (const double v : values) out.push_back(Rounded(scale * v, digits));
  return out;
}

Json PenetrationPairs(const solver::MetricsContext& subject, const Instants& instants) {
  Json out = Json::array();
  for (const solver::InstantMetrics& at : instants) {
    if (at.penetration.depth_m <= 0) {
      out.push_back(nullptr);
      continue;
    }
    out.push_back({subject.body[0].nodes[at.penetration.node_1].name,
                   subject.body[1].nodes[at.penetration.node_2].name});
  }
  return out;
}

Json Tracking(const Body& body, const std::vector<std::vector<double>>& turn_deg) {
  Json joints = Json::array(), values = Json::array();
  for (const int n : solver::TrackedJoints(body))
    joints.push_back(body.links[body.nodes[n].link].name);
  for (const std::vector<double>& joint : turn_deg) values.push_back(Curve(joint, 1, 2));
  return {{"joints", joints}, {"values", values}};
}

// What is measured in the frames and at the instants between them alike.
Json InstantsJson(const solver::MetricsContext& subject, const Instants& instants) {
  Json tangles = Json::array(), holds = Json::array();
  for (size_t k = 0; k < subject.tangles.size(); ++k) {
    tangles.push_back(
        Curve(instants, 4, [k](const solver::InstantMetrics& at) { return at.gli[k]; }));
  }
  for (size_t k = 0; k < subject.holds.size(); ++k) {
    holds.push_back(
        Curve(instants, 3, [k](const solver::InstantMetrics& at) { return 100 * at.hold_m[k]; }));
  }
  Json out = {{"tangles", tangles},
              {"penetration_cm", Curve(instants, 3,
                                       [](const solver::InstantMetrics& at) {
                                         return 100 * at.penetration.depth_m;
                                       })},
              {"penetration_pair", PenetrationPairs(subject, instants)},
              {"hold_cm", holds}};
  for (int f = 0; f < 2; ++f) {
    out["floor_cm"][kFigure[f]] = Curve(
        instants, 3, [f](const solver::InstantMetrics& at) { return 100 * at.figure[f].floor_m; });
  }
  return out;
}

Json MotionJson(const solver::MetricsContext& subject, const solver::FrameMetrics& series,
                bool is_source) {
  Json out = InstantsJson(subject, series.at);
  out["between"] = InstantsJson(subject, series.between);
  for (int f = 0; f < 2; ++f) {
    const char* who = kFigure[f];
    out["self_penetration_cm"][who] = Curve(series.at, 3, [f](const solver::InstantMetrics& at) {
      return 100 * at.figure[f].self_penetration.depth_m;
    });
    out["foot_speed_cm_s"][who] = Curve(series.foot_speed[f], 100, 3);
    out["tracking_deg"][who] =
        is_source ? Json(nullptr) : Tracking(subject.body[f], series.tracking_deg[f]);
  }
  out["pass_throughs"] = PassThroughsJson(subject, series.pass_throughs);
  return out;
}

}  // namespace

Json SeriesJson(const solver::MetricsContext& subject, const solver::FrameMetrics& source,
                const solver::FrameMetrics* baseline, const solver::FrameMetrics& result) {
  return {{"fps", result.fps},
          {"frames", result.num_frames()},
          {"source", MotionJson(subject, source, true)},
          {"baseline", baseline ? MotionJson(subject, *baseline, false) : Json(nullptr)},
          {"result", MotionJson(subject, result, false)}};
}

}  // namespace retarget::report
