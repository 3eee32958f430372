#include "solver/problem/frame.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

void Frame::Set(const Scene& s, const Unknowns& unknowns, int frame, bool derivatives) {
  scene = &s;
  t = frame;
  x = unknowns.edit.col(frame).data();
  anchor = &unknowns.anchor;
  for (int f = 0; f < 2; ++f) {
    const double* xf = x + s.FirstCoordinate(f);
    EditedPose(s, f, t, unknowns.edit, &pose[f]);
    PoseBody(s.body[f], pose[f], &posed[f]);
    dexp[f].clear();
    if (!derivatives) continue;
    dexp[f].resize(s.body[f].links.size());
    for (size_t l = 0; l < dexp[f].size(); ++l) {
      const Vec3 delta = Eigen::Map<const Vec3>(xf + 3 + 3 * l);
      dexp[f][l].noalias() = posed[f].rotation[l] * RightJacobian(delta);
    }
  }
}

}  // namespace retarget::solver
