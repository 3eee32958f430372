// joint_limit: a joint turns no further than its limits, or than the capture itself.
//   r = soft(beyond(R) - max(0, beyond(R_source) + m))      (rad), per limit of
// model/body/joint_limit.h, with m = kSoftMargin and soft(x) = 0 for x < -m, (x + m)^2 / 4m for
// |x| <= m, x beyond: it begins before the end of the range, has no kink, and asks nothing of a
// pose as captured. Where Scene::source_widens_limits is false, r = max(0, beyond(R)). 1 frame,
// 1 body. YAML: weights.joint_limit.
#pragma once

#include "solver/problem/term.h"

namespace retarget::solver {

// A joint's resistance begins this far before the end of its range (rad).
inline constexpr double kSoftMargin = 10 * kDegree;

class JointLimitTerm : public Term {
 public:
  const char* name() const override { return "joint_limit"; }
  const char* unit() const override { return "rad"; }
  int row_slots(const Frame&) const override { return kSlots; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  static constexpr int kSlots = 24;  // a held pose has this many joints near an end
};

}  // namespace retarget::solver
