// A template posture being made: operations, their history, and what is to be seen meanwhile. The
// page and `retarget pose` are two ways to call this.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/pose_solve.h"
#include "tools/pose_state.h"

namespace retarget {

class PoseSession {
 public:
  explicit PoseSession(TemplatePosture posture);

  const PoseState& state() const { return state_; }
  const TemplatePosture& posture() const { return state_.posture; }

  // Does one operation; what the solver found where it was asked. Throws InputError and changes
  // nothing where the operation is not valid. `most_iterations` bounds the solver: about 12 for
  // one step of a drag on a page, more where it is to arrive in one step.
  std::optional<PoseResult> Apply(const Operation& operation, int most_iterations = 200);

  // To the exact state before the last step, or the last one undone. False where there is none.
  bool Undo();
  bool Redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }

  // The template as a file. Throws InputError where it cannot be read back.
  std::string Text() const;
  // The same to a file; refuses to overwrite without `force`.
  void Save(const std::string& path, bool force) const;

 private:
  PoseResult DragTo(const std::optional<NodeTarget>& target, const std::optional<NodeRay>& ray,
                    int gesture, int most_iterations);
  void Remember();

  PoseState state_;
  std::vector<PoseState> undo_, redo_;
  // The drag that is under way.
  int gesture_ = 0;  // 0: none
  std::array<Pose, 2> before_;
  std::vector<NodeTarget> targets_;
  std::vector<NodeRay> rays_;
};

// Two T-posed figures that face each other, `distance` m apart.
TemplatePosture RestPosture(double stature_a, double stature_b, double distance);

}  // namespace retarget
