#include "solver/proof/advancement_geometry.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

// Signed solid angle of three directions (van Oosterom and Strackee 1983).
double SolidAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
}

}  // namespace

double EndDistance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double l2 = ab.dot(ab);
  const double s = l2 > 0 ? std::clamp((p - a).dot(ab) / l2, 0.0, 1.0) : 0;
  return (p - (a + s * ab)).norm();
}

double SegmentDistance(const MovingLine& x, const MovingLine& y) {
  const Vec3 &a = x.from.p, &b = x.to.p, &c = y.from.p, &d = y.to.p;
  double least = std::min(std::min(EndDistance(a, c, d), EndDistance(b, c, d)),
                          std::min(EndDistance(c, a, b), EndDistance(d, a, b)));
  const Vec3 u = b - a, v = d - c, across = u.cross(v);
  const double n2 = across.squaredNorm();
  if (n2 <= 1e-20 * u.squaredNorm() * v.squaredNorm()) return least;
  const Vec3 w = c - a;
  const double s = w.cross(v).dot(across) / n2, t = w.cross(u).dot(across) / n2;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
    least = std::min(least, std::abs(w.dot(across)) / std::sqrt(n2));
  }
  return least;
}

Relative RelativeOf(const PointState& p, const PointState& q) {
  return {(p.v - q.v).norm(), p.a + q.a};
}
Relative RelativeOf(const MovingLine& x, const MovingLine& y) {
  Relative most;
  for (const PointState* p : {&x.from, &x.to}) {
    for (const PointState* q : {&y.from, &y.to}) {
      const Relative r = RelativeOf(*p, *q);
      most.v = std::max(most.v, r.v);
      most.a = std::max(most.a, r.a);
    }
  }
  return most;
}

double StepFor(double slack, const Relative& r) {
  if (slack <= 0) return 0;
  const double root = std::sqrt(r.v * r.v + 2 * r.a * slack);
  return r.v + root > 0 ? 0.999 * 2 * slack / (r.v + root) : 2;
}

double PairGli(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p1 = a - c, p2 = b - c, p3 = b - d, p4 = a - d;
  if (std::min(std::min(p1.norm(), p2.norm()), std::min(p3.norm(), p4.norm())) == 0) return 0;
  return -(SolidAngle(p1, p2, p3) + SolidAngle(p1, p3, p4)) / (4 * kPi);
}

std::vector<int> PathNodes(const Body& body, const Path& path) {
  // Up from both ends to where they join.
  std::vector<int> front, back;
  int a = path.from, b = path.to;
  while (a != b) {
    if (a > b) {
      front.push_back(a);
      a = body.nodes[a].parent;
    } else {
      back.push_back(b);
      b = body.nodes[b].parent;
    }
  }
  front.push_back(a);
  front.insert(front.end(), back.rbegin(), back.rend());
  return front;
}

}  // namespace retarget::solver
