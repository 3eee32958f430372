// The GLI of a tag's two paths, signed as in the template, and its way into a row: what the terms
// `tangle` and `tangle_aim` have in common. GLI by Ho and Komura 2007, Eq. 1 and 3.
#pragma once

#include <vector>

#include "solver/problem/term.h"

namespace retarget::solver {

// The nodes on the paths of a tag.
struct TagPaths {
  TagPaths(const Scene& scene, const TangleTarget& held);

  std::array<std::vector<int>, 2> nodes;  // per figure
  double sign;
};

// The paths in a frame.
class TagGli {
 public:
  TagGli(const TagPaths& paths, const Frame& frame);

  // s GLI(P, Q) (turns).
  double value() const;
  // d r += slope d (s GLI).
  void AddTo(Rows* rows, int row, double slope) const;

 private:
  const TagPaths& paths_;
  std::array<std::vector<Vec3>, 2> points_;
};

}  // namespace retarget::solver
