#include "solver/problem/terms/ray.h"

namespace retarget::solver {

Vec3 FromRay(const NodeRay& ray, const Vec3& point) {
  const Vec3 along = ray.direction.normalized();
  const Vec3 from = point - ray.origin;
  return from - along * along.dot(from);
}

void RayTerm::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (const NodeRay& ray : rays_) {
    const Vec3 along = ray.direction.normalized();
    const Vec3 u = along.unitOrthogonal();
    const Vec3 from = frame.posed[ray.figure].node[ray.node] - ray.origin;
    for (const Vec3& side : {u, Vec3(along.cross(u))}) {
      rows->AddNode(rows->Add(side.dot(from)), ray.figure, ray.node, side);
    }
  }
}

}  // namespace retarget::solver
