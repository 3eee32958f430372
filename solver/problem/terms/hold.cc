#include "solver/problem/terms/hold.h"

#include "model/geometry/so3.h"

namespace retarget::solver {
namespace {

int LinkOf(const Frame& frame, const HoldPoint& point) {
  return frame.body(point.figure).nodes[point.node].link;
}

void AddHeldPoint(const Frame& frame, const HoldPoint& point, const Vec3& at, int row,
                  const Vec3& gradient, Rows* rows) {
  if (point.figure == kWorld) return;
  rows->AddPoint(row, point.figure, LinkOf(frame, point), at, gradient);
}

void EvaluateRotation(const Frame& frame, const Hold& hold, Rows* rows) {
  const Mat3& from = frame.posed[hold.from.figure].rotation[LinkOf(frame, hold.from)];
  const bool world = hold.to.figure == kWorld;
  const Mat3 to =
      world ? Mat3(Mat3::Identity()) : frame.posed[hold.to.figure].rotation[LinkOf(frame, hold.to)];
  const Mat3 difference =
      hold.relative_rotation.toRotationMatrix().transpose() * to.transpose() * from;
  const Vec3 angle = LogSo3(Quat(difference));
  const Mat3 jacobian = RightJacobianInverse(angle) * from.transpose();
  for (int k = 0; k < 3; ++k) {
    const Vec3 g = jacobian.row(k).transpose();
    const int row = rows->Add(angle[k]);
    rows->AddTurn(row, hold.from.figure, LinkOf(frame, hold.from), g);
    if (!world) rows->AddTurn(row, hold.to.figure, LinkOf(frame, hold.to), -g);
  }
}

}  // namespace

void AddHoldRows(const Frame& frame, const Hold& hold, Rows* rows) {
  const Vec3 from = HoldPosition(hold.from, frame.scene->body, frame.posed);
  const Vec3 to = HoldPosition(hold.to, frame.scene->body, frame.posed);
  for (int k = 0; k < 3; ++k) {
    const int row = rows->Add(from[k] - to[k]);
    AddHeldPoint(frame, hold.from, from, row, Vec3::Unit(k), rows);
    AddHeldPoint(frame, hold.to, to, row, -Vec3::Unit(k), rows);
  }
  if (hold.rotation) EvaluateRotation(frame, hold, rows);
}

void HoldTerm::EvaluatePart(const Frame& frame, int part, Rows* rows) const {
  AddHoldRows(frame, frame.scene->holds[static_cast<size_t>(part)], rows);
}

}  // namespace retarget::solver
