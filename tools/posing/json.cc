#include "tools/posing/json.h"

#include <functional>
#include <limits>

#include "io/template_keys.h"
#include "model/geometry/so3.h"

namespace retarget::posing {
namespace {

constexpr size_t kLongestName = 200, kLongestText = 20000;  // bytes
constexpr size_t kMostWords = 100, kMostTangles = 50;

// The fields of one operation, with the names of the posture's bodies.
class Read {
 public:
  Read(const io::Fields& fields, const TemplatePosture& posture) : op(fields), posture_(posture) {}

  const io::Fields& op;

  int Figure(const char* key = "figure") const { return op.Named(key, {"a", "b"}); }
  int Node(int figure) const { return op.Named("node", io::NodeNames(posture_.body[figure])); }
  std::vector<int> Nodes(int figure) const {
    return op.NamedList("nodes", io::NodeNames(posture_.body[figure]), 100);
  }
  int Link(int figure) const { return op.Named("joint", io::LinkNames(posture_.body[figure])); }
  int Gesture() const { return op.Integer("gesture", 0, std::numeric_limits<int>::max(), 0); }
  Quat Degrees(const char* key) const { return ExpSo3(kDegree * op.Vector(key)); }

  HoldRequest Hold() const {
    HoldRequest hold;
    const io::Fields from = op.Object("from"), to = op.Object("to");
    from.Only({"figure", "node", "offset"});
    const int figure = from.Named("figure", {"a", "b"});
    hold.from = {figure, from.Named("node", io::NodeNames(posture_.body[figure])), Vec3::Zero()};
    if (from.Has("offset")) hold.from.offset = from.Vector("offset");
    hold.to_figure = to.Named("figure", io::FigureNames());
    if (hold.to_figure == kWorld) {
      to.Only({"figure", "offset"});
    } else {
      to.Only({"figure", "node", "offset"});
      hold.to_node = to.Named("node", io::NodeNames(posture_.body[hold.to_figure]));
    }
    if (to.Has("offset")) hold.to_offset = to.Vector("offset");
    hold.rotation = op.Bool("rotation", false);
    return hold;
  }

  // Two nodes of a figure, in any order.
  Path PathOf(const io::Fields& tangle, int figure) const {
    const char* key = figure == 0 ? "a" : "b";
    const std::vector<int> ends = tangle.NamedList(key, io::NodeNames(posture_.body[figure]), 2);
    if (ends.size() != 2 || ends[0] == ends[1]) tangle.Refuse(key, "two different nodes");
    return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
  }

