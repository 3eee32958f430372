// hold: two held points stay together (Ho and Komura 2007, Eq. 5),
//   r = p_from - p_to                                  (m)
// and, where the hold keeps its rotation, the relative orientation of the template,
//   r = log(R_T^T R_to^T R_from)                       (rad)
// 1 frame, 1 or 2 bodies. YAML: weights.hold.
#pragma once

#include "solver/problem/term.h"

namespace retarget::solver {

// Adds the rows of one hold.
void AddHoldRows(const Frame& frame, const Hold& hold, Rows* rows);

class HoldTerm : public Term {
 public:
  const char* name() const override { return "hold"; }
  const char* unit() const override { return "m, rad"; }
  PartKind part_kind() const override { return PartKind::kHold; }
  int parts(const Scene& scene) const override { return static_cast<int>(scene.holds.size()); }
  int row_slots(const Frame& frame) const override { return 6 * parts(*frame.scene); }
  bool staged() const override { return true; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;
};

}  // namespace retarget::solver
