#include "tools/report/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/files.h"
#include "io/text/read_file.h"
#include "tools/report/diagnosis_text.h"
#include "tools/report/requirement_json.h"
#include "tools/report/requirement_text.h"

namespace retarget::report {
namespace {

// Share of the contacts' beginnings and ends where the foot is accelerated by over 1.5 times the
// source's (%); null without contacts.
Json EdgesOver(const solver::FigureMetrics& m) {
  if (m.edges.empty()) return nullptr;
  const auto over = std::count_if(m.edges.begin(), m.edges.end(), [](const auto& e) {
    return e.acceleration > 1.5 * std::max(e.source, solver::kLeastEdge);
  });
  return 100.0 * static_cast<double>(over) / static_cast<double>(m.edges.size());
}

Json FigureJson(const Body& body, const solver::FigureMetrics& m) {
  Json path;
  for (int n = 1; n < body.num_nodes(); ++n) path[body.nodes[n].name] = m.path_m[n];
  const auto worst_of = [](const auto* worst, const auto& read) {
    return worst ? Json(read(*worst)) : Json(nullptr);
  };
  const solver::Swing* swing = solver::WorstSwing(m);
  const solver::ContactEdge* edge = solver::WorstEdge(m);
  return {
      {"self_penetration_m", m.self_penetration_m},
      {"floor_m", m.floor_m},
      {"foot_drift_m", m.foot_drift_m},
      {"foot_speed_max_m_s", m.foot_speed_max},
      {"foot_speed_over_1cm_s_percent", m.foot_speed_over_1cm_percent},
      {"near_floor_travel_m", worst_of(swing, [](const solver::Swing& s) { return s.travel_m; })},
      {"near_floor_travel_source_m",
       worst_of(swing, [](const solver::Swing& s) { return s.source_m; })},
      {"edge_acceleration_m_s2",
       worst_of(edge, [](const solver::ContactEdge& e) { return e.acceleration; })},
      {"edge_acceleration_source_m_s2",
       worst_of(edge, [](const solver::ContactEdge& e) { return e.source; })},
      {"edges_over_1p5_percent", EdgesOver(m)},
      {"holding_hand_gap_m", m.holding_hand_gap_m},
      {"pose_error_cm", m.pose_error_cm},
      {"joint_edit_deg", m.joint_edit_deg},
      {"jerk_m_s3", m.jerk},
      {"jerk_ratio_own", m.jerk_ratio_own},
      {"jerk_ratio_larger", m.jerk_ratio_larger},
      {"largest_pose_error_m", m.plausible.pose_error_m.value},
      {"trunk_tilt_deg", m.plausible.trunk_tilt_deg.value},
      {"floating_m", m.plausible.floating_m.value},
      {"beyond_joint_limit_deg", m.plausible.joint_limit_deg.value},
      {"jerk_ratio_plausible", m.plausible.jerk_ratio.value},
      {"length_error_percent", m.length_error_percent},
      {"path_m", path}};
}

}  // namespace

Json ReadReport(const std::string& folder) {
  const std::string path = folder + "/report.json";
  try {
    return Json::parse(io::ReadFile(path));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path + ": " + error.what());
  }
}

Json SimulationJson(const solver::SimulationResult& s) {
  return {{"status", solver::NameOf(s.status)},
          {"message", s.message},
          {"frame", s.frame < 0 ? Json(nullptr) : Json(s.frame)},
          {"settled", s.settled},
          {"settle_s", s.settle_s},
          {"settle_distance_m", s.settle_distance_m},
          {"frames_simulated", s.frames_simulated},
          {"simulated_s", s.simulated},
          {"seconds", s.seconds},
          {"realtime_factor", s.simulated / s.seconds}};
}

std::string SettleSentence(const solver::SimulationResult& s) {
  return fmt::format("{} {:.2f} s, nodes {:.1f} cm from the template on average",
                     s.settled ? "at rest after" : "not at rest after", s.settle_s,
                     100 * s.settle_distance_m);
}

Json MetricsJson(const solver::MetricsContext& subject, const solver::Metrics& m) {
  Json tangles = Json::array();
  for (const solver::TangleMetrics& t : m.tangles) {
    tangles.push_back({{"min_signed_gli", t.min_signed_gli},
                       {"min_signed_gli_between_frames", t.min_signed_gli_between},
                       {"frames_below_half", t.frames_below_half},
                       {"worst_frame", t.worst_frame}});
  }
  return {{"tangle_kept_percent", m.tangle_kept_percent},
          {"smallest_gli", m.smallest_gli},
          {"smallest_gli_between_frames", m.smallest_gli_between},
          {"tangles", tangles},
          {"pass_throughs", m.pass_throughs.size()},
          {"penetration_m", m.penetration_m},
          {"penetration_between_frames_m", m.penetration_between_m},
          {"penetration_over_1cm_percent", m.penetration_over_1cm_percent},
          {"hold_m", m.hold_m},
          {"a", FigureJson(subject.body[0], m.figure[0])},
          {"b", FigureJson(subject.body[1], m.figure[1])}};
}

Json PassThroughsJson(const solver::MetricsContext& subject,
                      const std::vector<solver::PassThrough>& passes) {
  Json out = Json::array();
  for (const solver::PassThrough& p : passes) {
    out.push_back({{"frame", p.frame},
                   {"a", subject.body[0].nodes[p.node_a].name},
                   {"b", subject.body[1].nodes[p.node_b].name}});
  }
  return out;
}

Json ThreeMetricsJson(const solver::MetricsContext& subject, const solver::Metrics& source,
                      const solver::Metrics* baseline, const solver::Metrics& result) {
  return {{"source", MetricsJson(subject, source)},
          {"baseline", baseline ? MetricsJson(subject, *baseline) : Json(nullptr)},
          {"result", MetricsJson(subject, result)}};
}

Json DiagnosesJson(const std::vector<solver::Diagnosis>& diagnoses,
                   const solver::MetricsContext& subject) {
  Json out = Json::array();
  for (const solver::Diagnosis& c : diagnoses) {
    Json limbs = Json::array();
    for (const solver::LimbNode& limb : c.check.limbs) {
      limbs.push_back(LimbName(limb, subject.body));
    }
    Json conflict = {
        {"requirement", NameOf(c.check)},
        {"frame", nullptr},
        {"limbs", limbs},
        {"terms", c.terms()},
        {"cosine", c.terms().size() < 2 ? Json(nullptr) : Json(c.opposition.shares[0].cosine)},
        {"sentence", DiagnosisSentence(c, subject)}};
    AddPlace(c.check, &conflict);
    conflict["cause"] = CauseName(c.cause);
    conflict["suggestion"] = nullptr;
    if (c.suggestion) {
      conflict["suggestion"] = {{"setting", c.suggestion->setting}, {"value", c.suggestion->value}};
    }
    out.push_back(conflict);
  }
  return out;
}

}  // namespace retarget::report
