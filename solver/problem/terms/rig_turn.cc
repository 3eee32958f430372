#include "solver/problem/terms/rig_turn.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

void RigTurn::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    if (frame.scene->locked_axes[f].empty()) continue;
    const double* x = frame.x + frame.scene->FirstCoordinate(f);
    for (const LockedAxis& axis : frame.scene->locked_axes[f][frame.t]) {
      const Vec3 delta = Eigen::Map<const Vec3>(x + 3 + 3 * axis.link);
      const int row = rows->Add(axis.direction.dot(delta));
      // d omega = J_r(delta) d delta.
      if (rows->derivatives()) {
        rows->AddJointTurn(row, f, axis.link,
                           RightJacobianInverse(delta).transpose() * axis.direction);
      }
    }
  }
}

}  // namespace retarget::solver
