// What can be done to a posture, as plain values: the page and the command line speak these alone.
// Figures are 0 (a) and 1 (b); nodes, links and holds are indices.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/template_parts.h"
#include "model/body/template_posture.h"

namespace retarget::posing {

inline constexpr int kBoth = -1;  // both figures

// -- Posing by the solver ------------------------------------------------------------------------

// Steps of one gesture (equal, not 0) are one step of the history; nodes dragged earlier in the
// gesture stay at their last targets.
struct Drag {
  int figure = 0, node = 0;
  Vec3 target = Vec3::Zero();  // m
  int gesture = 0;
};
// To anywhere on a line: a point of a photograph, seen from the camera.
struct DragRay {
  int figure = 0, node = 0;
  Vec3 origin = Vec3::Zero(), direction = -Vec3::UnitZ();
  int gesture = 0;
};
// Restores holds, limits and distances without a drag.
struct Settle {};
// Drags leave a pinned node where it is, or on its ray.
struct PinRay {
  Vec3 origin = Vec3::Zero(), direction = -Vec3::UnitZ();
};
struct Pin {
  int figure = 0, node = 0;
  std::optional<PinRay> ray;
};
struct Unpin {
  int figure = 0, node = 0;
};
// Terms of the solve that are on.
struct PoseOptions {
  bool holds = true, limits = true, penetration = true, floor = true;
  bool tangles = false, feet = true, root = true;
};
struct SolveOption {
  const char* name;
  bool PoseOptions::*on;
};
// feet: standing supports stay where they are; root: the roots may move.
inline constexpr std::array<SolveOption, 7> kSolveOptions = {
    {{"holds", &PoseOptions::holds},
     {"limits", &PoseOptions::limits},
     {"penetration", &PoseOptions::penetration},
     {"floor", &PoseOptions::floor},
     {"tangles", &PoseOptions::tangles},
     {"feet", &PoseOptions::feet},
     {"root", &PoseOptions::root}}};
static_assert(sizeof(PoseOptions) == kSolveOptions.size() * sizeof(bool), "each option has a name");
struct SetOption {
  bool PoseOptions::*option = &PoseOptions::holds;
  bool on = true;
};

// -- Posing by hand: steps of one gesture (equal, not 0) are one step of the history -------------

struct MoveFigure {
  int figure = 0;
  Vec3 shift = Vec3::Zero();  // m
  int gesture = 0;
};
struct TurnFigure {  // about its root, in the world
  int figure = 0;
  Quat rotation = Quat::Identity();
  int gesture = 0;
};
struct RotateJoint {
  int figure = 0, link = 0;
  Quat rotation = Quat::Identity();
  bool world = false;  // about the world's axes, else about the link's own
  int gesture = 0;
};
struct SetJoint {
  int figure = 0, link = 0;
  Quat rotation = Quat::Identity();  // child in parent; of link 0 in the world
  int gesture = 0;
};
struct SetRoot {
  int figure = 0;
  Vec3 position = Vec3::Zero();       // m
  std::optional<Quat> rotation = {};  // without: as it is
  int gesture = 0;
};
struct SetStature {
  int figure = 0;
  double stature = 0;  // m
};
// One figure: left and right in its root's frame, which stays. Both: the scene, through x = 0.
struct Mirror {
  int figure = kBoth;
};
struct SwapFigures {};
struct CopySide {
  int figure = 0;
  bool from_left = true;
};
struct ResetJoint {
  int figure = 0, link = 0;
};
struct ResetFigure {  // T-pose, upright on the floor
  int figure = 0;
};

// -- What the posture says -----------------------------------------------------------------------

using io::HoldRequest;
struct AddHold {
  HoldRequest hold;
};
struct EditHold {
  int index = 0;
  HoldRequest hold;
};
struct RemoveHold {
  int index = 0;
};
struct SetSupports {
  int figure = 0;
  std::vector<int> nodes;
};
struct SetRootReference {
  int figure = 0;
  RootReference leader = RootReference::kOwnClip;
};
// The tangles to keep; empty: those that are found.
struct SetTangles {
  std::vector<TangleRequest> tangles;
};
struct SetName {
  std::string name;
};
struct SetDescription {
  std::string description;
};
struct SetTags {  // words to find the template by
  std::vector<std::string> tags;
};
struct SetPhoto {
  std::optional<TemplatePhoto> photo;
};
struct SetCamera {
  std::optional<TemplateCamera> camera;
};
// Another posture in place of this one; the pins go.
struct SetPosture {
  TemplatePosture posture;
  int document = 0;  // PoseState::document from here on
};

using Operation =
    std::variant<Drag, DragRay, Settle, Pin, Unpin, SetOption, MoveFigure, TurnFigure, RotateJoint,
                 SetJoint, SetRoot, SetStature, Mirror, SwapFigures, CopySide, ResetJoint,
                 ResetFigure, AddHold, EditHold, RemoveHold, SetSupports, SetRootReference,
                 SetTangles, SetName, SetDescription, SetTags, SetPhoto, SetCamera, SetPosture>;

enum class HistoryStep { kUndo, kRedo };
using PoseStep = std::variant<Operation, HistoryStep>;

}  // namespace retarget::posing
