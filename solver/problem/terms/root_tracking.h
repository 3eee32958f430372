// root_tracking: the root stays with its placed clip, shifted where the two clips drift apart
// (solver/problem/root_drift.h),
//   r = (p - p_target, log(R_target^T R))    (m, rad)
// or, for a figure that follows its partner, keeps the capture's motion relative to where the
// template puts it on the partner (solver/problem/root_targets.h):
//   X_target(t) = X_partner(t) X_relative(t),  X in SE(3)
//   r = (R_target^T (p - p_target), log(R_target^T R))                       (m, rad)
// 1 frame, 1 body (2 where it follows). YAML: weights.root_tracking.
#pragma once

#include <array>
#include <vector>

#include "solver/problem/root_drift.h"
#include "solver/problem/root_targets.h"
#include "solver/problem/term.h"

namespace retarget::solver {

class RootTracking : public Term {
 public:
  explicit RootTracking(const Scene& scene);
  const char* name() const override { return "root_tracking"; }
  const char* unit() const override { return "m, rad"; }
  int row_slots(const Frame& frame) const override;
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  // The target is the base that edits are counted from: coordinate rows.
  bool EditIsError(const Frame& frame, int figure) const;
  void EvaluateLeader(const Frame& frame, int figure, Rows* rows) const;
  void EvaluateFollower(const Frame& frame, int figure, Rows* rows) const;
  std::array<std::vector<RelativeRoot>, 2> relative_;
  std::array<std::vector<RootShift>, 2> drift_correction_;
};

}  // namespace retarget::solver
