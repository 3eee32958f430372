#include "solver/problem/terms/joint_limit.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

struct Angle {
  double value;
  Vec3 gradient;
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

}  // namespace

std::vector<LimitViolation> LimitViolations(const JointLimit& limit, const Quat& rotation) {
  std::vector<LimitViolation> out;
  const Angle twist = Twist(rotation, limit.axis);
  out.push_back({twist.value - limit.twist_max, twist.gradient});
  out.push_back({limit.twist_min - twist.value, -twist.gradient});

  const Vec3 direction = rotation * limit.axis;
  if (limit.swing_max < kPi - 1e-9) {
    const double c = std::clamp(direction.dot(limit.swing_centre), -1.0, 1.0);
    const double s = std::sqrt(std::max(1 - c * c, 1e-12));
    const Vec3 by_direction = -limit.swing_centre / s;
    out.push_back(
        {std::acos(c) - limit.swing_max, DirectionGradient(rotation, limit.axis, by_direction)});
  }
  if (limit.hinge_axis.squaredNorm() > 0) {
    const Vec3 ahead = limit.hinge_axis.cross(limit.axis);
    const double x = direction.dot(limit.axis), y = direction.dot(ahead);
    const double n2 = std::max(x * x + y * y, 1e-9);
    const double bend = std::atan2(y, x);
    const Vec3 g = DirectionGradient(rotation, limit.axis, (x * ahead - y * limit.axis) / n2);
    // Past half a turn the angle wraps: more bent, not bent backwards.
    const double unwrapped = bend < -kPi / 2 ? bend + 2 * kPi : bend;
    out.push_back({limit.bend_min - unwrapped, -g});
    out.push_back({unwrapped - limit.bend_max, g});
    const double side = std::clamp(direction.dot(limit.hinge_axis), -1.0, 1.0);
    const double cosine = std::sqrt(std::max(1 - side * side, 1e-9));
    const Vec3 out_of_plane =
        DirectionGradient(rotation, limit.axis, limit.hinge_axis * (side < 0 ? -1 : 1) / cosine);
    out.push_back({std::abs(std::asin(side)) - limit.hinge_play, out_of_plane});
  }
  return out;
}

void JointLimitTerm::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    const Body& body = frame.body(f);
    for (int l = 1; l < body.num_links(); ++l) {
      const JointLimit& limit = body.links[l].limit;
      const std::vector<LimitViolation> now = LimitViolations(limit, frame.pose[f].rotation[l]);
      const bool any =
          std::any_of(now.begin(), now.end(), [](const LimitViolation& v) { return v.beyond > 0; });
      if (!any) continue;
      const Quat& captured = frame.scene->source[f].frames[frame.t].rotation[l];
      const std::vector<LimitViolation> source = LimitViolations(limit, captured);
      for (size_t k = 0; k < now.size(); ++k) {
        const double beyond = now[k].beyond - std::max(0.0, source[k].beyond);
        if (now[k].beyond <= 0 || beyond <= 0) continue;
        rows->AddJointTurn(rows->Add(beyond), f, l, now[k].gradient);
      }
    }
  }
}

}  // namespace retarget::solver
