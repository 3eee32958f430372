#include "solver/problem/terms/root_tracking.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

RootTracking::RootTracking(const Scene& scene) : drift_correction_(RootDriftCorrection(scene)) {
  for (int f = 0; f < 2; ++f) relative_[f] = RelativeRootTargets(scene, f);
}

void RootTracking::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    if (!relative_[f].empty()) {
      EvaluateFollower(frame, f, rows);
      continue;
    }
    EvaluateLeader(frame, f, rows);
  }
}

bool RootTracking::EditIsError(const Frame& frame, int figure) const {
  const RootShift& shift = drift_correction_[figure][frame.t];
  const RootShift base = frame.scene->BaseOf(figure, frame.t);
  return relative_[figure].empty() && shift.yaw == base.yaw && shift.shift == base.shift;
}

int RootTracking::row_slots(const Frame& frame) const {
  int rows = 0;
  for (int f = 0; f < 2; ++f) rows += EditIsError(frame, f) ? 0 : 6;
  return rows;
}

void RootTracking::EvaluateLeader(const Frame& frame, int figure, Rows* rows) const {
  const RootShift& shift = drift_correction_[figure][frame.t];
  const Pose& source = frame.scene->source[figure].frames[frame.t];
  const int first = frame.scene->FirstCoordinate(figure);
  if (EditIsError(frame, figure)) {
    for (int c = first; c < first + 6; ++c) rows->AddCoordinate(c, frame.x[c], 1);
    return;
  }
  const Pose target = ShiftedRoot(source, shift);
  const Vec3& p = frame.posed[figure].centre[0];
  const Mat3& now = frame.posed[figure].rotation[0];
  const Vec3 angle = LogSo3(Quat(Mat3(target.rotation[0].toRotationMatrix().transpose() * now)));
  const Mat3 jacobian = RightJacobianInverse(angle) * now.transpose();
  for (int k = 0; k < 3; ++k) {
    const int row = rows->Add(p[k] - target.root_position[k]);
    rows->AddPoint(row, figure, 0, p, Vec3::Unit(k));
    rows->AddTurn(rows->Add(angle[k]), figure, 0, jacobian.row(k).transpose());
  }
}

void RootTracking::EvaluateFollower(const Frame& frame, int figure, Rows* rows) const {
  const int partner = 1 - figure;
  const RelativeRoot& relative = relative_[figure][frame.t];
  const Vec3& p = frame.posed[figure].centre[0];
  const Vec3& q = frame.posed[partner].centre[0];
  const Mat3 target_rotation =
      frame.posed[partner].rotation[0] * relative.rotation.toRotationMatrix();
  const Vec3 target = q + frame.posed[partner].rotation[0] * relative.position;
  // A turn of the partner carries the target with it: d(R_target^T (p - target)) =
  // R_target^T (dp - dq + (p - q) x d omega).
  const Vec3 error = target_rotation.transpose() * (p - target);
  for (int k = 0; k < 3; ++k) {
    const Vec3 g = target_rotation.col(k);
    const int row = rows->Add(error[k]);
    rows->AddPoint(row, figure, 0, p, g);
    rows->AddPoint(row, partner, 0, p, -g);
  }
  const Mat3 difference = target_rotation.transpose() * frame.posed[figure].rotation[0];
  // The base turns as the target does, by the partner's clip: the edit tells on which side of pi.
  const Vec3 edit = Eigen::Map<const Vec3>(frame.x + frame.scene->FirstCoordinate(figure) + 3);
  const Vec3 angle = LogSo3Near(Quat(difference), edit);
  // log(D exp(w)) = log D + J_r^-1 w, w = R^T (d omega_self - d omega_partner).
  const Mat3 jacobian = RightJacobianInverse(angle) * frame.posed[figure].rotation[0].transpose();
  for (int k = 0; k < 3; ++k) {
    const Vec3 g = jacobian.row(k).transpose();
    const int row = rows->Add(angle[k]);
    rows->AddTurn(row, figure, 0, g);
    rows->AddTurn(row, partner, 0, -g);
  }
}

}  // namespace retarget::solver
