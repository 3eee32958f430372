#include "tools/posing/content.h"

#include <fmt/format.h>

#include <set>

#include "tools/posing/edit.h"

namespace retarget::posing {
namespace {

constexpr size_t kMostHolds = 100;

void CheckHold(int index, const TemplatePosture& posture) {
  const int holds = static_cast<int>(posture.holds.size());
  if (index < 0 || index >= holds) {
    throw InputError(fmt::format("hold {}: the posture has {} holds", index + 1, holds));
  }
}

Hold HoldOf(const HoldRequest& request, const TemplatePosture& posture) {
  CheckNode(posture, request.from.figure, request.from.node);
  CheckPlace(request.from.offset, "offset");
  const bool world = request.to_figure == kWorld;
  if (!world) CheckNode(posture, request.to_figure, request.to_node);
  if (request.from.figure == request.to_figure && request.from.node == request.to_node) {
    throw InputError("hold: expected two different points, found the same node twice");
  }
  const Hold hold = io::MakeHold(request, posture.body, PosedFigures(posture));
  CheckPlace(hold.to.offset, "offset");
  return hold;
}

}  // namespace

void Apply(const AddHold& op, TemplatePosture* posture) {
  if (posture->holds.size() >= kMostHolds) {
    throw InputError(fmt::format("hold: the posture has {} already", kMostHolds));
  }
  posture->holds.push_back(HoldOf(op.hold, *posture));
}

void Apply(const EditHold& op, TemplatePosture* posture) {
  CheckHold(op.index, *posture);
  posture->holds[op.index] = HoldOf(op.hold, *posture);
}

void Apply(const RemoveHold& op, TemplatePosture* posture) {
  CheckHold(op.index, *posture);
  posture->holds.erase(posture->holds.begin() + op.index);
}

void Apply(const SetSupports& op, TemplatePosture* posture) {
  for (const int n : op.nodes) CheckNode(*posture, op.figure, n);
  CheckFigure(op.figure);
  if (std::set<int>(op.nodes.begin(), op.nodes.end()).size() != op.nodes.size()) {
    throw InputError("supports: expected every node once");
  }
  posture->supports[op.figure] = op.nodes;
}

void Apply(const SetRootReference& op, TemplatePosture* posture) {
  CheckFigure(op.figure);
  if (op.leader == RootReference::kPartner &&
      posture->root[1 - op.figure] == RootReference::kPartner) {
    throw InputError("root: at most one figure may follow its partner");
  }
  posture->root[op.figure] = op.leader;
}

void Apply(const SetTangles& op, TemplatePosture* posture) {
  for (const TangleRequest& tangle : op.tangles) {
    for (int f = 0; f < 2; ++f) {
      const Path& path = f == 0 ? tangle.a : tangle.b;
      CheckNode(*posture, f, path.from);
      CheckNode(*posture, f, path.to);
      if (path.from >= path.to) {
        throw InputError("tangles: expected paths between two nodes, the lower index first");
      }
    }
  }
  posture->tangles = op.tangles;
}

void Apply(const SetName& op, TemplatePosture* posture) { posture->name = op.name; }

void Apply(const SetDescription& op, TemplatePosture* posture) {
  posture->description = op.description;
}

void Apply(const SetTags& op, TemplatePosture* posture) { posture->keywords = op.tags; }

void Apply(const SetPhoto& op, TemplatePosture* posture) {
  if (op.photo) {
    const TemplatePhoto& p = *op.photo;
    const bool good = p.opacity >= 0 && p.opacity <= 1 && p.scale >= 1e-4 && p.scale <= 1e4 &&
                      p.offset.allFinite() && p.offset.cwiseAbs().maxCoeff() <= 1e5;
    if (!good) throw InputError("photo: expected an opacity from 0 to 1 and a scale over 0");
  }
  posture->photo = op.photo;
}

void Apply(const SetCamera& op, TemplatePosture* posture) {
  if (op.camera) {
    CheckPlace(op.camera->eye, "camera");
    CheckPlace(op.camera->target, "camera");
    CheckDirection(op.camera->target - op.camera->eye);
    if (!(op.camera->fov_deg >= 1 && op.camera->fov_deg <= 179)) {
      throw InputError("camera: expected a field of view from 1 to 179 degrees");
    }
  }
  posture->camera = op.camera;
}

}  // namespace retarget::posing
