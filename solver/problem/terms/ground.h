// ground: no capsule reaches below the floor.
//   r = max(0, R - p_y)                       (m), per node, R the widest capsule that ends there
// 1 frame, 1 body. YAML: weights.ground.
#pragma once

#include <array>
#include <vector>

#include "model/body/shape.h"
#include "solver/problem/term.h"

namespace retarget::solver {

class Ground : public Term {
 public:
  explicit Ground(const Scene& scene)
      : radius_{NodeRadii(scene.body[0]), NodeRadii(scene.body[1])} {}
  const char* name() const override { return "ground"; }
  const char* unit() const override { return "m"; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  std::array<std::vector<double>, 2> radius_;
};

}  // namespace retarget::solver
