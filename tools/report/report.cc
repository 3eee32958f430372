#include "tools/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/files.h"
#include "io/scene/scene_glb.h"
#include "io/text/read_file.h"

namespace retarget::report {
namespace {

std::vector<std::string> NodeNames(const Body& body) {
  std::vector<std::string> names;
  for (const Node& node : body.nodes) names.push_back(node.name);
  return names;
}

Json VectorJson(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Vec3 VectorFromJson(const Json& j) { return Vec3(j.at(0), j.at(1), j.at(2)); }

Json PathJson(const Body& body, const Path& path) {
  return Json::array({body.nodes[path.from].name, body.nodes[path.to].name});
}

Json HoldPointJson(const solver::MeasureSubject& subject, const HoldPoint& point) {
  if (point.figure == kWorld) return {{"figure", "world"}, {"position", VectorJson(point.offset)}};
  return {{"figure", kFigure[point.figure]},
          {"node", subject.body[point.figure].nodes[point.node].name},
          {"offset", VectorJson(point.offset)}};
}

HoldPoint HoldPointFromJson(const solver::MeasureSubject& subject, const Json& j) {
  HoldPoint point;
  const std::string figure = j.at("figure");
  if (figure == "world") return {kWorld, 0, VectorFromJson(j.at("position"))};
  point.figure = figure == "a" ? 0 : 1;
  point.node = subject.body[point.figure].FindNode(j.at("node"));
  point.offset = VectorFromJson(j.at("offset"));
  return point;
}

Json FigureJson(const Body& body, const solver::FigureMetrics& m) {
  Json path;
  for (int n = 1; n < body.num_nodes(); ++n) path[body.nodes[n].name] = m.path_m[n];
  return {{"self_penetration_m", m.self_penetration_m},
          {"floor_m", m.floor_m},
          {"foot_drift_m", m.foot_drift_m},
          {"foot_speed_max_m_s", m.foot_speed_max},
          {"foot_speed_over_1cm_s_percent", m.foot_speed_over_1cm_percent},
          {"pose_error_cm", m.pose_error_cm},
          {"joint_edit_deg", m.joint_edit_deg},
          {"jerk_m_s3", m.jerk},
          {"jerk_ratio_own", m.jerk_ratio_own},
          {"jerk_ratio_larger", m.jerk_ratio_larger},
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

solver::MotionView ViewOfScene(const io::SceneMotion& scene, const std::array<Body, 2>& body) {
  std::array<std::vector<int>, 2> nodes;
  for (int f = 0; f < 2; ++f) nodes[f] = scene.FindNodes(kFigure[f], NodeNames(body[f]));
  solver::MotionView view;
  const std::vector<double>& keys = scene.key_times;
  view.num_frames = static_cast<int>(keys.size());
  view.fps =
      keys.size() > 1 ? (static_cast<double>(keys.size()) - 1) / (keys.back() - keys.front()) : 30;
  view.at = [&scene, nodes, keys](double frame, solver::PostureSample* sample) {
    const size_t k = std::min(static_cast<size_t>(frame), keys.size() - 1);
    const double next = keys[std::min(k + 1, keys.size() - 1)];
    const double time = keys[k] + (frame - static_cast<double>(k)) * (next - keys[k]);
    for (int f = 0; f < 2; ++f) {
      scene.NodeFrames(time, nodes[f], &sample->node[f], &sample->rotation[f]);
    }
  };
  return view;
}

double WriteBackError(const RigMotion& written, const Rig& rig, double metres_per_unit, char up,
                      const std::vector<NodeJoint>& joints, const solver::MotionView& scene,
                      int figure) {
  const Quat turn = up == 'z' ? Quat(Eigen::AngleAxisd(-kPi / 2, Vec3::UnitX())) : Quat::Identity();
  double worst = 0;
  solver::PostureSample sample;
  const double end = (written.num_frames() - 1) * written.frame_time;
  for (int t = 0; t < scene.num_frames; ++t) {
    const double time = t / scene.fps;
    if (time > end + 1e-6) break;  // the rig's own rate ends within the last output frame
    scene.at(t, &sample);
    const PosedRig posed = PoseRig(written.rig, SampleRig(written, time));
    for (const NodeJoint& pair : joints) {
      const int joint = written.rig.Find(rig.joints[pair.joint].name);
      if (joint < 0) return HUGE_VAL;  // the file has lost a joint
      const Vec3 p = metres_per_unit * (turn * posed.position[joint]);
      worst = std::max(worst, (p - sample.node[figure][pair.node]).norm());
    }
  }
  return worst;
}

Json SimulationJson(const solver::SimulationResult& s) {
  return {{"status", solver::NameOf(s.status)},
          {"message", s.message},
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

MeasuredScene::MeasuredScene(std::string bytes, const std::string& name,
                             const std::array<Body, 2>& body)
    : bytes_(std::move(bytes)),
      scene_(io::ParseSceneGlb(bytes_, name)),
      view_(ViewOfScene(scene_, body)) {}

void MeasuredScene::Measure(const solver::MeasureSubject& subject, const MeasuredScene& source) {
  series_ = solver::MeasureSeries(subject, view_, source.view_);
  metrics_ = solver::MetricsOf(subject, series_, solver::NodesOf(source.view_));
}

Json MetricsJson(const solver::MeasureSubject& subject, const solver::Metrics& m) {
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

Json PassThroughsJson(const solver::MeasureSubject& subject,
                      const std::vector<solver::PassThrough>& passes) {
  Json out = Json::array();
  for (const solver::PassThrough& p : passes) {
    out.push_back({{"frame", p.frame},
                   {"a", subject.body[0].nodes[p.node_a].name},
                   {"b", subject.body[1].nodes[p.node_b].name}});
  }
  return out;
}

Json SubjectJson(const solver::MeasureSubject& subject, const solver::Metrics& result) {
  Json out;
  out["tangles"] = Json::array();
  for (size_t k = 0; k < subject.tangles.size(); ++k) {
    const solver::HeldTangle& held = subject.tangles[k];
    out["tangles"].push_back(
        {{"a", PathJson(subject.body[0], held.tag.tangle.a)},
         {"b", PathJson(subject.body[1], held.tag.tangle.b)},
         {"template_gli", held.tag.tangle.gli},
         {"target", held.target},
         {"rho", held.tag.rho},
         {"min_signed_gli", result.tangles[k].min_signed_gli},
         {"min_signed_gli_between_frames", result.tangles[k].min_signed_gli_between},
         {"frames_below_half", result.tangles[k].frames_below_half}});
  }
  out["pass_throughs"] = PassThroughsJson(subject, result.pass_throughs);
  for (int f = 0; f < 2; ++f) {
    const Body& body = subject.body[f];
    Json& figure = out["bodies"][kFigure[f]];
    figure["stature_m"] = body.stature;
    for (int n = 1; n < body.num_nodes(); ++n) {
      figure["radius"][body.nodes[n].name] = body.nodes[n].radius;
      figure["length"][body.nodes[n].name] = subject.length[f][n];
    }
  }
  for (int f = 0; f < 2; ++f) {
    Json contacts = Json::array();
    for (const Contact& c : subject.contacts[f]) {
      contacts.push_back(
          {{"node", subject.body[f].nodes[c.node].name}, {"first", c.first}, {"last", c.last}});
    }
    out["contacts"][kFigure[f]] = contacts;
  }
  out["holds"] = Json::array();
  for (size_t k = 0; k < subject.holds.size(); ++k) {
    const Hold& hold = subject.holds[k];
    out["holds"].push_back({{"from", HoldPointJson(subject, hold.from)},
                            {"to", HoldPointJson(subject, hold.to)},
                            {"rotation", hold.rotation},
                            {"largest_error_m", result.hold_m[k]},
                            {"frame", result.hold_frame[k]}});
  }
  return out;
}

solver::MeasureSubject SubjectFromJson(const Json& report, const std::string& path) {
  try {
    solver::MeasureSubject subject;
    for (int f = 0; f < 2; ++f) {
      const Json& figure = report.at("bodies").at(kFigure[f]);
      Body& body = subject.body[f];
      body = StandardBody(AverageMeasures(figure.at("stature_m")));
      subject.length[f].assign(body.nodes.size(), 0);
      for (int n = 1; n < body.num_nodes(); ++n) {
        body.nodes[n].radius = figure.at("radius").at(body.nodes[n].name);
        subject.length[f][n] = figure.at("length").at(body.nodes[n].name);
      }
      for (const Json& c : report.at("contacts").at(kFigure[f])) {
        subject.contacts[f].push_back({body.FindNode(c.at("node")), c.at("first"), c.at("last")});
      }
    }
    const auto path_of = [&](int f, const Json& j) {
      return Path{subject.body[f].FindNode(j.at(0)), subject.body[f].FindNode(j.at(1))};
    };
    for (const Json& t : report.at("tangles")) {
      solver::HeldTangle held;
      held.tag.tangle = {path_of(0, t.at("a")), path_of(1, t.at("b")), t.at("template_gli")};
      held.sign = held.tag.tangle.gli < 0 ? -1 : 1;
      held.target = t.at("target");
      subject.tangles.push_back(held);
    }
    for (const Json& h : report.at("holds")) {
      Hold hold;
      hold.from = HoldPointFromJson(subject, h.at("from"));
      hold.to = HoldPointFromJson(subject, h.at("to"));
      subject.holds.push_back(hold);
    }
    return subject;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path + ": not a report of this program: " + error.what());
  }
}

Json ThreeMetricsJson(const solver::MeasureSubject& subject, const solver::Metrics& source,
                      const solver::Metrics* baseline, const solver::Metrics& result) {
  return {{"source", MetricsJson(subject, source)},
          {"baseline", baseline ? MetricsJson(subject, *baseline) : Json(nullptr)},
          {"result", MetricsJson(subject, result)}};
}

Json ConflictsJson(const std::vector<solver::Conflict>& conflicts) {
  Json out = Json::array();
  for (const solver::Conflict& c : conflicts) {
    out.push_back({{"requirement", c.requirement},
                   {"frame", c.frame < 0 ? Json(nullptr) : Json(c.frame)},
                   {"limbs", c.limbs},
                   {"terms", c.terms},
                   {"cosine", c.terms.size() < 2 ? Json(nullptr) : Json(c.cosine)},
                   {"sentence", c.sentence}});
  }
  return out;
}

Json ChecksJson(const std::vector<solver::RequirementCheck>& checks) {
  Json out = Json::array();
  for (const solver::RequirementCheck& c : checks) {
    out.push_back({{"name", c.name},
                   {"value", c.value},
                   {"limit", c.limit},
                   {"unit", c.unit},
                   {"met", c.met},
                   {"where", c.where}});
  }
  return out;
}

}  // namespace retarget::report
