// hand_contact: a hand touches what it touches in the template, and may slide on it.
//   r1 = max(0, |p - q| - R_i - R_j)                 (m), p, q the closest points of the axes of
//   the
//                                                    hand's capsule and of the partner's
//   r2 = max(0, |p0 - q0| - R_i - R_j - slide)       (m), p0, q0 the points of the axes that are
//                                                    closest in the template
// Overlap is the business of `penetration`. Where p and q meet the derivative is that of the
// distance at fixed axis parameters, by the envelope theorem.
// 1 frame, 2 bodies. YAML: weights.hand_contact, hand_contact.slide_m.
#pragma once

#include "solver/problem/term.h"

namespace retarget::solver {

class HandContactTerm : public Term {
 public:
  explicit HandContactTerm(double slide) : slide_(slide) {}
  const char* name() const override { return "hand_contact"; }
  const char* unit() const override { return "m"; }
  int row_slots(const Frame& frame) const override {
    return 2 * static_cast<int>(frame.scene->hand_contacts.size());
  }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  double slide_;
};

}  // namespace retarget::solver
