// How rays and light meet capsules: the geometry under the renderer, in closed forms.
#pragma once

#include <limits>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

inline constexpr double kFar = std::numeric_limits<double>::infinity();

// 0 at `low` and before, 1 at `high` and beyond, smooth between. `low` may be above `high`.
double SmoothStep(double low, double high, double x);

// A capsule with what every ray needs of it.
struct Solid {
  Vec3 a, axis;                   // axis: unit direction of the segment from a
  double length = 0, radius = 0;  // m
  Vec3 reflectance;               // linear, components in [0, 1]

  Solid(const Vec3& a, const Vec3& b, double radius, const Vec3& reflectance);
  Vec3 PointAt(double along) const { return a + along * axis; }
  // The point of the segment nearest to p.
  Vec3 Nearest(const Vec3& p) const;
};

// Distance along the ray origin + t direction (unit) to the solid, or kFar. The origin is outside.
double HitSolid(const Vec3& origin, const Vec3& direction, const Solid& s);

// A light of this half size as seen from everywhere (rad) makes shadows blur with distance, up to
// the distance kShadowReach (m).
inline constexpr double kLightSpread = 0.05;
inline constexpr double kShadowReach = 2.5;

// Share of the light from `direction` (unit) that passes `s` on its way to p, in [0, 1].
double LightPast(const Solid& s, const Vec3& p, const Vec3& direction);

// Solids further from a point than this take nothing of its sky (m, from their surface).
inline constexpr double kDimReach = 0.6;

// Share of the sky over a surface point p with unit normal n that `s` leaves open, in [0, 1].
double SkyPast(const Solid& s, const Vec3& p, const Vec3& n);

// Which solids may matter for points in a column along a fixed direction: a grid across it.
class ColumnGrid {
 public:
  // `direction` has unit length. Solids count `margin` beyond their surface (m).
  ColumnGrid(const std::vector<Solid>& solids, const Vec3& direction, double margin);

  // Indices of the solids to look at for p, ascending.
  const std::vector<int>& Near(const Vec3& p) const;

 private:
  struct Box {
    double low_u, high_u, low_v, high_v;
  };
  static constexpr int kCells = 48;  // along each side

  Box BoxOf(const Solid& solid, double margin) const;
  void Enter(int solid, const Box& box);

  Vec3 u_, v_;
  double low_u_ = 0, low_v_ = 0, per_u_ = 0, per_v_ = 0;
  std::vector<std::vector<int>> cells_;  // [kCells x kCells]
  std::vector<int> none_;
};

}  // namespace retarget::io
