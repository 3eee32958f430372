// The rotation group SO(3): exponential, logarithm and their right Jacobian.
// Convention, everywhere: a rotation is perturbed on the right, R exp([v]x), v in R^3 (rad) in the
// rotated frame. (Sola, Deray, Atchuthan, "A micro Lie theory", 2018, Eq. 132-145.)
#pragma once

#include <vector>

#include "model/geometry/types.h"

namespace retarget {

// [v]x, the matrix with [v]x w = v x w.
inline Mat3 Skew(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// exp: rotation vector (rad) to unit quaternion.
Quat ExpSo3(const Vec3& v);

// log: unit quaternion to the rotation vector of length at most pi (rad).
Vec3 LogSo3(const Quat& q);

// The rotation vector of `q` (rad) nearest to another one, so that a turn can be followed beyond
// pi: one rotation has the vectors (angle + 2 pi k) axis. Those of 1.75 pi and more are left out,
// since the exponential map is singular at 2 pi.
Vec3 LogSo3Near(const Quat& q, const Vec3& near);

// J_r(v): exp(v + dv) = exp(v) exp(J_r(v) dv) to first order. [3 x 3]
Mat3 RightJacobian(const Vec3& v);

// J_r(v)^-1: log(exp(v) exp(w)) = v + J_r(v)^-1 w to first order. [3 x 3]
Mat3 RightJacobianInverse(const Vec3& v);

// The smallest rotation that turns unit vector `from` onto unit vector `to`. Opposite vectors turn
// about an axis that depends on `from` alone.
Quat RotationBetween(const Vec3& from, const Vec3& to);

// The part of `q` about the unit axis `axis`: q = swing * twist. Identity where `q` turns the axis
// by half a turn and the twist is undefined.
Quat TwistAbout(const Quat& q, const Vec3& axis);

// The turn about the vertical (rad) that best agrees with `q`.
double YawOf(const Quat& q);
Quat YawRotation(double yaw);
// The turn about the vertical (rad) under which points `from` are nearest to points `to` in the
// least squares sense, each seen from its first.
double BestYaw(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

}  // namespace retarget
