#include "tools/posing/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/body/shape.h"
#include "model/geometry/so3.h"
#include "tools/posing/content.h"
#include "tools/posing/mirror.h"

namespace retarget::posing {

// Bounds of the template file (io/template_file.h).
constexpr double kFurthest = 1000;                       // m
constexpr double kLeastStature = 0.5, kMostStature = 3;  // m

void CheckFigure(int figure) {
  if (figure != 0 && figure != 1) throw InputError("expected figure a or b");
}

void CheckNode(const TemplatePosture& posture, int figure, int node) {
  CheckFigure(figure);
  if (node < 0 || node >= posture.body[figure].num_nodes()) {
    throw InputError(
        fmt::format("node {}: expected 0 to {}", node, posture.body[figure].num_nodes() - 1));
  }
}

void CheckPlace(const Vec3& place, const char* what) {
  if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kFurthest) {
    throw InputError(
        fmt::format("{}: expected numbers from -{} to {}", what, kFurthest, kFurthest));
  }
}

void CheckDirection(const Vec3& direction) {
  CheckPlace(direction, "direction");
  if (direction.norm() < 1e-9) throw InputError("direction: expected a vector that is not zero");
}

namespace {

Quat Checked(const Quat& rotation) {
  if (!rotation.coeffs().allFinite() || rotation.norm() < 1e-9) {
    throw InputError("rotation: expected finite numbers");
  }
  return rotation.normalized();
}

class Edit {
 public:
  explicit Edit(const PoseState& state) : out_(state), posture_(out_.posture) {}
  PoseState Take() { return std::move(out_); }

  void operator()(const Drag&) {}
  void operator()(const DragRay&) {}
  void operator()(const Settle&) {}

  void operator()(const Pin& op) {
    CheckNode(posture_, op.figure, op.node);
    if (op.ray) {
      CheckPlace(op.ray->origin, "origin");
      CheckDirection(op.ray->direction);
    }
    std::erase_if(out_.pins, [&](const PinnedNode& p) { return Is(p, op.figure, op.node); });
    out_.pins.push_back({op.figure, op.node, PlaceOf(op.figure, op.node), op.ray});
  }
  void operator()(const Unpin& op) {
    CheckNode(posture_, op.figure, op.node);
    if (std::erase_if(out_.pins, [&](const PinnedNode& p) { return Is(p, op.figure, op.node); }) ==
        0) {
      throw InputError(fmt::format("{}/{} is not pinned", op.figure == 0 ? "a" : "b",
                                   posture_.body[op.figure].nodes[op.node].name));
    }
  }
  void operator()(const SetOption& op) { out_.options.*op.option = op.on; }

  void operator()(const MoveFigure& op) {
    CheckFigure(op.figure);
    CheckPlace(op.shift, "shift");
    posture_.pose[op.figure].root_position += op.shift;
    Moved(op.figure);
  }
  void operator()(const TurnFigure& op) { (*this)(RotateJoint{op.figure, 0, op.rotation, true}); }
  void operator()(const RotateJoint& op) {
    Quat& rotation = JointRotation(op.figure, op.link);
    Quat turn = Checked(op.rotation);
    if (op.world) {
      // W P R = P (P^T W P) R, P the parent's rotation in the world.
      Quat parent = Quat::Identity();
      const auto& links = posture_.body[op.figure].links;
      for (int l = links[op.link].parent; l >= 0; l = links[l].parent) {
        parent = posture_.pose[op.figure].rotation[l] * parent;
      }
      rotation = parent.conjugate() * turn * parent * rotation;
    } else {
      rotation = rotation * turn;
    }
    rotation.normalize();
    Moved(op.figure);
  }
  void operator()(const SetJoint& op) {
    JointRotation(op.figure, op.link) = Checked(op.rotation);
    Moved(op.figure);
  }
  void operator()(const SetRoot& op) {
    CheckFigure(op.figure);
    CheckPlace(op.position, "position");
    posture_.pose[op.figure].root_position = op.position;
    if (op.rotation) posture_.pose[op.figure].rotation[0] = Checked(*op.rotation);
    Moved(op.figure);
  }
  void operator()(const SetStature& op) {
    CheckFigure(op.figure);
    if (!(op.stature >= kLeastStature && op.stature <= kMostStature)) {
      throw InputError(
          fmt::format("stature {}: expected {} to {} m", op.stature, kLeastStature, kMostStature));
    }
    const double ratio = op.stature / posture_.body[op.figure].stature;
    posture_.body[op.figure] = ScaledTo(posture_.body[op.figure], op.stature);
    posture_.pose[op.figure].root_position.y() *= ratio;
    for (Hold& hold : posture_.holds) {
      for (HoldPoint* point : {&hold.from, &hold.to}) {
        if (point->figure == op.figure) point->offset *= ratio;
      }
    }
    Moved(op.figure);
  }
  void operator()(const Mirror& op) {
    if (op.figure == kBoth) {
      out_ = MirroredScene(out_);
      return;
    }
    CheckFigure(op.figure);
    out_ = MirroredFigure(out_, op.figure);
    Moved(op.figure);
  }
  void operator()(const SwapFigures&) { out_ = Swapped(out_); }
  void operator()(const CopySide& op) {
    CheckFigure(op.figure);
    out_ = WithSideCopied(out_, op.figure, op.from_left);
    Moved(op.figure);
  }
  void operator()(const ResetJoint& op) {
    JointRotation(op.figure, op.link) = Quat::Identity();
    Moved(op.figure);
  }
  void operator()(const ResetFigure& op) {
    CheckFigure(op.figure);
    const Body& body = posture_.body[op.figure];
    Pose pose = RestPose(body);
    pose.rotation[0] = YawRotation(YawOf(posture_.pose[op.figure].rotation[0]));
    const PosedBody posed = PoseBody(body, pose);
    const std::vector<double> radius = NodeRadii(body);
    double lowest = 0;
    for (int n = 0; n < body.num_nodes(); ++n) {
      lowest = std::min(lowest, posed.node[n].y() - radius[n]);
    }
    pose.root_position = posture_.pose[op.figure].root_position;
    pose.root_position.y() = -lowest;
    posture_.pose[op.figure] = pose;
    Moved(op.figure);
  }

  void operator()(const SetPosture& op) {
    posture_ = op.posture;
    out_.pins.clear();
    out_.document = op.document;
  }

  template <typename Op>
  void operator()(const Op& op) {
    Apply(op, &posture_);
  }

 private:
  static bool Is(const PinnedNode& pin, int figure, int node) {
    return pin.figure == figure && pin.node == node;
  }
  Vec3 PlaceOf(int figure, int node) const {
    return PoseBody(posture_.body[figure], posture_.pose[figure]).node[node];
  }

  // Pins go with a figure that was moved by hand.
  void Moved(int figure) {
    CheckPlace(posture_.pose[figure].root_position, "root position");
    for (PinnedNode& pin : out_.pins) {
      if (pin.figure == figure) pin.position = PlaceOf(figure, pin.node);
    }
  }

  Quat& JointRotation(int figure, int link) {
    CheckFigure(figure);
    if (link < 0 || link >= posture_.body[figure].num_links()) {
      throw InputError(
          fmt::format("joint {}: expected 0 to {}", link, posture_.body[figure].num_links() - 1));
    }
    return posture_.pose[figure].rotation[link];
  }

  PoseState out_;
  TemplatePosture& posture_;
};

}  // namespace

PoseState Edited(const PoseState& state, const Operation& operation) {
  Edit edit(state);
  std::visit(edit, operation);
  return edit.Take();
}

}  // namespace retarget::posing
