#include "tools/posing/session.h"

#include <algorithm>
#include <utility>

#include "io/files.h"
#include "io/template_file.h"
#include "model/geometry/so3.h"
#include "solver/start/fit_template.h"
#include "tools/posing/edit.h"
#include "tools/posing/label.h"

namespace retarget::posing {
namespace {

constexpr size_t kMostSteps = 500;  // of the history

// Of an operation by hand; 0: a step of its own.
int GestureOf(const Operation& operation) {
  return std::visit(
      [](const auto& op) {
        if constexpr (requires { op.gesture; }) return op.gesture;
        return 0;
      },
      operation);
}

// A foot on the floor would hold the drag of its own toe or knee back.
bool IsDragged(const solver::PoseTask& task, int figure, int node) {
  const Body& body = task.body[figure];
  const auto near = [&](int f, int n) {
    return f == figure &&
           (n == node || body.nodes[node].parent == n || body.nodes[n].parent == node);
  };
  return std::any_of(task.drags.begin(), task.drags.end(),
                     [&](const solver::NodeTarget& t) { return near(t.figure, t.node); }) ||
         std::any_of(task.drag_rays.begin(), task.drag_rays.end(),
                     [&](const solver::NodeRay& r) { return near(r.figure, r.node); });
}

void AddPins(const PoseState& state, solver::PoseTask* task) {
  const auto drags = [&](int figure, int node) {
    const auto same = [&](const auto& t) { return t.figure == figure && t.node == node; };
    return std::any_of(task->drags.begin(), task->drags.end(), same) ||
           std::any_of(task->drag_rays.begin(), task->drag_rays.end(), same);
  };
  const auto pinned = [&](int figure, int node) {
    return std::any_of(state.pins.begin(), state.pins.end(),
                       [&](const PinnedNode& p) { return p.figure == figure && p.node == node; });
  };
  for (const PinnedNode& pin : state.pins) {
    if (drags(pin.figure, pin.node)) continue;
    if (pin.ray) {
      task->pin_rays.push_back({pin.figure, pin.node, pin.ray->origin, pin.ray->direction});
    } else {
      task->pins.push_back({pin.figure, pin.node, pin.position});
    }
  }
  if (!state.options.feet) return;
  for (int f = 0; f < 2; ++f) {
    const PosedBody posed = PoseBody(task->body[f], task->before[f]);
    const std::vector<int> standing = StandingNodes(task->body[f], posed);
    for (const int n : state.posture.supports[f]) {
      if (std::find(standing.begin(), standing.end(), n) == standing.end()) continue;
      if (!pinned(f, n) && !IsDragged(*task, f, n)) task->pins.push_back({f, n, posed.node[n]});
    }
  }
}

solver::PoseTask TaskOf(const PoseState& state, const TangleSettings& settings,
                        const std::array<Pose, 2>& before,
                        const std::vector<solver::NodeTarget>& drags,
                        const std::vector<solver::NodeRay>& rays) {
  solver::PoseTask task;
  task.body = state.posture.body;
  task.before = before;
  task.drags = drags;
  task.drag_rays = rays;
  task.holds = state.posture.holds;
  if (state.options.tangles) {
    TemplatePosture posture = state.posture;
    posture.pose = before;
    task.tangles = solver::TangleTargets(solver::FindTemplateTangles(posture, settings).tags,
                                         posture, settings.margin);
  }
  AddPins(state, &task);
  return task;
}

solver::PoseSettings SettingsOf(const PoseOptions& options, int most_iterations,
                                double most_seconds) {
  solver::PoseSettings settings = solver::DefaultPoseSettings();
  settings.max_iterations = std::max(most_iterations, 1);
  settings.max_seconds = most_seconds;
  Weights& w = settings.settings.weights;
  if (!options.holds) w.hold = 0;
  if (!options.limits) w.joint_limit = 0;
  if (!options.penetration) w.penetration = w.self_penetration = 0;
  if (!options.floor) w.ground = 0;
  if (options.tangles) w.tangle = 100;
  if (!options.root) w.root_tracking = settings.pin;
  return settings;
}

}  // namespace

PoseSession::PoseSession(TemplatePosture posture, const Settings& settings) : settings_(settings) {
  state_.posture = std::move(posture);
}

void PoseSession::Remember(const std::string& what) {
  if (!joined_ || undo_.empty()) {
    if (undo_.size() >= kMostSteps) undo_.erase(undo_.begin());
    undo_.push_back({state_, what});
  }
  redo_.clear();
  gesture_ = hand_gesture_ = 0;
}

std::optional<solver::PoseResult> PoseSession::Apply(const Operation& operation,
                                                     int most_iterations, double most_seconds) {
  const std::string what = LabelOf(operation, posture());
  if (const Drag* drag = std::get_if<Drag>(&operation)) {
    CheckNode(posture(), drag->figure, drag->node);
    CheckPlace(drag->target, "target");
    return DragTo(solver::NodeTarget{drag->figure, drag->node, drag->target}, std::nullopt,
                  drag->gesture, what, most_iterations, most_seconds);
  }
  if (const DragRay* drag = std::get_if<DragRay>(&operation)) {
    CheckNode(posture(), drag->figure, drag->node);
    CheckPlace(drag->origin, "origin");
    CheckDirection(drag->direction);
    return DragTo(std::nullopt,
                  solver::NodeRay{drag->figure, drag->node, drag->origin, drag->direction},
                  drag->gesture, what, most_iterations, most_seconds);
  }
  if (std::holds_alternative<Settle>(operation)) {
    return DragTo(std::nullopt, std::nullopt, 0, what, most_iterations, most_seconds);
  }
  PoseState next = Edited(state_, operation);
  const int gesture = GestureOf(operation);
  if (gesture == 0 || gesture != hand_gesture_) Remember(what);
  hand_gesture_ = gesture;
  redo_.clear();
  state_ = std::move(next);
  return std::nullopt;
}

solver::PoseResult PoseSession::DragTo(const std::optional<solver::NodeTarget>& target,
                                       const std::optional<solver::NodeRay>& ray, int gesture,
                                       const std::string& what, int most_iterations,
                                       double most_seconds) {
  if (gesture == 0 || gesture != gesture_) {
    Remember(what);
    before_ = posture().pose;
    targets_.clear();
    rays_.clear();
  }
  gesture_ = gesture;
  redo_.clear();
  const int figure = target ? target->figure : ray ? ray->figure : -1;
  const int node = target ? target->node : ray ? ray->node : -1;
  const auto same = [&](const auto& t) { return t.figure == figure && t.node == node; };
  std::erase_if(targets_, same);
  std::erase_if(rays_, same);
  if (target) targets_.push_back(*target);
  if (ray) rays_.push_back(*ray);
  const solver::PoseResult result =
      solver::SolvePose(TaskOf(state_, settings_.tangle, before_, targets_, rays_), posture().pose,
                        SettingsOf(state_.options, most_iterations, most_seconds));
  state_.posture.pose = result.pose;
  for (PinnedNode& pin : state_.pins) {  // a pinned node that is dragged is pinned where it ends
    if (!same(pin)) continue;
    pin.position = PoseBody(posture().body[figure], posture().pose[figure]).node[node];
    pin.ray.reset();
  }
  return result;
}

bool PoseSession::Undo() { return Walk(&undo_, &redo_); }

bool PoseSession::Redo() { return Walk(&redo_, &undo_); }

bool PoseSession::Walk(std::vector<Step>* from, std::vector<Step>* to) {
  if (from->empty()) return false;
  to->push_back({std::move(state_), from->back().what});
  state_ = std::move(from->back().state);
  from->pop_back();
  gesture_ = hand_gesture_ = 0;
  return true;
}

void PoseSession::RenamePhoto(const std::string& from, const std::string& to) {
  const auto rename = [&](PoseState* state) {
    auto& photo = state->posture.photo;
    if (photo && photo->file == from) photo->file = to;
  };
  rename(&state_);
  for (std::vector<Step>* steps : {&undo_, &redo_}) {
    for (Step& step : *steps) rename(&step.state);
  }
}

std::string PoseSession::Text() const {
  const std::string text = io::FormatTemplate(posture());
  io::ParseTemplate(text, posture().name);
  return text;
}

void PoseSession::Save(const std::string& path, bool force) const {
  io::WriteFile(path, Text(), force);
}

TemplatePosture RestPosture(double stature_a, double stature_b, double distance) {
  PoseState state;
  TemplatePosture& posture = state.posture;
  posture.name = "new posture";
  const double stature[2] = {stature_a, stature_b};
  for (int f = 0; f < 2; ++f) {
    posture.body[f] = StandardBody(AverageMeasures(stature[f]));
    posture.pose[f] = RestPose(posture.body[f]);
    posture.pose[f].rotation[0] = YawRotation(f == 0 ? 0 : kPi);
    posture.pose[f].root_position.z() = (f == 0 ? -0.5 : 0.5) * distance;
  }
  for (int f = 0; f < 2; ++f) state = Edited(state, ResetFigure{f});
  for (int f = 0; f < 2; ++f) {
    state.posture.supports[f] = StandingNodes(
        state.posture.body[f], PoseBody(state.posture.body[f], state.posture.pose[f]));
  }
  return state.posture;
}

}  // namespace retarget::posing
