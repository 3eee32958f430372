// ray: a node lies on a line, for points that are known in a photograph only,
//   r = (u . (p - o), v . (p - o))            (m), u and v at right angles to the line and each
//   other
// 1 frame, 1 body. Posing alone (solver/optimizer/pose_solve.h); no YAML key.
#pragma once

#include <utility>
#include <vector>

#include "solver/problem/term.h"

namespace retarget::solver {

// The line origin + s direction, s any number.
struct NodeRay {
  int figure = 0;
  int node = 0;
  Vec3 origin = Vec3::Zero();       // m
  Vec3 direction = -Vec3::UnitZ();  // of any length but zero
};

// Distance of a point from the line, as a vector from the line to the point (m).
Vec3 FromRay(const NodeRay& ray, const Vec3& point);

class RayTerm : public Term {
 public:
  explicit RayTerm(std::vector<NodeRay> rays) : rays_(std::move(rays)) {}
  const char* name() const override { return "ray"; }
  const char* unit() const override { return "m"; }
  int row_slots(const Frame&) const override { return 2 * static_cast<int>(rays_.size()); }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  std::vector<NodeRay> rays_;
};

}  // namespace retarget::solver
