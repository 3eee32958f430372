#include "tools/studio/state.h"

#include <cmath>

#include "model/geometry/so3.h"
#include "tools/posing/posture_json.h"

namespace retarget::studio {
namespace {

using posing::DegreesJson;
using posing::NodesJson;
using posing::QuatJson;
using posing::VectorJson;

constexpr double kSamePlace = 1e-9;  // m

report::Json LimitJson(const JointLimit& limit, bool locked) {
  if (locked) return {{"kind", "fixed"}};
  const report::Json twist = {limit.twist_min / kDegree, limit.twist_max / kDegree};
  if (limit.hinge_axis != Vec3::Zero()) {
    return {{"kind", "hinge"},
            {"axis", VectorJson(limit.axis)},
            {"hinge_axis", VectorJson(limit.hinge_axis)},
            {"bend", {limit.bend_min / kDegree, limit.bend_max / kDegree}},
            {"hinge_play", limit.hinge_play / kDegree},
            {"twist", twist}};
  }
  if (!limit.has_swing()) return {{"kind", "free"}};
  report::Json json = {{"kind", "swing_twist"},
                       {"axis", VectorJson(limit.axis)},
                       {"middle", QuatJson(limit.middle)},
                       {"swing_axis", VectorJson(limit.swing_axis)},
                       {"swing", {limit.swing_min / kDegree, limit.swing_max / kDegree}},
                       {"side", {limit.side_min / kDegree, limit.side_max / kDegree}},
                       {"twist", twist}};
  if (limit.turns_with_parent) {
    json["twist_with_parent"] = {limit.with_parent_min / kDegree, limit.with_parent_max / kDegree};
  }
  return json;
}

// The node at a link's joint centre; null where there is none.
report::Json NodeAtLink(const Body& body, const PosedBody& rest, int link) {
  for (int n = 0; n < body.num_nodes(); ++n) {
    if ((rest.node[n] - rest.centre[link]).norm() < kSamePlace) return body.nodes[n].name;
  }
  return nullptr;
}

report::Json BodyJson(const Body& body) {
  report::Json nodes = report::Json::array(), links = report::Json::array();
  for (const Node& node : body.nodes) {
    nodes.push_back({{"name", node.name},
                     {"parent", node.parent},
                     {"link", node.link},
                     {"radius_m", node.radius}});
  }
  const PosedBody rest = PoseBody(body, RestPose(body));
  for (int l = 0; l < body.num_links(); ++l) {
    const Link& link = body.links[l];
    links.push_back({{"name", link.name},
                     {"parent", link.parent},
                     {"node", NodeAtLink(body, rest, l)},
                     {"limits", LimitJson(link.limit, link.locked)}});
  }
  return {{"stature", body.stature}, {"nodes", nodes}, {"links", links}};
}

report::Json FigureJson(const Body& body, const Pose& pose) {
  const PosedBody posed = PoseBody(body, pose);
  report::Json nodes = report::Json::array(), frames = report::Json::array(),
               centres = report::Json::array(), turns = report::Json::array();
  for (const Vec3& p : posed.node) nodes.push_back(VectorJson(p));
  for (int l = 0; l < body.num_links(); ++l) {
    frames.push_back(QuatJson(Quat(posed.rotation[l])));
    centres.push_back(VectorJson(posed.centre[l]));
    turns.push_back(DegreesJson(pose.rotation[l]));
  }
  return {{"stature", body.stature},
          {"root",
           {{"position", VectorJson(pose.root_position)},
            {"rotation_vector", DegreesJson(pose.rotation[0])}}},
          {"nodes", nodes},
          {"frames", frames},
          {"centres", centres},
          {"rotation_vectors", turns}};
}

report::Json PinsJson(const posing::PoseState& state) {
  report::Json out = report::Json::array();
  for (const posing::PinnedNode& pin : state.pins) {
    report::Json entry = {{"figure", report::kFigure[pin.figure]},
                          {"node", state.posture.body[pin.figure].nodes[pin.node].name},
                          {"position", VectorJson(pin.position)}};
    if (pin.ray) entry["ray"] = posing::RayJson(*pin.ray);
    out.push_back(entry);
  }
  return out;
}

report::Json PointJson(const HoldPoint& point, const std::array<Body, 2>& body) {
  return posing::HoldPointJson(point.figure, point.node, point.offset, body);
}

report::Json HoldsJson(const TemplatePosture& posture) {
  const std::array<PosedBody, 2> posed = posing::PosedFigures(posture);
  report::Json out = report::Json::array();
  for (const Hold& hold : posture.holds) {
    const Vec3 from = HoldPosition(hold.from, posture.body, posed);
    const Vec3 to = HoldPosition(hold.to, posture.body, posed);
    out.push_back({{"from", PointJson(hold.from, posture.body)},
                   {"to", PointJson(hold.to, posture.body)},
                   {"rotation", hold.rotation},
                   {"error_m", (from - to).norm()},
                   {"from_place", VectorJson(from)},
                   {"to_place", VectorJson(to)}});
  }
  return out;
}

report::Json OptionsJson(const posing::PoseOptions& options) {
  report::Json out;
  for (const posing::SolveOption& option : posing::kSolveOptions) {
    out[option.name] = options.*option.on;
  }
  return out;
}

}  // namespace

report::Json BodiesJson(const std::array<Body, 2>& body) {
  return {{"a", BodyJson(body[0])}, {"b", BodyJson(body[1])}};
}

report::Json PostureStateJson(const posing::PoseSession& session) {
  const posing::PoseState& state = session.state();
  const TemplatePosture& posture = state.posture;
  const auto leader = [&](int f) {
    return posture.root[f] == RootReference::kPartner ? "partner" : "world";
  };
  report::Json out = {{"can_undo", session.can_undo()}, {"can_redo", session.can_redo()}};
  if (session.can_undo()) out["undo_text"] = session.undo_text();
  out["name"] = posture.name;
  out["description"] = posture.description;
  out["tags_words"] = posture.keywords;
  for (int f = 0; f < 2; ++f) {
    out["figures"][report::kFigure[f]] = FigureJson(posture.body[f], posture.pose[f]);
    out["supports"][report::kFigure[f]] = NodesJson(posture.body[f], posture.supports[f]);
    out["root"][report::kFigure[f]] = leader(f);
  }
  out["pins"] = PinsJson(state);
  out["options"] = OptionsJson(state.options);
  out["holds"] = HoldsJson(posture);
  out["tangles"] = posing::TanglesJson(posture.tangles, posture.body);
  out["photo"] = posing::PhotoJson(posture.photo);
  out["camera"] = posing::CameraJson(posture.camera);
  return out;
}

report::Json PoseResultJson(const solver::PoseResult& result, const TemplatePosture& posture) {
  report::Json out = {{"drag_error_m", result.drag_error_m}, {"pin_error_m", result.pin_error_m},
                      {"stalled", result.stalled},           {"converged", result.converged},
                      {"iterations", result.iterations},     {"ms", 1000 * result.seconds}};
  if (const auto& blocked = result.blocked) {
    for (int k = 0; k < 2; ++k) {
      const int f = blocked->figure[k];
      out["blocked"].push_back(std::string(report::kFigure[f]) + "/" +
                               posture.body[f].nodes[blocked->node[k]].name);
    }
  }
  return out;
}

}  // namespace retarget::studio
