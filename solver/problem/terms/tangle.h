// tangle: a tagged tangle stays above one half, in the template's sense.
//   r = max(0, target - s GLI(P, Q))          (turns), s the template's sign,
//   target = 0.5 + margin, never above the template's own value
// GLI by Ho and Komura 2007, Eq. 1 and 3. 1 frame, 2 bodies. YAML: weights.tangle, tangle.margin.
#pragma once

#include <vector>

#include "solver/problem/terms/tag_gli.h"

namespace retarget::solver {

class TangleTerm : public Term {
 public:
  explicit TangleTerm(const Scene& scene);
  const char* name() const override { return "tangle"; }
  const char* unit() const override { return "turns"; }
  PartKind part_kind() const override { return PartKind::kTag; }
  int parts(const Scene&) const override { return static_cast<int>(items_.size()); }
  int row_slots(const Frame& frame) const override { return parts(*frame.scene); }
  void EvaluatePart(const Frame& frame, int part, Rows* rows) const override;

 private:
  struct Item {
    TagPaths paths;
    double target;
  };
  std::vector<Item> items_;
};

}  // namespace retarget::solver
