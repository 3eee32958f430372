#include "io/render/capsule_mesh.h"

#include <array>
#include <cmath>

namespace retarget::io {
namespace {

// Two unit vectors that complete the unit vector `axis` to a right-handed frame (u, v, axis).
std::array<Vec3, 2> Across(const Vec3& axis) {
  const Vec3 other = std::abs(axis.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 u = other.cross(axis).normalized();
  return {u, axis.cross(u)};
}

void AppendTriangle(int a, int b, int c, TriangleMesh* mesh) {
  mesh->corner.insert(mesh->corner.end(), {a, b, c});
}

}  // namespace

void AppendCapsule(const Vec3& a, const Vec3& b, double radius, TriangleMesh* mesh) {
  const double length = (b - a).norm();
  const Vec3 axis = length > 1e-9 ? Vec3((b - a) / length) : Vec3::UnitY();
  const auto [u, v] = Across(axis);
  const int first = static_cast<int>(mesh->position.size());
  const auto add = [&](const Vec3& centre, const Vec3& normal) {
    mesh->position.push_back(centre + radius * normal);
    mesh->normal.push_back(normal);
  };

  // Latitude runs from the pole behind a, over the two equators, to the pole beyond b.
  add(a, -axis);
  for (int ring = 1; ring <= 2 * kCapsuleRings; ++ring) {
    const bool near_a = ring <= kCapsuleRings;
    const double latitude = (near_a ? ring : ring - 1) * 0.5 * kPi / kCapsuleRings;
    for (int side = 0; side < kCapsuleSides; ++side) {
      const double longitude = 2.0 * kPi * side / kCapsuleSides;
      const Vec3 out = std::cos(longitude) * u + std::sin(longitude) * v;
      add(near_a ? a : b, std::sin(latitude) * out - std::cos(latitude) * axis);
    }
  }
  add(b, axis);

  const auto vertex = [&](int ring, int side) {
    return first + 1 + (ring - 1) * kCapsuleSides + side % kCapsuleSides;
  };
  const int last = first + kCapsuleVertices - 1;
  for (int side = 0; side < kCapsuleSides; ++side) {
    AppendTriangle(first, vertex(1, side + 1), vertex(1, side), mesh);
    for (int ring = 1; ring < 2 * kCapsuleRings; ++ring) {
      const int p = vertex(ring, side), q = vertex(ring, side + 1);
      const int r = vertex(ring + 1, side), s = vertex(ring + 1, side + 1);
      AppendTriangle(p, q, s, mesh);
      AppendTriangle(p, s, r, mesh);
    }
    AppendTriangle(last, vertex(2 * kCapsuleRings, side), vertex(2 * kCapsuleRings, side + 1),
                   mesh);
  }
}

std::optional<Nose> NoseOf(const Body& body) {
  for (const Node& node : body.nodes) {
    if (node.name != "head_top") continue;
    Nose nose;
    nose.link = node.link;
    nose.a = 0.68 * node.offset + 0.85 * node.radius * Vec3::UnitZ();
    nose.b = 0.55 * node.offset + 1.12 * node.radius * Vec3::UnitZ();
    nose.radius = 0.26 * node.radius;
    return nose;
  }
  return std::nullopt;
}

}  // namespace retarget::io
