// joint_limit: a joint turns no further than its limit, or than the capture itself.
//   r = max(0, beyond(R) - max(0, beyond(R_source)))        (rad), per limit of model/body/body.h:
// twist about the bone, swing of the bone's direction, and for hinges the bend and its plane.
// 1 frame, 1 body. YAML: weights.joint_limit.
#pragma once

#include <vector>

#include "solver/problem/term.h"

namespace retarget::solver {

// How far a rotation lies beyond each limit (rad; negative: within), and the derivative by a turn
// R -> R exp(w).
struct LimitViolation {
  double beyond;
  Vec3 gradient;
};
std::vector<LimitViolation> LimitViolations(const JointLimit& limit, const Quat& rotation);

class JointLimitTerm : public Term {
 public:
  const char* name() const override { return "joint_limit"; }
  const char* unit() const override { return "rad"; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;
};

}  // namespace retarget::solver
