#include "tools/report/subject_json.h"

namespace retarget::report {
namespace {

Json VectorJson(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Vec3 VectorFromJson(const Json& j) { return Vec3(j.at(0), j.at(1), j.at(2)); }

Json PathJson(const Body& body, const Path& path) {
  return Json::array({body.nodes[path.from].name, body.nodes[path.to].name});
}

Json HoldPointJson(const solver::MetricsContext& subject, const HoldPoint& point) {
  if (point.figure == kWorld) return {{"figure", "world"}, {"position", VectorJson(point.offset)}};
  return {{"figure", kFigure[point.figure]},
          {"node", subject.body[point.figure].nodes[point.node].name},
          {"offset", VectorJson(point.offset)}};
}

// Throws InputError where the body has no such node.
int NodeNamed(const Body& body, const Json& name) {
  const int node = body.FindNode(name);
  if (node < 0) throw InputError("there is no node " + name.get<std::string>());
  return node;
}

HoldPoint HoldPointFromJson(const solver::MetricsContext& subject, const Json& j) {
  HoldPoint point;
  const std::string figure = j.at("figure");
  if (figure == "world") return {kWorld, 0, VectorFromJson(j.at("position"))};
  point.figure = figure == "a" ? 0 : 1;
  point.node = NodeNamed(subject.body[point.figure], j.at("node"));
  point.offset = VectorFromJson(j.at("offset"));
  return point;
}

// The tree: every node with its parent node and the link that carries it.
Json NodesJson(const Body& body) {
  Json nodes = Json::array();
  for (const Node& node : body.nodes) {
    nodes.push_back(
        {{"name", node.name},
         {"parent", node.parent < 0 ? Json(nullptr) : Json(body.nodes[node.parent].name)},
         {"link", body.links[node.link].name}});
  }
  return nodes;
}

// Joints of which the rig says more than the body's own ranges of motion.
Json LimitsJson(const Body& body) {
  Json out = Json::array();
  for (const Link& link : body.links) {
    const JointLimit standard = StandardLimit(link.name);
    const JointLimit& own = link.limit;
    if (own.hinge_axis == standard.hinge_axis && own.reach >= standard.reach) continue;
    out.push_back({{"joint", link.name},
                   {"hinge_axis", VectorJson(own.hinge_axis)},
                   {"reach_deg", own.reach / kDegree},
                   {"reach_centre", VectorJson(own.reach_centre)}});
  }
  return out;
}

// The limits of a body from a report; those from before they were written say nothing of them.
void SetLimits(const Json& figure, Body* body) {
  if (!figure.contains("limits")) return;
  for (Link& link : body->links) link.limit = StandardLimit(link.name);
  for (const Json& own : figure.at("limits")) {
    const int link = body->FindLink(own.at("joint"));
    if (link < 0) throw InputError("there is no joint " + own.at("joint").get<std::string>());
    JointLimit& limit = body->links[link].limit;
    limit.hinge_axis = VectorFromJson(own.at("hinge_axis"));
    limit.reach = own.at("reach_deg").get<double>() * kDegree;
    limit.reach_centre = VectorFromJson(own.at("reach_centre"));
  }
}

// The body's tree, as far as measuring needs it: links have names alone. Reports from before the
// nodes were written are about the standard body.
Body BodyFromJson(const Json& figure) {
  if (!figure.contains("nodes")) return StandardBody(AverageMeasures(figure.at("stature_m")));
  Body body;
  body.stature = figure.at("stature_m");
  for (const Json& j : figure.at("nodes")) {
    Node node;
    node.name = j.at("name");
    if (!j.at("parent").is_null()) {
      node.parent = body.FindNode(j.at("parent"));
      if (node.parent < 0) throw InputError("its node " + node.name + " comes before its parent");
    }
    node.link = body.FindLink(j.at("link"));
    if (node.link < 0) {
      node.link = body.num_links();
      body.links.emplace_back();
      body.links.back().name = j.at("link");
    }
    body.nodes.push_back(node);
  }
  // A link hangs from the one that carries the parent of its node.
  for (const Node& node : body.nodes) {
    Link& link = body.links[node.link];
    if (node.parent < 0 || link.parent >= 0 || body.nodes[node.parent].link == node.link) continue;
    link.parent = body.nodes[node.parent].link;
  }
  SetLimits(figure, &body);
  return body;
}

}  // namespace

Json SubjectJson(const solver::MetricsContext& subject, const solver::Metrics& result) {
  Json out;
  out["tangles"] = Json::array();
  for (size_t k = 0; k < subject.tangles.size(); ++k) {
    const solver::TangleTarget& held = subject.tangles[k];
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
    figure["nodes"] = NodesJson(body);
    figure["limits"] = LimitsJson(body);
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
  out["hand_contacts"] = Json::array();
  for (const HandContact& c : subject.hand_contacts) {
    const auto end = [&](int figure, int node, double along) {
      return Json{{"figure", kFigure[figure]},
                  {"node", subject.body[figure].nodes[node].name},
                  {"along", along}};
    };
    out["hand_contacts"].push_back(
        {{"from", end(c.figure, c.hand, c.along)}, {"to", end(1 - c.figure, c.to, c.to_along)}});
  }
  return out;
}

solver::MetricsContext SubjectFromJson(const Json& report, const std::string& path) {
  try {
    solver::MetricsContext subject;
    for (int f = 0; f < 2; ++f) {
      const Json& figure = report.at("bodies").at(kFigure[f]);
      Body& body = subject.body[f];
      body = BodyFromJson(figure);
      subject.carried[f] =
          report.contains("supports") && report.at("supports").at(kFigure[f]).empty();
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
      return Path{NodeNamed(subject.body[f], j.at(0)), NodeNamed(subject.body[f], j.at(1))};
    };
    for (const Json& t : report.at("tangles")) {
      solver::TangleTarget held;
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
    if (report.contains("hand_contacts")) {  // reports of before have none
      for (const Json& j : report.at("hand_contacts")) {
        const Json &from = j.at("from"), &to = j.at("to");
        HandContact c;
        c.figure = from.at("figure") == "a" ? 0 : 1;
        c.hand = NodeNamed(subject.body[c.figure], from.at("node"));
        c.to = NodeNamed(subject.body[1 - c.figure], to.at("node"));
        c.along = from.at("along");
        c.to_along = to.at("along");
        subject.hand_contacts.push_back(c);
      }
    }
    return subject;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path + ": not a report of this program: " + error.what());
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

}  // namespace retarget::report