 private:
  const TemplatePosture& posture_;
};

PoseStep ReadPin(const Read& r) {
  Pin pin{r.Figure(), 0, std::nullopt};
  pin.node = r.Node(pin.figure);
  if (r.op.Has("ray")) {
    const io::Fields ray = r.op.Object("ray");
    ray.Only({"origin", "direction"});
    pin.ray = PinRay{ray.Vector("origin"), ray.Vector("direction")};
  }
  return pin;
}

PoseStep ReadRoot(const Read& r) {
  SetRoot root{r.Figure(), r.op.Vector("position"), std::nullopt, r.Gesture()};
  if (r.op.Has("rotation_vector")) root.rotation = r.Degrees("rotation_vector");
  return root;
}

PoseStep ReadTangles(const Read& r) {
  SetTangles tangles;
  for (const io::Fields& item : r.op.ObjectList("tangles", kMostTangles)) {
    item.Only({"a", "b"});
    tangles.tangles.push_back({r.PathOf(item, 0), r.PathOf(item, 1)});
  }
  return tangles;
}

PoseStep ReadPhoto(const Read& r) {
  if (r.op.Require("photo").is_null()) return SetPhoto{};
  const io::Fields fields = r.op.Object("photo");
  fields.Only({"file", "opacity", "scale", "offset"});
  TemplatePhoto photo;
  photo.file = fields.Text("file", kLongestName);
  photo.opacity = fields.Number("opacity", 0, 1, photo.opacity);
  photo.scale = fields.Number("scale", 1e-4, 1e4, photo.scale);
  if (const io::Message* offset = fields.Find("offset")) {
    const bool pair = offset->is_array() && offset->size() == 2 && (*offset)[0].is_number() &&
                      (*offset)[1].is_number();
    if (!pair) fields.Refuse("offset", "2 numbers");
    photo.offset = {(*offset)[0].get<double>(), (*offset)[1].get<double>()};
  }
  return SetPhoto{photo};
}

PoseStep ReadCamera(const Read& r) {
  if (r.op.Require("camera").is_null()) return SetCamera{};
  const io::Fields fields = r.op.Object("camera");
  fields.Only({"eye", "target", "fov_deg"});
  TemplateCamera camera;
  camera.eye = fields.Vector("eye");
  camera.target = fields.Vector("target");
  camera.fov_deg = fields.Number("fov_deg", 1, 179, camera.fov_deg);
  return SetCamera{camera};
}

struct Entry {
  const char* name;
  std::vector<std::string> fields;  // beside "op"
  std::function<PoseStep(const Read&)> read;
};

using R = const Read&;

std::vector<Entry> SolverEntries() {
  return {
      {"drag",
       {"figure", "node", "target", "gesture"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return Drag{f, r.Node(f), r.op.Vector("target"), r.Gesture()};
       }},
      {"drag_ray",
       {"figure", "node", "origin", "direction", "gesture"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return DragRay{f, r.Node(f), r.op.Vector("origin"), r.op.Vector("direction"), r.Gesture()};
       }},
      {"settle", {}, [](R) -> PoseStep { return Settle{}; }},
      {"pin", {"figure", "node", "ray"}, ReadPin},
      {"unpin",
       {"figure", "node"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return Unpin{f, r.Node(f)};
       }},
      {"set_option",
       {"option", "on"},
       [](R r) -> PoseStep {
         const int option = r.op.Named(
             "option", {"holds", "limits", "penetration", "floor", "tangles", "feet", "root"});
         return SetOption{static_cast<SolveOption>(option), r.op.Bool("on")};
       }},
  };
}

std::vector<Entry> HandEntries() {
  return {
      {"move_figure",
       {"figure", "shift", "gesture"},
       [](R r) -> PoseStep {
         return MoveFigure{r.Figure(), r.op.Vector("shift"), r.Gesture()};
       }},
      {"turn_figure",
       {"figure", "rotation", "gesture"},
       [](R r) -> PoseStep {
         return TurnFigure{r.Figure(), r.op.Rotation("rotation"), r.Gesture()};
       }},
      {"rotate_joint",
       {"figure", "joint", "rotation", "world", "gesture"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return RotateJoint{f, r.Link(f), r.op.Rotation("rotation"), r.op.Bool("world", false),
                            r.Gesture()};
       }},
      {"set_joint",
       {"figure", "joint", "rotation_vector", "gesture"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return SetJoint{f, r.Link(f), r.Degrees("rotation_vector"), r.Gesture()};
       }},
      {"set_root", {"figure", "position", "rotation_vector", "gesture"}, ReadRoot},
      {"set_stature",
       {"figure", "stature"},
       [](R r) -> PoseStep {
         return SetStature{r.Figure(), r.op.Number("stature", 0.5, 3)};
       }},
      {"mirror",
       {"figure"},
       [](R r) -> PoseStep {
         const int figure = r.op.Named("figure", {"a", "b", "both"});
         return Mirror{figure == 2 ? kBoth : figure};
       }},
      {"swap_figures", {}, [](R) -> PoseStep { return SwapFigures{}; }},
      {"copy_side",
       {"figure", "from"},
       [](R r) -> PoseStep {
         return CopySide{r.Figure(), r.op.Named("from", {"left", "right"}) == 0};
       }},
      {"reset_joint",
       {"figure", "joint"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return ResetJoint{f, r.Link(f)};
       }},
      {"reset_figure", {"figure"}, [](R r) -> PoseStep { return ResetFigure{r.Figure()}; }},
  };
}

std::vector<Entry> SayEntries() {
  return {
      {"add_hold", {"from", "to", "rotation"}, [](R r) -> PoseStep { return AddHold{r.Hold()}; }},
      {"edit_hold",
       {"index", "from", "to", "rotation"},
       [](R r) -> PoseStep {
         return EditHold{r.op.Integer("index", 0, 1000), r.Hold()};
       }},
      {"remove_hold",
       {"index"},
       [](R r) -> PoseStep { return RemoveHold{r.op.Integer("index", 0, 1000)}; }},
      {"set_supports",
       {"figure", "nodes"},
       [](R r) -> PoseStep {
         const int f = r.Figure();
         return SetSupports{f, r.Nodes(f)};
       }},
      {"set_root_leader",
       {"figure", "leader"},
       [](R r) -> PoseStep {
         const bool partner = r.op.Named("leader", {"world", "partner"}) == 1;
         return SetRootLeader{r.Figure(), partner ? RootLeader::kPartner : RootLeader::kOwnClip};
       }},
      {"set_tangles", {"tangles"}, ReadTangles},
      {"set_name",
       {"name"},
       [](R r) -> PoseStep { return SetName{r.op.Text("name", kLongestName)}; }},
      {"set_description",
       {"description"},
       [](R r) -> PoseStep { return SetDescription{r.op.Text("description", kLongestText)}; }},
      {"set_tags",
       {"tags"},
       [](R r) -> PoseStep { return SetTags{r.op.TextList("tags", kMostWords, kLongestName)}; }},
      {"set_photo", {"photo"}, ReadPhoto},
      {"set_camera", {"camera"}, ReadCamera},
      {"undo", {}, [](R) -> PoseStep { return HistoryStep::kUndo; }},
      {"redo", {}, [](R) -> PoseStep { return HistoryStep::kRedo; }},
  };
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = [] {
    std::vector<Entry> all = SolverEntries();
    for (const auto& more : {HandEntries(), SayEntries()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return entries;
}

const std::vector<std::string>& Names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Entry& entry : Entries()) all.push_back(entry.name);
    return all;
  }();
  return names;
}

}  // namespace

PoseStep ParsePoseJson(const io::Fields& op, const TemplatePosture& posture) {
  const Entry& entry = Entries()[static_cast<size_t>(op.Named("op", Names()))];
  std::vector<std::string> fields = entry.fields;
  fields.push_back("op");
  op.Only(fields);
  return entry.read(Read(op, posture));
}

}  // namespace retarget::posing
