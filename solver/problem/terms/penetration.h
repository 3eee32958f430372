// penetration: the bodies do not overlap.
//   r = max(0, R_i + R_j - |p - q|)           (m), p, q the closest points of two capsule axes
// over all segments of a against all of b. By the envelope theorem the derivative is that of the
// distance at fixed axis parameters. self_penetration is the same within each body, over pairs at
// least two segments apart, and only beyond what the source itself shows in that frame.
// 1 frame, 2 bodies (1). YAML: weights.penetration, weights.self_penetration.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "solver/problem/term.h"

namespace retarget::solver {

class Penetration : public Term {
 public:
  const char* name() const override { return "penetration"; }
  const char* unit() const override { return "m"; }
  // Bodies in a close hold touch along whole limbs.
  int row_slots(const Frame&) const override { return 24; }
  bool staged() const override { return true; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;
};

class SelfPenetration : public Term {
 public:
  explicit SelfPenetration(const Scene& scene);
  const char* name() const override { return "self_penetration"; }
  const char* unit() const override { return "m"; }
  bool staged() const override { return true; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  struct Allowance {
    int figure, pair;
    double depth;  // m, in the source
  };
  std::array<std::vector<std::pair<int, int>>, 2> pairs_;
  std::vector<std::vector<Allowance>> allowance_;  // per frame, positive depths only
};

}  // namespace retarget::solver
