#include "solver/problem/terms/rig_turn.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

void RigTurn::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    if (frame.scene->stiff[f].empty()) continue;
    const double* x = frame.x + frame.scene->FirstCoordinate(f);
    for (const StiffTurn& stiff : frame.scene->stiff[f][frame.t]) {
      const Vec3 delta = Eigen::Map<const Vec3>(x + 3 + 3 * stiff.link);
      const int row = rows->Add(stiff.direction.dot(delta));
      // d omega = J_r(delta) d delta.
      if (rows->derivatives()) {
        rows->AddJointTurn(row, f, stiff.link,
                           RightJacobianInverse(delta).transpose() * stiff.direction);
      }
    }
  }
}

}  // namespace retarget::solver
