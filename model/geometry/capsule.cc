#include "model/geometry/capsule.h"

#include <algorithm>
#include <cmath>

namespace retarget {

ClosestPoints ClosestPointsOfSegments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  const double uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double tiny = 1e-18;
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  ClosestPoints out;
  if (uu <= tiny && vv <= tiny) {
    out.s = out.t = 0;
  } else if (uu <= tiny) {
    out.t = clamp(vw / vv);
  } else if (vv <= tiny) {
    out.s = clamp(-uw / uu);
  } else {
    const double denominator = uu * vv - uv * uv;
    // Parallel axes: any s serves; the middle of the overlap changes least when they tilt.
    out.s = denominator > 1e-12 * uu * vv ? clamp((uv * vw - vv * uw) / denominator) : 0.5;
    out.t = (uv * out.s + vw) / vv;
    if (out.t < 0) {
      out.t = 0;
      out.s = clamp(-uw / uu);
    } else if (out.t > 1) {
      out.t = 1;
      out.s = clamp((uv - uw) / uu);
    } else if (denominator <= 1e-12 * uu * vv) {
      out.s = clamp((uv * out.t - uw) / uu);
    }
  }
  const Vec3 separation = w + out.s * u - out.t * v;
  out.distance = separation.norm();
  if (out.distance > 1e-12) {
    out.normal = separation / out.distance;
  } else {
    const Vec3 across = u.cross(v);
    const double n = across.norm();
    out.normal = n > 1e-12 ? Vec3(across / n) : Vec3::UnitY();
  }
  return out;
}

}  // namespace retarget
