#include "solver/problem/terms/tangle.h"

namespace retarget::solver {

TangleTerm::TangleTerm(const Scene& scene) {
  for (const TangleTarget& held : scene.tangles) {
    items_.push_back({TagPaths(scene, held), held.target});
  }
}

void TangleTerm::EvaluatePart(const Frame& frame, int part, Rows* rows) const {
  const Item& item = items_[static_cast<size_t>(part)];
  const TagGli gli(item.paths, frame);
  const double missing = item.target - gli.value();
  if (missing <= 0) return;
  gli.AddTo(rows, rows->Add(missing), -1);
}

}  // namespace retarget::solver
