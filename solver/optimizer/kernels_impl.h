// The body of solver/optimizer/kernels.h, compiled once per instruction set. RETARGET_KERNEL names
// the namespace; Eigen is renamed with it (see CMakeLists.txt) so that its inline functions of one
// instruction set cannot be linked into code for another. No other header may be used here.
#include <Eigen/Cholesky>
#include <Eigen/Core>

#define RETARGET_CONCAT_(a, b) a##b
#define RETARGET_CONCAT(a, b) RETARGET_CONCAT_(a, b)

namespace {

constexpr int kBlock = 24;  // columns factored at once
constexpr int kRest = 48;   // columns taken off the rest at once

// Rows of the matrix that are not zero in the own columns before `column`: all but the end of the
// last `triangular` ones, which start out diagonal and fill up to the diagonal only.
inline int ActiveRows(int size, int triangular, int column) {
  const int filled = column < triangular ? column : triangular;
  return size - triangular + filled;
}

// Factors the own columns of the symmetric matrix block by block and takes them off the rest.
// Everything but the small diagonal blocks is a matrix product: below a diagonal block L the panel
// is multiplied by L^-1, since Eigen's triangular solve of a tall panel runs at a tenth of its
// product's speed.
template <typename Matrix>
bool Factor(Matrix& m, int own, int triangular) {
  using Eigen::Lower;
  const int size = static_cast<int>(m.rows());
  Eigen::MatrixXd inverse, panel;
  for (int k = 0; k < own; k += kBlock) {
    const int width = own - k < kBlock ? own - k : kBlock;
    const int active = ActiveRows(size, triangular, k + width);
    const int next = k + width;
    auto diagonal = m.block(k, k, width, width);
    if (Eigen::internal::llt_inplace<double, Lower>::unblocked(diagonal) >= 0) return false;
    inverse.setIdentity(width, width);
    diagonal.template triangularView<Lower>().solveInPlace(inverse);
    auto column = m.block(next, k, active - next, width);
    panel = column;
    column.noalias() = panel * inverse.transpose();
    // The own columns to the right, in strips so that little above the diagonal is touched.
    for (int c = next; c < own; c += kBlock) {
      const int strip = own - c < kBlock ? own - c : kBlock;
      m.block(c, c, active - c, strip).noalias() -=
          m.block(c, k, active - c, width) * m.block(c, k, strip, width).transpose();
    }
  }
  // The rest, by as many columns at once as have the same active rows.
  for (int k = 0; k < own; k += kRest) {
    const int width = own - k < kRest ? own - k : kRest;
    const int rest = ActiveRows(size, triangular, k + width) - own;
    if (rest <= 0) continue;
    const auto a21 = m.block(own, k, rest, width);
    m.block(own, own, rest, rest).template selfadjointView<Lower>().rankUpdate(a21, -1.0);
  }
  return true;
}

}  // namespace

extern "C" bool RETARGET_CONCAT(retarget_partial_cholesky_,
                                RETARGET_KERNEL)(double* a, int stride, int size, int own,
                                                 int triangular, double* b) {
  using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Matrix m(a, size, size, Eigen::OuterStride<>(stride));
  Eigen::Map<Eigen::VectorXd> rhs(b, size);
  if (!Factor(m, own, triangular)) return false;
  m.topLeftCorner(own, own).triangularView<Eigen::Lower>().solveInPlace(rhs.head(own));
  const int rest = size - own;
  if (rest > 0) rhs.tail(rest).noalias() -= m.bottomLeftCorner(rest, own) * rhs.head(own);
  return true;
}

extern "C" void RETARGET_CONCAT(retarget_add_normal_equations_,
                                RETARGET_KERNEL)(const double* jacobian, const double* residual,
                                                 int rows, int n, double* h, double* g) {
  // Row-major J is column-major J^T.
  const Eigen::Map<const Eigen::MatrixXd> jt(jacobian, n, rows);
  const Eigen::Map<const Eigen::VectorXd> r(residual, rows);
  Eigen::Map<Eigen::MatrixXd>(h, n, n).selfadjointView<Eigen::Lower>().rankUpdate(jt);
  Eigen::Map<Eigen::VectorXd>(g, n).noalias() += jt * r;
}
