#include <algorithm>
#include <cmath>

#include "io/render/capsule_light.h"
#include "io/render/capsule_mesh.h"
#include "io/render/render.h"

namespace retarget::io {

std::vector<RenderCapsule> FigureCapsules(const Body& body, const PosedBody& posed,
                                          const Vec3& colour) {
  std::vector<RenderCapsule> capsules;
  for (int n = 0; n < body.num_nodes(); ++n) {
    const Node& node = body.nodes[n];
    if (node.parent < 0) continue;
    capsules.push_back({posed.node[node.parent], posed.node[n], node.radius, colour});
  }
  if (const auto nose = NoseOf(body)) {
    const Mat3& rotation = posed.rotation[nose->link];
    const Vec3& centre = posed.centre[nose->link];
    capsules.push_back(
        {centre + rotation * nose->a, centre + rotation * nose->b, nose->radius, colour});
  }
  return capsules;
}

RenderCamera CameraAround(const std::vector<RenderCapsule>& capsules, double azimuth,
                          double elevation, double aspect, double fov_y_rad) {
  constexpr double kMargin = 1.06;
  RenderCamera camera;
  camera.fov_y_rad = fov_y_rad;
  const Vec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                  std::cos(azimuth) * std::cos(elevation));
  const Vec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
  const Vec3 up = back.cross(right);
  Vec3 low = Vec3::Constant(kFar), high = -low;  // in the camera's axes
  for (const RenderCapsule& c : capsules) {
    for (const Vec3& end : {c.a, c.b}) {
      const Vec3 p(end.dot(right), end.dot(up), end.dot(back));
      low = low.cwiseMin(p - Vec3::Constant(c.radius));
      high = high.cwiseMax(p + Vec3::Constant(c.radius));
    }
  }
  if (capsules.empty()) return camera;
  const Vec3 middle = 0.5 * (low + high);
  camera.target = middle.x() * right + middle.y() * up + middle.z() * back;

  // A sphere of radius r at (x, y, z) from the target is inside a side plane of the picture where
  // the eye's distance is at least z + (|x| cos h + r) / sin h, h the half angle; so for y.
  const double half_y = 0.5 * fov_y_rad, half_x = std::atan(aspect * std::tan(half_y));
  double distance = 0;
  for (const RenderCapsule& c : capsules) {
    for (const Vec3& end : {c.a, c.b}) {
      const Vec3 p = end - camera.target;
      const double x = std::abs(p.dot(right)), y = std::abs(p.dot(up)), r = kMargin * c.radius;
      distance =
          std::max({distance, p.dot(back) + (kMargin * x * std::cos(half_x) + r) / std::sin(half_x),
                    p.dot(back) + (kMargin * y * std::cos(half_y) + r) / std::sin(half_y)});
    }
  }
  camera.eye = camera.target + distance * back;
  return camera;
}

}  // namespace retarget::io
