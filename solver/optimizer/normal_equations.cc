#include "solver/optimizer/normal_equations.h"

#include "solver/optimizer/kernels.h"
#include "solver/problem/terms/foot_swing.h"

namespace retarget::solver {

void NormalEquations(const Rows& rows, MatX* hessian, VecX* gradient) {
  const long n = rows.jacobian().cols();
  hessian->setZero(n, n);
  gradient->setZero(n);
  AddNormalEquations(rows.jacobian().data(), rows.residual().data(), rows.num_rows(),
                     static_cast<int>(n), hessian->data(), gradient->data());
  for (const Rows::CoordinateRow& c : rows.coordinates()) {
    (*hessian)(c.coordinate, c.coordinate) += c.derivative * c.derivative;
    (*gradient)[c.coordinate] += c.derivative * c.residual;
  }
}

void FillBlock(const Problem& problem, const Rows& rows, const MatX& edit, int t,
               FrameBlock* block) {
  NormalEquations(rows, &block->hessian, &block->gradient);
  problem.smoothness().AddGradient(edit, t, block->gradient);
  block->anchors.clear();
  for (const Rows::AnchorEntry& e : rows.anchors()) {
    if (block->anchors.empty() || block->anchors.back() != e.anchor) {
      block->anchors.push_back(e.anchor);
    }
  }
  const long m = kAnchorSize * static_cast<long>(block->anchors.size());
  block->anchor_coupling.setZero(m, block->gradient.size());
  block->anchor_diagonal.setZero(m);
  block->anchor_gradient.setZero(m);
  long at = -1;  // a term adds the entries of one anchor together
  for (size_t k = 0; k < rows.anchors().size(); ++k) {
    const Rows::AnchorEntry& e = rows.anchors()[k];
    if (k == 0 || e.anchor != rows.anchors()[k - 1].anchor) ++at;
    const long row = kAnchorSize * at + e.component;
    block->anchor_coupling.row(row) += e.value * rows.jacobian().row(e.row);
    block->anchor_diagonal[row] += e.value * e.value;
    block->anchor_gradient[row] += e.value * rows.residual()[static_cast<size_t>(e.row)];
  }
}

std::vector<AnchorSpan> AnchorSpans(const Scene& scene) {
  std::vector<AnchorSpan> spans;
  for (int f = 0; f < 2; ++f) {
    for (const Contact& c : scene.contacts[f]) {
      const Contact reach = FootSwing::Reach(scene, f, c);
      spans.push_back({reach.first, reach.last});
    }
  }
  return spans;
}

}  // namespace retarget::solver
