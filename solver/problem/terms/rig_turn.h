// rig_turn: no edit that the figure's own rig cannot make. A joint of one or two axes (Acclaim
// files, some BVH) turns within them, else the solved motion could not be written back.
//   r = d . delta    (rad), d each direction that the joint cannot turn in at the captured pose
// 1 frame, 1 body. YAML: weights.rig_turn.
#pragma once

#include "solver/problem/term.h"

namespace retarget::solver {

class RigTurn : public Term {
 public:
  const char* name() const override { return "rig_turn"; }
  const char* unit() const override { return "rad"; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;
};

}  // namespace retarget::solver
