// The body of tools/bench/multiply.h, compiled once per instruction set; see
// solver/optimizer/kernels_impl.h for why no other header may be used here.
#include <Eigen/Core>

#define RETARGET_CONCAT_(a, b) a##b
#define RETARGET_CONCAT(a, b) RETARGET_CONCAT_(a, b)

extern "C" void RETARGET_CONCAT(retarget_multiply_, RETARGET_KERNEL)(const double* a,
                                                                     const double* b, int m, int n,
                                                                     int k, double* c) {
  using ConstMap = Eigen::Map<const Eigen::MatrixXd>;
  Eigen::Map<Eigen::MatrixXd>(c, m, n).noalias() += ConstMap(a, m, k) * ConstMap(b, k, n);
}
