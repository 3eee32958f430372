#include "model/geometry/so3.h"

#include <cmath>

namespace retarget {

Quat ExpSo3(const Vec3& v) {
  const double angle2 = v.squaredNorm();
  if (angle2 < 1e-16) return Quat(1.0, 0.5 * v.x(), 0.5 * v.y(), 0.5 * v.z()).normalized();
  const double angle = std::sqrt(angle2);
  const double s = std::sin(0.5 * angle) / angle;
  return Quat(std::cos(0.5 * angle), s * v.x(), s * v.y(), s * v.z());
}

Vec3 LogSo3(const Quat& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;  // q and -q are one rotation: take the short way
  const Vec3 v = sign * q.vec();
  const double n = v.norm();
  if (n < 1e-12) return 2.0 * v;
  return 2.0 * std::atan2(n, sign * q.w()) / n * v;
}

Vec3 LogSo3Near(const Quat& q, const Vec3& near) {
  const Vec3 v = LogSo3(q);
  const double angle = v.norm();
  // Every other vector but the one beyond pi lies further out than kLargest.
  constexpr double kLargest = 1.75 * kPi;
  if (2 * kPi - angle > kLargest) return v;
  const Vec3 other = (1 - 2 * kPi / angle) * v;
  return (other - near).squaredNorm() < (v - near).squaredNorm() ? other : v;
}

Mat3 RightJacobian(const Vec3& v) {
  const double angle2 = v.squaredNorm();
  const Mat3 k = Skew(v);
  if (angle2 < 1e-8) return Mat3::Identity() - 0.5 * k + k * k / 6.0;
  const double angle = std::sqrt(angle2);
  return Mat3::Identity() - (1.0 - std::cos(angle)) / angle2 * k +
         (angle - std::sin(angle)) / (angle2 * angle) * k * k;
}

Mat3 RightJacobianInverse(const Vec3& v) {
  const double angle2 = v.squaredNorm();
  const Mat3 k = Skew(v);
  if (angle2 < 1e-8) return Mat3::Identity() + 0.5 * k + k * k / 12.0;
  const double angle = std::sqrt(angle2);
  const double half = 0.5 * angle;
  const double c = 1.0 / angle2 - std::cos(half) / (2.0 * angle * std::sin(half));
  return Mat3::Identity() + 0.5 * k + c * k * k;
}

Quat RotationBetween(const Vec3& from, const Vec3& to) {
  const double w = 1.0 + from.dot(to);
  if (w < 1e-12) {
    const Vec3 other = std::abs(from.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 axis = from.cross(other).normalized();
    return Quat(0.0, axis.x(), axis.y(), axis.z());
  }
  const Vec3 v = from.cross(to);
  return Quat(w, v.x(), v.y(), v.z()).normalized();
}

Quat TwistAbout(const Quat& q, const Vec3& axis) {
  const double along = q.vec().dot(axis);
  const double n = std::hypot(q.w(), along);
  if (n < 1e-9) return Quat::Identity();
  const Vec3 v = along / n * axis;
  return Quat(q.w() / n, v.x(), v.y(), v.z());
}

double YawOf(const Quat& q) { return std::remainder(2.0 * std::atan2(q.y(), q.w()), 2.0 * kPi); }

Quat YawRotation(double yaw) { return Quat(std::cos(0.5 * yaw), 0, std::sin(0.5 * yaw), 0); }

double BestYaw(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double c = 0, s = 0;
  for (size_t n = 1; n < from.size(); ++n) {
    const Vec3 u = from[n] - from[0], v = to[n] - to[0];
    c += u.x() * v.x() + u.z() * v.z();
    s += u.z() * v.x() - u.x() * v.z();
  }
  return std::atan2(s, c);
}

}  // namespace retarget
