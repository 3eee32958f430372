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
  bool staged() const override { return true; }
  void Evaluate(const Frame& frame, Rows* rows) const override;
};

}  // namespace retarget::solver
