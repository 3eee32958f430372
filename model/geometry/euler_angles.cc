#include "model/geometry/euler_angles.h"

#include <algorithm>
#include <cmath>

namespace retarget {
namespace {

// The axes of R_i(a) R_j(b) R_k(c).
struct EulerOrder {
  int i, j, k;
  double sign;  // +1 if (i, j, k) is an even permutation of (x, y, z)
  explicit EulerOrder(const std::array<int, 3>& axes)
      : i(axes[0]), j(axes[1]), k(axes[2]), sign((j - i + 3) % 3 == 1 ? 1.0 : -1.0) {}
};

double NearestTurn(double angle, double previous) {
  return angle + 2 * kPi * std::round((previous - angle) / (2 * kPi));
}

// The angles b and c that complete a given first angle a.
Vec3 CompleteAngles(const Mat3& r, const EulerOrder& o, double a) {
  const Mat3 rest = Eigen::AngleAxisd(-a, Vec3::Unit(o.i)).toRotationMatrix() * r;  // R_j(b) R_k(c)
  return {a, std::atan2(o.sign * rest(o.i, o.k), rest(o.k, o.k)),
          std::atan2(o.sign * rest(o.j, o.i), rest(o.j, o.j))};
}

}  // namespace

Quat AxisTurn(int axis, double angle) {
  Quat q(std::cos(angle / 2), 0, 0, 0);
  q.vec()[axis] = std::sin(angle / 2);
  return q;
}

std::array<int, 3> CompleteAxes(std::span<const int> axes) {
  std::array<int, 3> out = {-1, -1, -1};
  size_t n = 0;
  const auto add = [&](int axis) {
    if (std::find(out.begin(), out.end(), axis) == out.end()) out[n++] = axis;
  };
  for (int axis : axes) add(axis);
  for (int axis = 0; axis < 3; ++axis) add(axis);
  return out;
}

Vec3 EulerAngles(const Mat3& r, const std::array<int, 3>& axes, const Vec3& previous) {
  // Below it the first angle is noise, and any choice of it errs by less than this (rad).
  constexpr double kGimbalLock = 1e-7;
  const EulerOrder o(axes);
  const bool locked = std::hypot(r(o.j, o.k), r(o.k, o.k)) < kGimbalLock;
  const double a = locked ? previous[0] : std::atan2(-o.sign * r(o.j, o.k), r(o.k, o.k));
  Vec3 best = Vec3::Zero();
  double best_distance = -1;
  for (double first : {a, a + kPi}) {
    Vec3 triple = CompleteAngles(r, o, first);
    for (int n = 0; n < 3; ++n) triple[n] = NearestTurn(triple[n], previous[n]);
    const double distance = (triple - previous).squaredNorm();
    if (best_distance < 0 || distance < best_distance) {
      best = triple;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace retarget
