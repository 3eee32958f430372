// The visible shape of a figure: triangle meshes of capsules, and a nose, so that one sees where
// the figure looks. Shared by the scene writer and the picture renderer.
#pragma once

#include <optional>
#include <vector>

#include "model/body/body.h"
#include "model/geometry/types.h"

namespace retarget::io {

// Triangles with smooth normals, outward side counter-clockwise.
struct TriangleMesh {
  std::vector<Vec3> position;  // [vertices] (m)
  std::vector<Vec3> normal;    // [vertices] unit length
  std::vector<int> corner;     // [3 x triangles] vertex indices
};

// Appends the capsule of radius `radius` (m) round the segment a..b: kCapsuleVertices vertices. A
// segment of no length gives a sphere.
void AppendCapsule(const Vec3& a, const Vec3& b, double radius, TriangleMesh* mesh);

inline constexpr int kCapsuleSides = 12;  // round the axis
inline constexpr int kCapsuleRings = 4;   // per cap, the last one where cap and tube meet
inline constexpr int kCapsuleVertices = 2 * (1 + kCapsuleSides * kCapsuleRings);

// A small capsule on the front of the head, rigid in link `link` (a, b in that link's frame, m).
struct Nose {
  int link = 0;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  double radius = 0;
};

// None where the body has no segment called "head_top".
std::optional<Nose> NoseOf(const Body& body);

}  // namespace retarget::io
