#include "solver/problem/terms/tangle_aim.h"

#include <cmath>

namespace retarget::solver {
namespace {
constexpr double kMostPull = 0.25;  // h
}

TangleAim::TangleAim(const Scene& scene) {
  for (const TangleTarget& held : scene.tangles) {
    items_.push_back({TagPaths(scene, held), held.aim});
  }
}

void TangleAim::EvaluatePart(const Frame& frame, int part, Rows* rows) const {
  const Item& item = items_[static_cast<size_t>(part)];
  const TagGli gli(item.paths, frame);
  const double share = std::tanh((item.aim - gli.value()) / kMostPull);
  gli.AddTo(rows, rows->Add(kMostPull * share), -(1 - share * share));
}

}  // namespace retarget::solver
