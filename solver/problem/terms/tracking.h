// pose_tracking: every joint stays as captured.
//   r = s_j delta_j                          (rad), delta the edit R = R_source exp(delta)
// root_tracking: the root stays with its placed clip, shifted where the two clips drift apart
// (solver/problem/root_drift.h),
//   r = (p - p_target, log(R_target^T R))    (m, rad)
// or, for a figure that follows its partner, keeps the capture's motion relative to where the
// template puts it on the partner:
//   X_target(t) = X_partner(t) X_partner,T^-1 X_T X_clip(t0)^-1 X_clip(t),  X in SE(3)
//   r = (R_target^T (p - p_target), log(R_target^T R))                       (m, rad)
// 1 frame, 1 body (2 where it follows). YAML: weights.pose_tracking, weights.root_tracking.
#pragma once

#include <array>
#include <vector>

#include "model/settings.h"
#include "solver/problem/root_drift.h"
#include "solver/problem/term.h"

namespace retarget::solver {

// Share of the joint group that a link belongs to ("left_elbow" -> elbow).
double JointShare(const JointWeights& weights, const std::string& link_name);

// Target of a follower's root in its partner's root frame, per frame (m).
struct RelativeRoot {
  Vec3 position;
  Quat rotation;
};
// Of all frames; empty for a figure that follows its own clip.
std::vector<RelativeRoot> RelativeRootTargets(const Scene& scene, int figure);

class PoseTracking : public Term {
 public:
  PoseTracking(const Scene& scene, const JointWeights& weights);
  const char* name() const override { return "pose_tracking"; }
  const char* unit() const override { return "rad"; }
  void Evaluate(const Frame& frame, Rows* rows) const override;

 private:
  std::array<std::vector<double>, 2> share_;  // per link
};

class RootTracking : public Term {
 public:
  explicit RootTracking(const Scene& scene);
  const char* name() const override { return "root_tracking"; }
  const char* unit() const override { return "m, rad"; }
  void Evaluate(const Frame& frame, Rows* rows) const override;

 private:
  void EvaluateLeader(const Frame& frame, int figure, Rows* rows) const;
  void EvaluateFollower(const Frame& frame, int figure, Rows* rows) const;
  std::array<std::vector<RelativeRoot>, 2> relative_;
  std::array<std::vector<RootShift>, 2> meeting_;
};

}  // namespace retarget::solver
