#include "io/render/capsule_light.h"

#include <algorithm>
#include <cmath>

namespace retarget::io {
namespace {

// Distance along the ray origin + t direction (unit) to a sphere, or kFar. The origin is outside.
double HitSphere(const Vec3& origin, const Vec3& direction, const Vec3& centre, double radius) {
  const Vec3 from = origin - centre;
  const double half = from.dot(direction);
  const double under_root = half * half - from.squaredNorm() + radius * radius;
  if (under_root < 0 || half > 0) return kFar;
  return -half - std::sqrt(under_root);
}

}  // namespace

double SmoothStep(double low, double high, double x) {
  const double u = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

Solid::Solid(const Vec3& from, const Vec3& to, double capsule_radius, const Vec3& linear_colour)
    : a(from),
      axis(to - from),
      length(axis.norm()),
      radius(capsule_radius),
      reflectance(linear_colour) {
  axis = length > 1e-9 ? Vec3(axis / length) : Vec3::UnitY();
}

Vec3 Solid::Nearest(const Vec3& p) const {
  return PointAt(std::clamp((p - a).dot(axis), 0.0, length));
}

// Meets the infinite tube, and where that is beyond an end, that end's sphere. A ray that misses
// the tube misses the capsule.
double HitSolid(const Vec3& origin, const Vec3& direction, const Solid& s) {
  const Vec3 from = origin - s.a;
  const double from_along = from.dot(s.axis), step_along = direction.dot(s.axis);
  const Vec3 across = from - from_along * s.axis, step = direction - step_along * s.axis;
  const double a = step.squaredNorm(), b = across.dot(step);
  const double c = across.squaredNorm() - s.radius * s.radius;
  if (a < 1e-12) {  // along the axis: the nearer end
    if (c > 0) return kFar;
    return HitSphere(origin, direction, step_along > 0 ? s.a : s.PointAt(s.length), s.radius);
  }
  const double under_root = b * b - a * c;
  if (under_root < 0) return kFar;
  const double t = (-b - std::sqrt(under_root)) / a;
  const double along = from_along + t * step_along;
  if (along < 0) return HitSphere(origin, direction, s.a, s.radius);
  if (along > s.length) return HitSphere(origin, direction, s.PointAt(s.length), s.radius);
  return t > 0 ? t : kFar;
}

// The ray's closest approach to the axis decides: the light is cut off while the gap there, seen
// from p, goes from +kLightSpread to -kLightSpread.
double LightPast(const Solid& s, const Vec3& p, const Vec3& direction) {
  const Vec3 from = p - s.a;
  const double from_along = from.dot(s.axis), step_along = direction.dot(s.axis);
  const double from_step = from.dot(direction);
  // Nearest points of ray and axis line, then clamped in turn to the segment and to the ray.
  const double sine2 = 1.0 - step_along * step_along;
  double along = sine2 > 1e-9 ? (from_along - step_along * from_step) / sine2 : 0.0;
  along = std::clamp(along, 0.0, s.length);
  const double t = std::max(0.0, along * step_along - from_step);
  along = std::clamp(from_along + t * step_along, 0.0, s.length);
  const double gap = (p + t * direction - s.PointAt(along)).norm() - s.radius;
  const double blur = kLightSpread * std::clamp(t, 1e-3, kShadowReach);
  return SmoothStep(-blur, blur, gap);
}

// The solid counts as the sphere round the nearest point of its axis: a sphere of angular radius
// asin(r / d) at angle x from the normal takes (r / d)^2 cos x of the sky.
double SkyPast(const Solid& s, const Vec3& p, const Vec3& n) {
  const Vec3 to = s.Nearest(p) - p;
  const double distance = to.norm();
  const double fade = SmoothStep(s.radius + kDimReach, s.radius, distance);
  if (fade <= 0) return 1.0;
  const double size = std::min(1.0, s.radius / distance);
  return 1.0 - 0.85 * fade * std::max(0.0, n.dot(to) / distance) * size * size;
}

ColumnGrid::ColumnGrid(const std::vector<Solid>& solids, const Vec3& direction, double margin) {
  const Vec3 other = std::abs(direction.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitZ();
  u_ = other.cross(direction).normalized();
  v_ = direction.cross(u_);
  cells_.resize(kCells * kCells);
  if (solids.empty()) return;
  Box all{kFar, -kFar, kFar, -kFar};
  std::vector<Box> boxes;
  for (const Solid& s : solids) {
    const Box box = BoxOf(s, margin);
    all = {std::min(all.low_u, box.low_u), std::max(all.high_u, box.high_u),
           std::min(all.low_v, box.low_v), std::max(all.high_v, box.high_v)};
    boxes.push_back(box);
  }
  low_u_ = all.low_u, low_v_ = all.low_v;
  per_u_ = kCells / (all.high_u - all.low_u), per_v_ = kCells / (all.high_v - all.low_v);
  for (int i = 0; i < static_cast<int>(solids.size()); ++i) Enter(i, boxes[i]);
}

ColumnGrid::Box ColumnGrid::BoxOf(const Solid& solid, double margin) const {
  const Vec3 b = solid.PointAt(solid.length);
  const auto [low_u, high_u] = std::minmax({solid.a.dot(u_), b.dot(u_)});
  const auto [low_v, high_v] = std::minmax({solid.a.dot(v_), b.dot(v_)});
  const double reach = solid.radius + margin;
  return {low_u - reach, high_u + reach, low_v - reach, high_v + reach};
}

void ColumnGrid::Enter(int solid, const Box& box) {
  const auto cell = [](double x) { return std::clamp(static_cast<int>(x), 0, kCells - 1); };
  const int last_u = cell((box.high_u - low_u_) * per_u_);
  const int last_v = cell((box.high_v - low_v_) * per_v_);
  for (int v = cell((box.low_v - low_v_) * per_v_); v <= last_v; ++v) {
    for (int u = cell((box.low_u - low_u_) * per_u_); u <= last_u; ++u) {
      cells_[v * kCells + u].push_back(solid);
    }
  }
}

const std::vector<int>& ColumnGrid::Near(const Vec3& p) const {
  const double u = (p.dot(u_) - low_u_) * per_u_, v = (p.dot(v_) - low_v_) * per_v_;
  if (!(u >= 0 && v >= 0 && u < kCells && v < kCells)) return none_;
  return cells_[static_cast<int>(v) * kCells + static_cast<int>(u)];
}

}  // namespace retarget::io
