// Rows of tools/posing/operation_table.h: the content of a posture beside its poses.
#include "tools/posing/fields.h"

namespace retarget::posing {
namespace {

using Parser = ArgumentParser;

constexpr size_t kLongestName = 200, kLongestText = 20000;  // bytes
constexpr size_t kMostWords = 100, kMostTangles = 50, kMostNodes = 100;
constexpr int kMostHolds = 1000;  // an index

// Three keys: from, to, rotation.
template <typename Op>
Field<Op> HoldEnds() {
  return {{{"from", "HoldEnd"}, {"to", "HoldEnd"}, {"rotation", "boolean", false}},
          [](const io::Value& op, const TemplatePosture& posture, Op* out) {
            out->hold = io::ReadHold(op, posture.body);
          },
          [](const Op& op, const TemplatePosture& posture, report::Json* out) {
            const HoldRequest& hold = op.hold;
            (*out)["from"] =
                HoldPointJson(hold.from.figure, hold.from.node, hold.from.offset, posture.body);
            (*out)["to"] =
                HoldPointJson(hold.to_figure, hold.to_node, hold.to_offset, posture.body);
            (*out)["rotation"] = hold.rotation;
          }};
}

Field<SetSupports> SupportNodes() {
  return FieldOf<SetSupports>(
      "nodes", "string[]",
      [](const io::Value& v, const TemplatePosture& posture, SetSupports* out) {
        for (const io::Value& item : v.List(kMostNodes)) {
          out->nodes.push_back(io::ReadNode(item, posture.body[out->figure]));
        }
      },
      [](const SetSupports& op, const TemplatePosture& posture) {
        return NodesJson(posture.body[op.figure], op.nodes);
      });
}

Field<SetTangles> Tangles() {
  return FieldOf<SetTangles>(
      "tangles", "Tangle[]",
      [](const io::Value& v, const TemplatePosture& posture, SetTangles* out) {
        for (const io::Value& item : v.List(kMostTangles)) {
          out->tangles.push_back(io::ReadTangle(item, posture.body));
        }
      },
      [](const SetTangles& op, const TemplatePosture& posture) {
        return TanglesJson(op.tangles, posture.body);
      });
}

Field<SetTags> Tags() {
  return FieldOf<SetTags>(
      "tags", "string[]",
      [](const io::Value& v, const TemplatePosture&, SetTags* out) {
        out->tags = v.Texts(kMostWords, kLongestName);
      },
      [](const SetTags& op, const TemplatePosture&) { return report::Json(op.tags); });
}

Field<SetPhoto> Photo() {
  return FieldOf<SetPhoto>(
      "photo", "Photo | null",
      [](const io::Value& v, const TemplatePosture&, SetPhoto* out) {
        if (!v.is_null()) out->photo = io::ReadPhoto(v, kLongestName);
      },
      [](const SetPhoto& op, const TemplatePosture&) { return PhotoJson(op.photo); });
}

Field<SetCamera> Camera() {
  return FieldOf<SetCamera>(
      "camera", "Camera | null",
      [](const io::Value& v, const TemplatePosture&, SetCamera* out) {
        if (v.is_null()) return;
        out->camera = io::ReadCamera(v);
        for (const char* key : {"eye", "target"}) v.Require(key);
      },
      [](const SetCamera& op, const TemplatePosture&) { return CameraJson(op.camera); });
}

Operation Supports(const Parser& p) {
  const auto [figure, list] = p.Pair();
  SetSupports supports{p.Figure(figure), {}};
  for (const std::string& name : Split(list, ',')) {
    if (!list.empty()) supports.nodes.push_back(p.Node(supports.figure, name));
  }
  return supports;
}

Operation KeptTangles(const Parser& p) {
  SetTangles tangles;
  if (p.value() == "found") return tangles;
  for (const std::string& pair : Split(p.value(), ',')) {
    const size_t at = pair.find(':');
    if (at == std::string::npos) throw InputError("expected path of a:path of b, or found");
    TangleRequest request;
    request.a = p.PathOf(0, pair.substr(0, at));
    request.b = p.PathOf(1, pair.substr(at + 1));
    tangles.tangles.push_back(request);
  }
  return tangles;
}

Operation PhotoOf(const Parser& p) {
  if (p.value() == "none") return SetPhoto{};
  TemplatePhoto photo;
  photo.file = p.value();
  return SetPhoto{photo};
}

Operation CameraOf(const Parser& p) {
  if (p.value() == "none") return SetCamera{};
  const std::vector<double> x = Parser::Numbers(p.value(), {6, 7});
  TemplateCamera camera;
  camera.eye = Parser::VectorAt(x, 0);
  camera.target = Parser::VectorAt(x, 3);
  if (x.size() == 7) camera.fov_deg = x[6];
  return SetCamera{camera};
}

Operation EditedHold(const Parser& p) {
  const size_t at = p.value().find(':');
  if (at == std::string::npos) throw InputError("expected K:from=to");
  return EditHold{p.HoldIndex(p.value().substr(0, at)), p.HoldFrom(p.value().substr(at + 1))};
}

Operation Leader(const Parser& p) {
  const auto [figure, leader] = p.Pair();
  const bool partner = Parser::Named(leader, "leader", {"world", "partner"}) == 1;
  return SetRootReference{p.Figure(figure),
                          partner ? RootReference::kPartner : RootReference::kOwnClip};
}

}  // namespace

std::array<OperationRow, 12> ContentRows() {
  return {
      Row<AddHold>("add_hold", "new hold", {HoldEnds<AddHold>()},
                   {{"hold", "F/NODE=F/NODE|world[:x,y,z][,rotation]", "add a hold",
                     [](const Parser& p) -> Operation { return AddHold{p.HoldFrom(p.value())}; }}}),
      Row<EditHold>("edit_hold", "change of a hold",
                    {Integer("index", &EditHold::index, kMostHolds), HoldEnds<EditHold>()},
                    {{"edit-hold", "K:F/NODE=...", "replace the K-th hold, from 1", EditedHold}}),
      Row<RemoveHold>(
          "remove_hold", "removal of a hold", {Integer("index", &RemoveHold::index, kMostHolds)},
          {{"remove-hold", "K", "remove the K-th hold, from 1",
            [](const Parser& p) -> Operation { return RemoveHold{p.HoldIndex(p.value())}; }}}),
      Row<SetSupports>("set_supports", "supports", {Figure<SetSupports>(), SupportNodes()},
                       {{"supports", "F=NODE,NODE", "nodes that may be planted", Supports}}),
      Row<SetRootReference>(
          "set_root_leader", "leader",
          {Figure<SetRootReference>(),
           Choice<SetRootReference, RootReference>(
               "leader", &SetRootReference::leader,
               {{"world", RootReference::kOwnClip}, {"partner", RootReference::kPartner}})},
          {{"leader", "F=world|partner", "whose motion a root follows", Leader}}),
      Row<SetTangles>("set_tangles", "tangles", {Tangles()},
                      {{"tangles", "N..N:N..N,...|found",
                        "tangles to keep, path of a:path of b; or those found", KeptTangles}}),
      Row<SetName>("set_name", "name", {Text("name", &SetName::name, kLongestName)},
                   {{"name", "TEXT", "name of the template",
                     [](const Parser& p) -> Operation { return SetName{p.value()}; }}}),
      Row<SetDescription>(
          "set_description", "description",
          {Text("description", &SetDescription::description, kLongestText)},
          {{"description", "TEXT", "what the posture is",
            [](const Parser& p) -> Operation { return SetDescription{p.value()}; }}}),
      Row<SetTags>("set_tags", "tags", {Tags()},
                   {{"tags", "WORD,WORD", "words to find the template by",
                     [](const Parser& p) -> Operation {
                       if (p.value().empty()) return SetTags{};
                       return SetTags{Split(p.value(), ',')};
                     }}}),
      Row<SetPhoto>("set_photo", "photo", {Photo()},
                    {{"photo", "FILE|none", "picture behind the studio's view", PhotoOf}}),
      Row<SetCamera>("set_camera", "camera", {Camera()},
                     {{"camera", "ex,ey,ez,tx,ty,tz[,fov]|none", "view of the studio (m, degrees)",
                       CameraOf}}),
      // Of a template that is opened; not to be asked for.
      Row<SetPosture>("", "new posture", {}, {}),
  };
}

}  // namespace retarget::posing
