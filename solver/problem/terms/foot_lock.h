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
  PartKind part_kind() const override { return PartKind::kContact; }
  int parts(const Scene&) const override { return static_cast<int>(planted_.size()); }
  int row_slots(const Frame& frame) const override;
  bool staged() const override { return true; }
  void EvaluatePart(const Frame& frame, int anchor, Rows* rows) const override;

 private:
  struct Planted {
    int figure;
    Contact contact;
    double height;  // m
    bool Stands(int t) const { return contact.first <= t && t <= contact.last; }
  };
  std::vector<Planted> planted_;  // per anchor
};

}  // namespace retarget::solver
