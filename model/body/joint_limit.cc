#include "model/body/joint_limit.h"

#include <algorithm>
#include <cmath>

#include "model/body/body.h"
#include "model/body/pose.h"

namespace retarget {
namespace {

struct Angle {
  double value;
  Vec3 gradient;  // by R -> R exp(w)
};

// Twist about the axis, 2 atan2(v.a, w) of the quaternion (w, v), in (-pi, pi].
Angle Twist(const Quat& rotation, const Vec3& axis) {
  const double sign = rotation.w() < 0 ? -1 : 1;
  const double w = sign * rotation.w();
  const Vec3 v = sign * rotation.vec();
  const double along = v.dot(axis);
  const double n2 = w * w + along * along;
  if (n2 < 1e-12) return {0, Vec3::Zero()};  // half a turn of swing: the twist is undefined
  // dq = 1/2 q (0, w): dw = -v.w/2, dv = (w w + v x w)/2.
  return {2 * std::atan2(along, w), (w * (w * axis + axis.cross(v)) + along * v) / n2};
}

// Gradient of f(R axis) by a turn, from df/d(direction): d(R a) = R (w x a).
Vec3 DirectionGradient(const Quat& rotation, const Vec3& axis, const Vec3& by_direction) {
  return axis.cross(rotation.conjugate() * by_direction);
}

struct Value {
  double value;
  Vec3 by_direction;
};

// How far direction d lies beyond the ellipse of swings about c: |w| - |w| / rho, with w the
// rotation vector from c to d and rho = |(u / U, v / V)|, which is 1 on the ellipse.
Value BeyondEllipse(const JointLimit& limit, const Vec3& c, const Vec3& d) {
  const Vec3 across = c.cross(d);
  const double cosine = std::clamp(c.dot(d), -1.0, 1.0);
  const double angle = std::atan2(across.norm(), cosine);
  const double sine = std::max(std::sin(angle), 1e-6);
  const double stretch = angle < 1e-6 ? 1 : angle / sine;
  const Vec3 e = limit.swing_axis, f = c.cross(e);
  const double u = stretch * across.dot(e), v = stretch * across.dot(f);
  const double most_u = u < 0 ? -limit.swing_min : limit.swing_max;
  const double most_v = v < 0 ? -limit.side_min : limit.side_max;
  const double rho = std::hypot(u / most_u, v / most_v);
  if (rho < 1e-9) return {-std::min(most_u, most_v), Vec3::Zero()};  // far within
  const double beyond = angle - angle / rho;
  // By w: w / |w| (1 - 1 / rho) + |w| / rho^2 grad rho.
  const double inward = 1 / std::max(angle, 1e-9) * (1 - 1 / rho);
  const double outward = angle / (rho * rho * rho);
  const Vec3 by_w = (inward * u + outward * u / (most_u * most_u)) * e +
                    (inward * v + outward * v / (most_v * most_v)) * f;
  // w = stretch(angle) c x d; d stretch / d angle = (sin - angle cos) / sin^2, d angle = -c.dd/sin.
  const double by_angle = (sine - angle * cosine) / (sine * sine);
  return {beyond, stretch * by_w.cross(c) - by_w.dot(across) * by_angle / sine * c};
}

// Of a wrist, R = twist * swing: the parent's bone as the hand sees it, R^-1 a, mirrored about a.
LimitExcess BeyondOwnEllipse(const JointLimit& limit, const Quat& rotation) {
  const Vec3& a = limit.axis;
  const Vec3 seen = rotation.conjugate() * a;
  const Value beyond = BeyondEllipse(limit, a, 2 * seen.dot(a) * a - seen);
  const Vec3 by_seen = 2 * beyond.by_direction.dot(a) * a - beyond.by_direction;
  return {beyond.value, by_seen.cross(seen)};  // d(R^-1 a) = -w x R^-1 a
}

void AddHinge(const JointLimit& limit, const Quat& rotation, std::vector<LimitExcess>* out) {
  const Vec3 direction = rotation * limit.axis;
  const Vec3 ahead = limit.hinge_axis.cross(limit.axis);
  const double x = direction.dot(limit.axis), y = direction.dot(ahead);
  const double n2 = std::max(x * x + y * y, 1e-9);
  const double bend = std::atan2(y, x);
  const Vec3 g = DirectionGradient(rotation, limit.axis, (x * ahead - y * limit.axis) / n2);
  // Past half a turn the angle wraps: more bent, not bent backwards.
  const double unwrapped = bend < -kPi / 2 ? bend + 2 * kPi : bend;
  out->push_back({limit.bend_min - unwrapped, -g});
  out->push_back({unwrapped - limit.bend_max, g});
  const double side = std::clamp(direction.dot(limit.hinge_axis), -1.0, 1.0);
  const double cosine = std::sqrt(std::max(1 - side * side, 1e-9));
  const Vec3 out_of_plane =
      DirectionGradient(rotation, limit.axis, limit.hinge_axis * (side < 0 ? -1 : 1) / cosine);
  out->push_back({std::abs(std::asin(side)) - limit.hinge_play, out_of_plane});
}

}  // namespace

bool JointLimit::has_swing() const {
  const double most = kPi - 1e-9;
  return swing_min > -most || swing_max < most || side_min > -most || side_max < most;
}

std::vector<LimitExcess> LimitExcesses(const JointLimit& limit, const Quat& rotation,
                                       const Quat& parent, const Vec3& parent_axis) {
  std::vector<LimitExcess> out;
  // By a turn w of R, R middle^-1 turns by middle w.
  const Vec3 centre = limit.middle * limit.axis;
  Angle twist = Twist(rotation * limit.middle.conjugate(), centre);
  twist.gradient = limit.middle.conjugate() * twist.gradient;
  out.push_back({twist.value - limit.twist_max, twist.gradient});
  out.push_back({limit.twist_min - twist.value, -twist.gradient});
  if (limit.turns_with_parent) {
    const Angle of_parent = Twist(parent, parent_axis);
    const double both = twist.value + of_parent.value;
    out.push_back({both - limit.with_parent_max, twist.gradient, of_parent.gradient});
    out.push_back({limit.with_parent_min - both, -twist.gradient, -of_parent.gradient});
  }
  const Vec3 direction = rotation * limit.axis;
  if (limit.has_swing() && limit.turns_with_parent) {
    out.push_back(BeyondOwnEllipse(limit, rotation));
  } else if (limit.has_swing()) {
    const Value beyond = BeyondEllipse(limit, centre, direction);
    out.push_back({beyond.value, DirectionGradient(rotation, limit.axis, beyond.by_direction)});
  }
  if (limit.reach < kPi - 1e-9) {
    const double c = std::clamp(direction.dot(limit.reach_centre), -1.0, 1.0);
    const double s = std::sqrt(std::max(1 - c * c, 1e-12));
    out.push_back({std::acos(c) - limit.reach,
                   DirectionGradient(rotation, limit.axis, -limit.reach_centre / s)});
  }
  if (limit.is_hinge()) AddHinge(limit, rotation, &out);
  return out;
}

std::vector<LimitExcess> LimitExcesses(const Body& body, int link, const Pose& pose) {
  const int parent = body.links[link].parent;
  return LimitExcesses(body.links[link].limit, pose.rotation[link], pose.rotation[parent],
                       body.links[parent].limit.axis);
}

double FurthestBeyondLimit(const Body& body, int link, const Pose& pose) {
  double furthest = -kPi;
  for (const LimitExcess& e : LimitExcesses(body, link, pose)) {
    furthest = std::max(furthest, e.beyond);
  }
  return furthest;
}

}  // namespace retarget
