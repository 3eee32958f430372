// tangle_aim: a tagged tangle is drawn, weakly, to the value that it has in the template, so that
// it does not unwind to the threshold at which the hinge of `tangle` ends.
//   r = h tanh((aim - s GLI(P, Q)) / h)          (turns), s the template's sign, aim its s GLI
// on both sides; h = 0.25 bounds the pull where a motion is far from it, so that no limb is driven
// through another for it. Raised in stages with the contacts, for the same reason.
// GLI by Ho and Komura 2007, Eq. 1 and 3. 1 frame, 2 bodies. YAML: weights.tangle_aim.
#pragma once

#include <vector>

#include "solver/problem/terms/tag_gli.h"

namespace retarget::solver {

class TangleAim : public Term {
 public:
  explicit TangleAim(const Scene& scene);
  const char* name() const override { return "tangle_aim"; }
  const char* unit() const override { return "turns"; }
  PartKind part_kind() const override { return PartKind::kTag; }
  int parts(const Scene&) const override { return static_cast<int>(items_.size()); }
  int row_slots(const Frame& frame) const override { return parts(*frame.scene); }
  bool staged() const override { return true; }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  struct Item {
    TagPaths paths;
    double aim;
  };
  std::vector<Item> items_;
};

}  // namespace retarget::solver
