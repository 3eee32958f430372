// Reading; template_write.cc writes.
#include "io/template_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "io/template_figure.h"
#include "io/template_keys.h"
#include "io/template_parts.h"
#include "io/text/yaml.h"

namespace retarget::io {
namespace {

Hold ReadOwnHold(const Value& value, const TemplatePosture& posture,
                 const std::array<PosedBody, 2>& posed) {
  value.CheckKeys({"from", "to", "rotation"});
  const Hold hold = MakeHold(ReadHold(value, posture.body), posture.body, posed);
  if (hold.from.figure == hold.to.figure && hold.from.node == hold.to.node) {
    value.Refuse("expected two different points, found the same node twice");
  }
  return hold;
}

std::vector<int> ReadSupports(const Value& value, const Body& body) {
  std::vector<int> nodes;
  for (const Value& item : value.List()) {
    const int node = ReadNode(item, body);
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) {
      item.Refuse("expected every node once, found \"" + item.text() + "\" twice");
    }
    nodes.push_back(node);
  }
  return nodes;
}

// `supports` of both figures; the standing feet where the file does not say.
void ReadAllSupports(const std::optional<Value>& value, const std::array<PosedBody, 2>& posed,
                     TemplatePosture* posture) {
  if (value) value->CheckKeys({"a", "b"});
  for (int f = 0; f < 2; ++f) {
    const Body& body = posture->body[f];
    const auto own = value ? value->Find(FigureNames()[f]) : std::nullopt;
    posture->supports[f] = own ? ReadSupports(*own, body) : StandingNodes(body, posed[f]);
  }
}

std::array<RootReference, 2> ReadRootLeaders(const Value& value) {
  value.CheckKeys({"a", "b"});
  std::array<RootReference, 2> leaders = {RootReference::kOwnClip, RootReference::kOwnClip};
  for (const Value& own : value.Items()) {
    const bool partner = own.Name("leader", {"world", "own", "partner"}) == 2;
    leaders[own.key() == "a" ? 0 : 1] = partner ? RootReference::kPartner : RootReference::kOwnClip;
  }
  if (leaders[0] == RootReference::kPartner && leaders[1] == RootReference::kPartner) {
    value.Refuse("expected one figure that follows its own clip, found partner twice");
  }
  return leaders;
}

std::vector<std::string> ReadTags(const Value& value) {
  std::vector<std::string> tags;
  for (const Value& item : value.List()) tags.push_back(item.Text());
  return tags;
}

TemplateCamera ReadOwnCamera(const Value& value) {
  const TemplateCamera camera = ReadCamera(value);
  if ((camera.eye - camera.target).norm() < 1e-6) {
    value.Refuse("expected an eye away from the target, found both in one place");
  }
  return camera;
}

// First of all, so that a file of a later version is refused for that and not for its new keys.
void CheckTemplateFormat(const Value& root) {
  const auto format = root.Find("format");
  if (format && format->text() != fmt::format("{}", kTemplateFormat)) {
    format->RefuseExpecting(
        fmt::format("version {}, the only one this program reads", kTemplateFormat));
  }
}

TemplatePosture PostureFrom(const Value& root) {
  CheckTemplateFormat(root);
  root.CheckKeys({"format", "name", "description", "tags", "a", "b", "holds", "supports", "root",
                  "tangles", "contacts", "photo", "camera"});
  root.Require("format").Integer(kTemplateFormat, kTemplateFormat);
  TemplatePosture posture;
  std::array<PosedBody, 2> posed;
  posture.name = root.Require("name").Text();
  if (const auto v = root.Find("description")) posture.description = v->Text();
  if (const auto v = root.Find("tags")) posture.keywords = ReadTags(*v);
  for (int f = 0; f < 2; ++f) {
    ReadFigure(root.Require(FigureNames()[f]), &posture.body[f], &posture.pose[f]);
    posed[f] = PoseBody(posture.body[f], posture.pose[f]);
  }
  if (const auto v = root.Find("holds")) {
    for (const Value& item : v->List()) posture.holds.push_back(ReadOwnHold(item, posture, posed));
  }
  ReadAllSupports(root.Find("supports"), posed, &posture);
  if (const auto v = root.Find("root")) posture.root = ReadRootLeaders(*v);
  if (const auto v = root.Find("tangles")) {
    for (const Value& t : v->List()) posture.tangles.push_back(ReadTangle(t, posture.body));
  }
  if (const auto v = root.Find("contacts")) {
    posture.contacts.emplace();
    for (const Value& c : v->List()) {
      posture.contacts->push_back(ReadHandContact(c, posture.body, posed));
    }
  }
  if (const auto v = root.Find("photo")) posture.photo = ReadPhoto(*v, std::string::npos);
  if (const auto v = root.Find("camera")) posture.camera = ReadOwnCamera(*v);
  return posture;
}

}  // namespace

TemplatePosture ReadTemplate(const std::string& path) {
  return ParseTemplate(ReadYamlFile(path, "a template posture"), path);
}

TemplatePosture ParseTemplate(const std::string& text, const std::string& name) {
  const Document document = ParseYaml(text, name);
  return PostureFrom(document.root());
}

}  // namespace retarget::io
