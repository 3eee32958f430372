// A template posture being made: operations, their history, and what is to be seen meanwhile. The
// page and `retarget pose` are two ways to call this.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "solver/optimizer/pose_solve.h"
#include "tools/posing/state.h"

namespace retarget::posing {

class PoseSession {
 public:
  // `settings`: by which tags are found and what is required of them.
  explicit PoseSession(TemplatePosture posture, const Settings& settings = {});

  const PoseState& state() const { return state_; }
  const TemplatePosture& posture() const { return state_.posture; }
  const Settings& settings() const { return settings_; }

  // Does one operation; what the solver found where it was asked. Throws InputError and changes
  // nothing where the operation is not valid. `most_iterations` bounds the solver: about 12 for
  // one step of a drag on a page, more where it is to arrive in one step; `most_seconds`, where it
  // is not 0, bounds its time as well.
  std::optional<solver::PoseResult> Apply(const Operation& operation, int most_iterations = 200,
                                          double most_seconds = 0);

  // To the exact state before the last step, or the last one undone. False where there is none.
  bool Undo();
  bool Redo();
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  // What the next undo takes back, such as "drag of a/left_hand"; empty where there is nothing.
  std::string undo_text() const { return undo_.empty() ? "" : undo_.back().what; }

  // From the next operation on, until it is switched off: what is done belongs to the last step of
  // the history.
  void Join(bool on) { joined_ = on; }

  // The photo's file goes by another name, now and in the history.
  void RenamePhoto(const std::string& from, const std::string& to);

  // The template as a file. Throws InputError where it cannot be read back.
  std::string Text() const;
  // The same to a file; refuses to overwrite without `force`.
  void Save(const std::string& path, bool force) const;

 private:
  struct Step {
    PoseState state;   // before it, or after it where it was undone
    std::string what;  // it did
  };

  solver::PoseResult DragTo(const std::optional<solver::NodeTarget>& target,
                            const std::optional<solver::NodeRay>& ray, int gesture,
                            const std::string& what, int most_iterations, double most_seconds);
  void Remember(const std::string& what);
  bool Walk(std::vector<Step>* from, std::vector<Step>* to);

  Settings settings_;
  PoseState state_;
  std::vector<Step> undo_, redo_;
  bool joined_ = false;
  int hand_gesture_ = 0;  // by hand, under way; 0: none
  // The drag that is under way.
  int gesture_ = 0;  // 0: none
  std::array<Pose, 2> before_;
  std::vector<solver::NodeTarget> targets_;
  std::vector<solver::NodeRay> rays_;
};

// Two T-posed figures that face each other, `distance` m apart.
TemplatePosture RestPosture(double stature_a, double stature_b, double distance);

}  // namespace retarget::posing
