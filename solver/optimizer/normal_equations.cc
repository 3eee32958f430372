#include "solver/optimizer/normal_equations.h"

#include <algorithm>

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
  const std::vector<Rows::AnchorEntry>& entries = rows.anchors();
  std::vector<long> row_of;  // of each entry in the anchors' matrices
  for (const Rows::AnchorEntry& e : entries) {
    auto at = std::find(block->anchors.begin(), block->anchors.end(), e.anchor);
    if (at == block->anchors.end()) at = block->anchors.insert(at, e.anchor);
    row_of.push_back(kAnchorSize * (at - block->anchors.begin()) + e.component);
  }
  const long m = kAnchorSize * static_cast<long>(block->anchors.size());
  block->anchor_coupling.setZero(m, block->gradient.size());
  block->anchor_hessian.setZero(m, m);
  block->anchor_gradient.setZero(m);
  for (size_t k = 0; k < entries.size(); ++k) {
    const Rows::AnchorEntry& e = entries[k];
    block->anchor_coupling.row(row_of[k]) += e.value * rows.jacobian().row(e.row);
    block->anchor_gradient[row_of[k]] += e.value * rows.residual()[static_cast<size_t>(e.row)];
    // The entries of a row stand together.
    for (size_t l = k; l < entries.size() && entries[l].row == e.row; ++l) {
      const double product = e.value * entries[l].value;
      block->anchor_hessian(row_of[k], row_of[l]) += product;
      if (l != k) block->anchor_hessian(row_of[l], row_of[k]) += product;
    }
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
