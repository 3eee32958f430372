// pose_tracking: every joint stays as captured.
//   r = s_j delta_j                          (rad), delta the edit R = R_source exp(delta), s_j the
// joint's share (joint_weights).
// 1 frame, 1 body. YAML: weights.pose_tracking.
#pragma once

#include <array>
#include <vector>

#include "model/settings.h"
#include "solver/problem/term.h"

namespace retarget::solver {

class PoseTracking : public Term {
 public:
  PoseTracking(const Scene& scene, const JointWeights& weights);
  const char* name() const override { return "pose_tracking"; }
  const char* unit() const override { return "rad"; }
  int row_slots(const Frame&) const override { return 0; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  std::array<std::vector<double>, 2> share_;  // per link
};

}  // namespace retarget::solver
