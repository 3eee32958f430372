// foot_lock: a planted node stays where it is through its contact.
//   r = (p_x - a_x, p_y - h, p_z - a_z)       (m), a the contact's anchor, h its mean height in the
// source. The anchor is an unknown of its own, so a footprint may shift as a whole over the floor,
// but not leave it.
// 1 frame and the anchor, 1 body. YAML: weights.foot_lock.
#pragma once

#include <vector>

#include "solver/problem/term.h"

namespace retarget::solver {

class FootLock : public Term {
 public:
  explicit FootLock(const Scene& scene);
  const char* name() const override { return "foot_lock"; }
  const char* unit() const override { return "m"; }
  bool staged() const override { return true; }
  void Evaluate(const Frame& frame, Rows* rows) const override;

 private:
  struct Planted {
    int figure, node, anchor;
    double height;  // m
  };
  std::vector<std::vector<Planted>> planted_;  // per frame
};

}  // namespace retarget::solver
