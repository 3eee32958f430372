#include "solver/problem/terms/ground.h"

namespace retarget::solver {

void Ground::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    for (int n = 0; n < frame.body(f).num_nodes(); ++n) {
      const double depth = radius_[f][n] - frame.posed[f].node[n].y();
      if (depth <= 0) continue;
      rows->AddNode(rows->Add(depth), f, n, -Vec3::UnitY());
    }
  }
}

}  // namespace retarget::solver
