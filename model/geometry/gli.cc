#include "model/geometry/gli.h"

#include <algorithm>
#include <cmath>

namespace retarget {
namespace {

// Signed solid angle of a triangle by the four dihedral angles of the parallelogram's cone. Used
// where the one-atan2 form cancels: a crossing at a gap that is tiny beside the segments.
double DihedralGli(const std::array<Vec3, 4>& p, const std::array<double, 4>& n, double volume) {
  std::array<Vec3, 4> m;  // normals of the cone's faces
  for (int i = 0; i < 4; ++i) m[i] = p[i].cross(p[(i + 1) % 4]);
  double angle = 2 * kPi;
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    angle -= std::atan2(n[next] * std::abs(volume), m[i].dot(m[next]));
  }
  return std::copysign(angle / (4 * kPi), volume);
}

double GliFromCorners(const std::array<Vec3, 4>& p, const std::array<double, 4>& n,
                      const Vec3& normal) {
  // The volume is the same from every corner; the shortest loses the fewest digits.
  const int k = static_cast<int>(std::min_element(n.begin(), n.end()) - n.begin());
  const double volume = normal.dot(p[k]);
  if (volume == 0) return 0;
  const double p13 = p[0].dot(p[2]);
  const double n13 = n[0] * n[2];
  const double kk = n13 + p13;
  if (kk < 0.01 * n13) return DihedralGli(p, n, volume);
  // Two triangles (p1 p2 p3), (p1 p3 p4), each by van Oosterom and Strackee 1983; their two
  // arctangents are added as the argument of a product of complex numbers. The clamp keeps the sign
  // where both denominators nearly vanish.
  const double d1 = kk * n[1] + p[0].dot(p[1]) * n[2] + p[1].dot(p[2]) * n[0];
  const double d2 = kk * n[3] + p[0].dot(p[3]) * n[2] + p[2].dot(p[3]) * n[0];
  const double angle =
      std::atan2(std::abs(volume) * std::max(0.0, d1 + d2), d1 * d2 - volume * volume);
  return std::copysign(angle / (2 * kPi), volume);
}

}  // namespace

double SegmentGli(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<Vec3, 4> p = {a - c, b - c, b - d, a - d};
  const std::array<double, 4> n = {p[0].norm(), p[1].norm(), p[2].norm(), p[3].norm()};
  return GliFromCorners(p, n, (b - a).cross(d - c));
}

Vec3 GliEdge(const Vec3& p, const Vec3& q) {
  const Vec3 cross = p.cross(q);
  const double cross2 = cross.squaredNorm();
  if (cross2 == 0) return Vec3::Zero();
  const double product = std::sqrt(p.squaredNorm() * q.squaredNorm());
  const double dot = p.dot(q);
  // Two forms of cross * tan(half the angle) / |cross|; each is free of cancellation on its side.
  if (dot < 0) return cross * ((product - dot) / cross2);
  return cross / (product + dot);
}

SegmentGliGradient SegmentGliWithGradient(const Vec3& a, const Vec3& b, const Vec3& c,
                                          const Vec3& d) {
  const std::array<Vec3, 4> p = {a - c, b - c, b - d, a - d};
  const std::array<double, 4> n = {p[0].norm(), p[1].norm(), p[2].norm(), p[3].norm()};
  SegmentGliGradient out;
  out.value = GliFromCorners(p, n, (b - a).cross(d - c));
  std::array<Vec3, 4> edge;  // edge[i] = e(p_i, p_{i+1})
  for (int i = 0; i < 4; ++i) edge[i] = GliEdge(p[i], p[(i + 1) % 4]);
  std::array<Vec3, 4> h;
  for (int i = 0; i < 4; ++i) {
    h[i] = n[i] > 0 ? Vec3((edge[(i + 3) % 4] + edge[i]) / (4 * kPi * n[i])) : Vec3::Zero();
  }
  out.gradient = {h[0] + h[3], h[1] + h[2], -(h[0] + h[1]), -(h[2] + h[3])};
  return out;
}

}  // namespace retarget
