#include "tools/posing/words.h"

#include <functional>

#include "tools/posing/value.h"

namespace retarget::posing {
namespace {

PoseStep RayStep(const Words& w, bool pin) {
  const auto [node, numbers] = w.Pair();
  const auto at = w.NodeAt(node);
  const std::vector<double> x = Words::Numbers(numbers, {6});
  const Vec3 origin = Words::VectorAt(x, 0), direction = Words::VectorAt(x, 3);
  if (pin) return Pin{at.figure, at.index, PinRay{origin, direction}};
  return DragRay{at.figure, at.index, origin, direction};
}

PoseStep TurnStep(const Words& w) {
  const auto [figure, numbers] = w.Pair();
  const std::vector<double> x = Words::Numbers(numbers, {1, 3});
  return TurnFigure{w.Figure(figure),
                    Words::Rotation(x.size() == 1 ? Vec3(0, x[0], 0) : Words::VectorAt(x, 0))};
}

PoseStep RotateStep(const Words& w) {
  auto [joint, numbers] = w.Pair();
  const auto at = w.LinkAt(joint);
  const bool world = numbers.ends_with(",world");
  if (world) numbers.resize(numbers.size() - 6);
  return RotateJoint{at.figure, at.index, Words::Rotation(Words::Vector(numbers)), world};
}

PoseStep SetJointStep(const Words& w) {
  const auto [joint, degrees] = w.Pair();
  const auto at = w.LinkAt(joint);
  return SetJoint{at.figure, at.index, Words::Rotation(Words::Vector(degrees))};
}

PoseStep RootStep(const Words& w) {
  const auto [figure, numbers] = w.Pair();
  const std::vector<double> x = Words::Numbers(numbers, {3, 6});
  SetRoot root{w.Figure(figure), Words::VectorAt(x, 0)};
  if (x.size() == 6) root.rotation = Words::Rotation(Words::VectorAt(x, 3));
  return root;
}

PoseStep ResetStep(const Words& w) {
  if (w.value().find('/') == std::string::npos) return ResetFigure{w.Figure(w.value())};
  const auto at = w.LinkAt(w.value());
  return ResetJoint{at.figure, at.index};
}

PoseStep SupportsStep(const Words& w) {
  const auto [figure, list] = w.Pair();
  SetSupports supports{w.Figure(figure), {}};
  for (const std::string& name : Split(list, ',')) {
    if (!list.empty()) supports.nodes.push_back(w.Node(supports.figure, name));
  }
  return supports;
}

PoseStep TanglesStep(const Words& w) {
  SetTangles tangles;
  if (w.value() == "found") return tangles;
  for (const std::string& pair : Split(w.value(), ',')) {
    const size_t at = pair.find(':');
    if (at == std::string::npos) throw InputError("expected path of a:path of b, or found");
    TangleRequest request;
    request.a = w.PathOf(0, pair.substr(0, at));
    request.b = w.PathOf(1, pair.substr(at + 1));
    tangles.tangles.push_back(request);
  }
  return tangles;
}

PoseStep CameraStep(const Words& w) {
  if (w.value() == "none") return SetCamera{};
  const std::vector<double> x = Words::Numbers(w.value(), {6, 7});
  TemplateCamera camera;
  camera.eye = Words::VectorAt(x, 0);
  camera.target = Words::VectorAt(x, 3);
  if (x.size() == 7) camera.fov_deg = x[6];
  return SetCamera{camera};
}

PoseStep OptionStep(const Words& w) {
  const auto [name, on] = w.Pair();
  const int option = Words::Named(
      name, "option", {"holds", "limits", "penetration", "floor", "tangles", "feet", "root"});
  return SetOption{static_cast<SolveOption>(option),
                   Words::Named(on, "setting", {"off", "on"}) == 1};
}

PoseStep PhotoStep(const Words& w) {
  if (w.value() == "none") return SetPhoto{};
  TemplatePhoto photo;
  photo.file = w.value();
  return SetPhoto{photo};
}

struct Entry {
  PoseWord word;
  std::function<PoseStep(const Words&)> read;
};

const std::vector<Entry>& Entries() {
  using W = const Words&;
  static const std::vector<Entry> entries = {
      {{"drag", "F/NODE=x,y,z", "pull a node to a place (m)"},
       [](W w) -> PoseStep {
         const auto [node, place] = w.Pair();
         const auto at = w.NodeAt(node);
         return Drag{at.figure, at.index, Words::Vector(place)};
       }},
      {{"drag-ray", "F/NODE=ox,oy,oz,dx,dy,dz", "pull a node onto a line: origin, direction"},
       [](W w) { return RayStep(w, false); }},
      {{"settle", "", "restore holds, limits and distances"},
       [](W) -> PoseStep { return Settle{}; }},
      {{"pin", "F/NODE", "drags leave the node where it is"},
       [](W w) -> PoseStep {
         const auto at = w.NodeAt(w.value());
         return Pin{at.figure, at.index, std::nullopt};
       }},
      {{"pin-ray", "F/NODE=ox,oy,oz,dx,dy,dz", "drags keep the node on a line"},
       [](W w) { return RayStep(w, true); }},
      {{"unpin", "F/NODE", "let go of a pinned node"},
       [](W w) -> PoseStep {
         const auto at = w.NodeAt(w.value());
         return Unpin{at.figure, at.index};
       }},
      {{"option", "NAME=on|off",
        "part of the solve: holds, limits, penetration, floor, tangles, feet, root"},
       OptionStep},
      {{"move", "F=x,y,z", "shift a figure (m)"},
       [](W w) -> PoseStep {
         const auto [figure, shift] = w.Pair();
         return MoveFigure{w.Figure(figure), Words::Vector(shift)};
       }},
      {{"turn", "F=yaw|x,y,z", "turn a figure about its root: yaw or rotation vector (degrees)"},
       TurnStep},
      {{"rotate", "F/JOINT=x,y,z[,world]",
        "turn a joint in its own axes or the world's: rotation vector (degrees)"},
       RotateStep},
      {{"set-joint", "F/JOINT=x,y,z", "turn a joint to this rotation vector (degrees)"},
       SetJointStep},
      {{"root", "F=x,y,z[,rx,ry,rz]", "place a root (m, degrees)"}, RootStep},
      {{"stature", "F=m", "scale a figure to this height"},
       [](W w) -> PoseStep {
         const auto [figure, stature] = w.Pair();
         return SetStature{w.Figure(figure), Words::Numbers(stature, {1})[0]};
       }},
      {{"mirror", "a|b|both", "exchange left and right of a figure, or mirror the scene"},
       [](W w) -> PoseStep {
         const int figure = Words::Named(w.value(), "figure", {"a", "b", "both"});
         return Mirror{figure == 2 ? kBoth : figure};
       }},
      {{"swap", "", "a becomes b and b becomes a"}, [](W) -> PoseStep { return SwapFigures{}; }},
      {{"copy-side", "F=left|right", "mirror this side's joints onto the other"},
       [](W w) -> PoseStep {
         const auto [figure, side] = w.Pair();
         return CopySide{w.Figure(figure), Words::Named(side, "side", {"left", "right"}) == 0};
       }},
      {{"reset", "F|F/JOINT", "T-pose of a figure, upright on the floor; or of one joint"},
       ResetStep},
      {{"hold", "F/NODE=F/NODE|world[:x,y,z][,rotation]", "add a hold"},
       [](W w) -> PoseStep { return AddHold{w.HoldFrom(w.value())}; }},
      {{"edit-hold", "K:F/NODE=...", "replace the K-th hold, from 1"},
       [](W w) -> PoseStep {
         const size_t at = w.value().find(':');
         if (at == std::string::npos) throw InputError("expected K:from=to");
         return EditHold{w.HoldIndex(w.value().substr(0, at)),
                         w.HoldFrom(w.value().substr(at + 1))};
       }},
      {{"remove-hold", "K", "remove the K-th hold, from 1"},
       [](W w) -> PoseStep { return RemoveHold{w.HoldIndex(w.value())}; }},
      {{"supports", "F=NODE,NODE", "nodes that may be planted"}, SupportsStep},
      {{"leader", "F=world|partner", "whose motion a root follows"},
       [](W w) -> PoseStep {
         const auto [figure, leader] = w.Pair();
         const bool partner = Words::Named(leader, "leader", {"world", "partner"}) == 1;
         return SetRootLeader{w.Figure(figure),
                              partner ? RootLeader::kPartner : RootLeader::kOwnClip};
       }},
      {{"tangles", "N..N:N..N,...|found", "tangles to keep, path of a:path of b; or those found"},
       TanglesStep},
      {{"name", "TEXT", "name of the template"},
       [](W w) -> PoseStep { return SetName{w.value()}; }},
      {{"description", "TEXT", "what the posture is"},
       [](W w) -> PoseStep { return SetDescription{w.value()}; }},
      {{"tags", "WORD,WORD", "words to find the template by"},
       [](W w) -> PoseStep {
         return SetTags{w.value().empty() ? std::vector<std::string>{} : Split(w.value(), ',')};
       }},
      {{"photo", "FILE|none", "picture behind the studio's view"}, PhotoStep},
      {{"camera", "ex,ey,ez,tx,ty,tz[,fov]|none", "view of the studio (m, degrees)"}, CameraStep},
      {{"undo", "", "take the last operation back"},
       [](W) -> PoseStep { return HistoryStep::kUndo; }},
      {{"redo", "", "do it again"}, [](W) -> PoseStep { return HistoryStep::kRedo; }},
  };
  return entries;
}

}  // namespace

const std::vector<PoseWord>& PoseWords() {
  static const std::vector<PoseWord> words = [] {
    std::vector<PoseWord> all;
    for (const Entry& entry : Entries()) all.push_back(entry.word);
    return all;
  }();
  return words;
}

PoseStep ParsePoseStep(const std::string& name, const std::string& value, const PoseState& state) {
  for (const Entry& entry : Entries()) {
    if (name == entry.word.name) return entry.read(Words(value, state));
  }
  throw InputError("unknown operation");
}

}  // namespace retarget::posing
