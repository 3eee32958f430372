// Reading; template_write.cc writes.
#include "io/template_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "io/template_figure.h"
#include "io/template_keys.h"
#include "io/text/yaml_reader.h"

namespace retarget::io {
namespace {

// -- What the figures hold, stand on and follow --------------------------------------------------

// The posture so far, with the figures worked out in the world.
struct Scenery {
  TemplatePosture posture;
  std::array<PosedBody, 2> posed;

  const Mat3& RotationOf(const HoldPoint& point) const {
    static const Mat3 identity = Mat3::Identity();
    if (point.figure == kWorld) return identity;
    return posed[point.figure].rotation[posture.body[point.figure].nodes[point.node].link];
  }
};

int ReadNode(const YamlValue& value, const Body& body) {
  return ReadName(value, "node", NodeNames(body));
}

// A point of a figure; its offset is 0 where the file has none.
HoldPoint ReadFigurePoint(const YamlValue& value, int figure, const Body& body) {
  CheckKeys(value, {"figure", "node", "offset"});
  HoldPoint point{figure, ReadNode(Require(value, "node"), body), Vec3::Zero()};
  if (const YamlValue* offset = value.Find("offset")) {
    point.offset = ReadVector(*offset, kMaxPosition, "m");
  }
  return point;
}

HoldPoint ReadFrom(const YamlValue& value, const TemplatePosture& posture) {
  CheckKeys(value, {"figure", "node", "offset"});
  const int figure = ReadName(Require(value, "figure"), "figure", {"a", "b"});
  return ReadFigurePoint(value, figure, posture.body[figure]);
}

// Where the file does not say, the point is where `from` is.
HoldPoint ReadTo(const YamlValue& value, const Vec3& from_world, const Scenery& scenery) {
  CheckKeys(value, {"figure", "node", "offset", "position"});
  const int figure = ReadName(Require(value, "figure"), "figure", FigureNames());
  if (figure == kWorld) {
    CheckKeys(value, {"figure", "position"});
    const YamlValue* position = value.Find("position");
    return {kWorld, 0, position ? ReadVector(*position, kMaxPosition, "m") : from_world};
  }
  HoldPoint to = ReadFigurePoint(value, figure, scenery.posture.body[figure]);
  if (!value.Find("offset")) {
    to.offset =
        scenery.RotationOf(to).transpose() * (from_world - scenery.posed[figure].node[to.node]);
  }
  return to;
}

Hold ReadHold(const YamlValue& value, const Scenery& scenery) {
  CheckKeys(value, {"from", "to", "rotation"});
  const TemplatePosture& posture = scenery.posture;
  Hold hold;
  hold.from = ReadFrom(Require(value, "from"), posture);
  hold.to =
      ReadTo(Require(value, "to"), HoldPosition(hold.from, posture.body, scenery.posed), scenery);
  if (hold.from.figure == hold.to.figure && hold.from.node == hold.to.node) {
    Refuse(value, "expected two different points, found the same node twice");
  }
  if (const YamlValue* rotation = value.Find("rotation")) hold.rotation = ReadBool(*rotation);
  if (hold.rotation) {
    const Mat3 relative = scenery.RotationOf(hold.to).transpose() * scenery.RotationOf(hold.from);
    hold.relative_rotation = Quat(relative).normalized();
  }
  return hold;
}

std::vector<int> ReadSupports(const YamlValue& value, const Body& body) {
  std::vector<int> nodes;
  for (const YamlValue& item : ReadList(value)) {
    const int node = ReadNode(item, body);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) {
      Refuse(item, "expected every node once, found \"" + item.text + "\" twice");
    }
    nodes.push_back(node);
  }
  return nodes;
}

// `supports` of both figures; the standing feet where the file does not say.
void ReadAllSupports(const YamlValue* value, Scenery* scenery) {
  if (value) CheckKeys(*value, {"a", "b"});
  for (int f = 0; f < 2; ++f) {
    const Body& body = scenery->posture.body[f];
    const YamlValue* own = value ? value->Find(FigureNames()[f]) : nullptr;
    scenery->posture.supports[f] =
        own ? ReadSupports(*own, body) : StandingNodes(body, scenery->posed[f]);
  }
}

std::array<RootLeader, 2> ReadRootLeaders(const YamlValue& value) {
  CheckKeys(value, {"a", "b"});
  std::array<RootLeader, 2> leaders = {RootLeader::kOwnClip, RootLeader::kOwnClip};
  for (const YamlValue& own : value.children) {
    const bool partner = ReadName(own, "leader", {"world", "own", "partner"}) == 2;
    leaders[own.key == "a" ? 0 : 1] = partner ? RootLeader::kPartner : RootLeader::kOwnClip;
  }
  if (leaders[0] == RootLeader::kPartner && leaders[1] == RootLeader::kPartner) {
    Refuse(value, "expected one figure that follows its own clip, found partner twice");
  }
  return leaders;
}

// Two nodes in any order; the path is written from the lower one.
Path ReadPath(const YamlValue& value, const Body& body) {
  if (value.kind != YamlValue::Kind::kList || value.children.size() != 2) {
    RefuseExpecting(value, "a list of 2 nodes");
  }
  const int from = ReadNode(value.children[0], body), to = ReadNode(value.children[1], body);
  if (from == to) Refuse(value, "expected two different nodes, found the same node twice");
  return {std::min(from, to), std::max(from, to)};
}

TangleRequest ReadTangle(const YamlValue& value, const std::array<Body, 2>& body) {
  // Keys of a time window, which older templates may have: said by name.
  for (const char* window : {"from", "to"}) {
    if (const YamlValue* key = value.Find(window)) {
      Refuse(*key,
             "a tangle holds throughout: windows in time are not supported yet, leave it out");
    }
  }
  CheckKeys(value, {"a", "b"});
  TangleRequest tangle;
  tangle.a = ReadPath(Require(value, "a"), body[0]);
  tangle.b = ReadPath(Require(value, "b"), body[1]);
  return tangle;
}

// -- The rest ------------------------------------------------------------------------------------

TemplatePhoto ReadPhoto(const YamlValue& value) {
  CheckKeys(value, {"file", "opacity", "scale", "offset"});
  TemplatePhoto photo;
  photo.file = ReadText(Require(value, "file"));
  if (const YamlValue* v = value.Find("opacity")) photo.opacity = ReadNumber(*v, 0, 1, "");
  if (const YamlValue* v = value.Find("scale")) photo.scale = ReadNumber(*v, 1e-4, 1e4, "");
  if (const YamlValue* v = value.Find("offset")) photo.offset = ReadNumbers(*v, 2, -1e5, 1e5, "");
  return photo;
}

TemplateCamera ReadCamera(const YamlValue& value) {
  CheckKeys(value, {"eye", "target", "fov_deg"});
  TemplateCamera camera;
  if (const YamlValue* v = value.Find("eye")) camera.eye = ReadVector(*v, kMaxPosition, "m");
  if (const YamlValue* v = value.Find("target")) camera.target = ReadVector(*v, kMaxPosition, "m");
  if (const YamlValue* v = value.Find("fov_deg")) camera.fov_deg = ReadNumber(*v, 1, 179, "deg");
  if ((camera.eye - camera.target).norm() < 1e-6) {
    Refuse(value, "expected an eye away from the target, found both in one place");
  }
  return camera;
}

std::vector<std::string> ReadTags(const YamlValue& value) {
  std::vector<std::string> tags;
  for (const YamlValue& item : ReadList(value)) tags.push_back(ReadText(item));
  return tags;
}

// First of all, so that a file of a later version is refused for that and not for its new keys.
void CheckTemplateFormat(const YamlValue& root) {
  const YamlValue* format = root.Find("format");
  if (format && format->text != fmt::format("{}", kTemplateFormat)) {
    RefuseExpecting(*format,
                    fmt::format("version {}, the only one this program reads", kTemplateFormat));
  }
}

TemplatePosture PostureFrom(const YamlValue& root) {
  CheckTemplateFormat(root);
  CheckKeys(root, {"format", "name", "description", "tags", "a", "b", "holds", "supports", "root",
                   "tangles", "photo", "camera"});
  ReadInteger(Require(root, "format"), kTemplateFormat, kTemplateFormat);
  Scenery scenery;
  TemplatePosture& posture = scenery.posture;
  posture.name = ReadText(Require(root, "name"));
  if (const YamlValue* v = root.Find("description")) posture.description = ReadText(*v);
  if (const YamlValue* v = root.Find("tags")) posture.tags = ReadTags(*v);
  for (int f = 0; f < 2; ++f) {
    ReadFigure(Require(root, FigureNames()[f]), &posture.body[f], &posture.pose[f]);
    scenery.posed[f] = PoseBody(posture.body[f], posture.pose[f]);
  }
  if (const YamlValue* v = root.Find("holds")) {
    for (const YamlValue& item : ReadList(*v)) posture.holds.push_back(ReadHold(item, scenery));
  }
  ReadAllSupports(root.Find("supports"), &scenery);
  if (const YamlValue* v = root.Find("root")) posture.root = ReadRootLeaders(*v);
  if (const YamlValue* v = root.Find("tangles")) {
    for (const YamlValue& t : ReadList(*v)) posture.tangles.push_back(ReadTangle(t, posture.body));
  }
  if (const YamlValue* v = root.Find("photo")) posture.photo = ReadPhoto(*v);
  if (const YamlValue* v = root.Find("camera")) posture.camera = ReadCamera(*v);
  return posture;
}

}  // namespace

TemplatePosture ReadTemplate(const std::string& path) {
  return ParseTemplate(ReadTextFile(path, "a template posture"), path);
}

TemplatePosture ParseTemplate(const std::string& text, const std::string& name) {
  return PostureFrom(ParseYaml(text, name));
}

}  // namespace retarget::io
