// The body of solver/kernels.h, compiled once per instruction set. RETARGET_KERNEL names the
// namespace; Eigen is renamed with it (see CMakeLists.txt) so that its inline functions of one
// instruction set cannot be linked into code for another. No other header may be used here.
#include <Eigen/Cholesky>
#include <Eigen/Core>

#define RETARGET_CONCAT_(a, b) a##b
#define RETARGET_CONCAT(a, b) RETARGET_CONCAT_(a, b)

namespace {

constexpr int kBlock = 24;  // columns factored at once

// Factors the own columns of the symmetric matrix block by block. Everything but the small diagonal
// blocks is a matrix product: below a diagonal block L the panel is multiplied by L^-1, since
// Eigen's triangular solve of a tall panel runs at a tenth of its product's speed.
template <typename Matrix>
bool FactorColumns(Matrix& m, int own) {
  using Eigen::Lower;
  const int size = static_cast<int>(m.rows());
  Eigen::MatrixXd inverse, panel;
  for (int k = 0; k < own; k += kBlock) {
    const int width = own - k < kBlock ? own - k : kBlock;
    const int below = size - k - width;
    auto diagonal = m.block(k, k, width, width);
    if (Eigen::internal::llt_inplace<double, Lower>::unblocked(diagonal) >= 0) return false;
    inverse.setIdentity(width, width);
    diagonal.template triangularView<Lower>().solveInPlace(inverse);
    auto column = m.block(k + width, k, below, width);
    panel = column;
    column.noalias() = panel * inverse.transpose();
    // The own columns to the right, in strips so that little above the diagonal is touched.
    for (int c = k + width; c < own; c += kBlock) {
      const int strip = own - c < kBlock ? own - c : kBlock;
      m.block(c, c, size - c, strip).noalias() -=
          m.block(c, k, size - c, width) * m.block(c, k, strip, width).transpose();
    }
  }
  return true;
}

}  // namespace

extern "C" bool RETARGET_CONCAT(retarget_partial_cholesky_, RETARGET_KERNEL)(double* a, int stride,
                                                                            int size, int own,
                                                                            double* b) {
  using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Matrix m(a, size, size, Eigen::OuterStride<>(stride));
  Eigen::Map<Eigen::VectorXd> rhs(b, size);
  const int rest = size - own;
  if (!FactorColumns(m, own)) return false;
  m.topLeftCorner(own, own).triangularView<Eigen::Lower>().solveInPlace(rhs.head(own));
  if (rest == 0) return true;
  const auto a21 = m.bottomLeftCorner(rest, own);
  m.bottomRightCorner(rest, rest).selfadjointView<Eigen::Lower>().rankUpdate(a21, -1.0);
  rhs.tail(rest).noalias() -= a21 * rhs.head(own);
  return true;
}

extern "C" void RETARGET_CONCAT(retarget_add_normal_equations_, RETARGET_KERNEL)(
    const double* jacobian, const double* residual, int rows, int n, double* h, double* g) {
  // Row-major J is column-major J^T.
  const Eigen::Map<const Eigen::MatrixXd> jt(jacobian, n, rows);
  const Eigen::Map<const Eigen::VectorXd> r(residual, rows);
  Eigen::Map<Eigen::MatrixXd>(h, n, n).selfadjointView<Eigen::Lower>().rankUpdate(jt);
  Eigen::Map<Eigen::VectorXd>(g, n).noalias() += jt * r;
}
