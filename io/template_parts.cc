#include "io/template_parts.h"

#include <algorithm>

#include "io/template_keys.h"

namespace retarget::io {
namespace {

Vec3 OffsetOf(const Value& point) {
  const auto offset = point.Find("offset");
  return offset ? offset->Vector(kMaxPosition, "m") : Vec3::Zero();
}

HoldPoint ReadFrom(const Value& value, const std::array<Body, 2>& body) {
  value.CheckKeys({"figure", "node", "offset"});
  const int figure = value.Require("figure").Name("figure", {"a", "b"});
  const int node = ReadNode(value.Require("node"), body[figure]);
  return {figure, node, OffsetOf(value)};
}

void ReadTo(const Value& value, const std::array<Body, 2>& body, HoldRequest* hold) {
  const bool file = value.notation() == Notation::kYaml;
  const char* const place = file ? "position" : "offset";
  value.CheckKeys({"figure", "node", "offset", place});
  hold->to_figure = value.Require("figure").Name("figure", FigureNames());
  const bool world = hold->to_figure == kWorld;
  if (world) {
    value.CheckKeys({"figure", place});
  } else {
    value.CheckKeys({"figure", "node", "offset"});
    hold->to_node = ReadNode(value.Require("node"), body[hold->to_figure]);
  }
  if (const auto v = value.Find(world ? place : "offset")) {
    hold->to_offset = v->Vector(kMaxPosition, "m");
  }
}

}  // namespace

int ReadNode(const Value& value, const Body& body) { return value.Name("node", NodeNames(body)); }

Path ReadPath(const Value& value, const Body& body) {
  const bool file = value.notation() == Notation::kYaml;
  if (value.kind() != Value::Kind::kList || value.size() != 2) {
    value.RefuseExpecting(file ? "a list of 2 nodes" : "two different nodes");
  }
  const std::vector<Value> ends = value.Items();
  const int from = ReadNode(ends[0], body), to = ReadNode(ends[1], body);
  if (from == to) value.Refuse("expected two different nodes, found the same node twice");
  return {std::min(from, to), std::max(from, to)};
}

TangleRequest ReadTangle(const Value& value, const std::array<Body, 2>& body) {
  // Keys of a time window, which older templates may have: said by name.
  for (const char* window : {"from", "to"}) {
    if (const auto key = value.Find(window)) {
      key->Refuse("a tangle holds throughout: windows in time are not supported yet, leave it out");
    }
  }
  value.CheckKeys({"a", "b"});
  TangleRequest tangle;
  tangle.a = ReadPath(value.Require("a"), body[0]);
  tangle.b = ReadPath(value.Require("b"), body[1]);
  return tangle;
}

HoldRequest ReadHold(const Value& map, const std::array<Body, 2>& body) {
  HoldRequest hold;
  hold.from = ReadFrom(map.Require("from"), body);
  ReadTo(map.Require("to"), body, &hold);
  if (const auto rotation = map.Find("rotation")) hold.rotation = rotation->Bool();
  return hold;
}

Hold MakeHold(const HoldRequest& request, const std::array<Body, 2>& body,
              const std::array<PosedBody, 2>& posed) {
  const auto rotation = [&](int figure, int node) {
    return posed[figure].rotation[body[figure].nodes[node].link];
  };
  const bool world = request.to_figure == kWorld;
  const Mat3 to = world ? Mat3(Mat3::Identity()) : rotation(request.to_figure, request.to_node);
  const Vec3 origin = world ? Vec3(Vec3::Zero()) : posed[request.to_figure].node[request.to_node];
  Hold hold;
  hold.from = request.from;
  hold.to = {request.to_figure, world ? 0 : request.to_node, Vec3::Zero()};
  hold.to.offset =
      request.to_offset.value_or(to.transpose() * (HoldPosition(hold.from, body, posed) - origin));
  hold.rotation = request.rotation;
  const Mat3 relative = to.transpose() * rotation(hold.from.figure, hold.from.node);
  if (hold.rotation) hold.relative_rotation = Quat(relative).normalized();
  return hold;
}

HandContact ReadHandContact(const Value& map, const std::array<Body, 2>& body,
                            const std::array<PosedBody, 2>& posed) {
  map.CheckKeys({"from", "to"});
  const Value from = map.Require("from"), to = map.Require("to");
  HandContact contact;
  from.CheckKeys({"figure", "node", "along"});
  to.CheckKeys({"figure", "node", "along"});
  contact.figure = from.Require("figure").Name("figure", {"a", "b"});
  const int f = contact.figure, g = 1 - f;
  const std::vector<int> hands = HandNodes(body[f]);
  std::vector<std::string> names;
  for (const int hand : hands) names.push_back(body[f].nodes[hand].name);
  contact.hand = hands[static_cast<size_t>(from.Require("node").Name("hand", names))];
  if (to.Require("figure").Name("figure", {"a", "b"}) != g) {
    to.Refuse("expected a segment of the partner, found one of the hand's own figure");
  }
  contact.to = ReadNode(to.Require("node"), body[g]);
  if (body[g].nodes[contact.to].parent < 0) {
    to.Refuse("expected a node that ends a segment, found the root");
  }
  PlaceHandContact(body, posed, &contact);
  if (const auto v = from.Find("along")) contact.along = v->Number(0, 1);
  if (const auto v = to.Find("along")) contact.to_along = v->Number(0, 1);
  return contact;
}

TemplatePhoto ReadPhoto(const Value& value, size_t longest_name) {
  value.CheckKeys({"file", "opacity", "scale", "offset"});
  TemplatePhoto photo;
  photo.file = value.Require("file").Text(longest_name);
  if (const auto v = value.Find("opacity")) photo.opacity = v->Number(0, 1);
  if (const auto v = value.Find("scale")) photo.scale = v->Number(1e-4, 1e4);
  if (const auto v = value.Find("offset")) photo.offset = v->Numbers(2, -1e5, 1e5);
  return photo;
}

TemplateCamera ReadCamera(const Value& value) {
  value.CheckKeys({"eye", "target", "fov_deg"});
  TemplateCamera camera;
  if (const auto v = value.Find("eye")) camera.eye = v->Vector(kMaxPosition, "m");
  if (const auto v = value.Find("target")) camera.target = v->Vector(kMaxPosition, "m");
  if (const auto v = value.Find("fov_deg")) camera.fov_deg = v->Number(1, 179, "deg");
  return camera;
}

}  // namespace retarget::io
