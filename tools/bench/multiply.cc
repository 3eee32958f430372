#include "tools/bench/multiply.h"

#include <algorithm>
#include <string_view>

#include "model/geometry/types.h"
#include "solver/optimizer/kernels.h"
#include "solver/problem/clock.h"

#define RETARGET_DECLARE_MULTIPLY(isa) \
  extern "C" void retarget_multiply_##isa(const double*, const double*, int, int, int, double*);
RETARGET_DECLARE_MULTIPLY(portable)
RETARGET_DECLARE_MULTIPLY(avx2)
RETARGET_DECLARE_MULTIPLY(avx512)

namespace retarget {

void Multiply(const double* a, const double* b, int m, int n, int k, double* c) {
#ifdef RETARGET_X86_KERNELS
  const std::string_view isa = solver::KernelName();
  if (isa == "avx512") return retarget_multiply_avx512(a, b, m, n, k, c);
  if (isa == "avx2") return retarget_multiply_avx2(a, b, m, n, k, c);
#endif
  retarget_multiply_portable(a, b, m, n, k, c);
}

double MeasureMultiplyRate() {
  constexpr int kRows = 264, kInner = 120, kTrials = 300;
  const MatX a = MatX::Random(kRows, kInner), b = MatX::Random(kInner, kRows);
  MatX c = MatX::Zero(kRows, kRows);
  double best = 1e300;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double started = solver::SecondsNow();
    Multiply(a.data(), b.data(), kRows, kRows, kInner, c.data());
    best = std::min(best, solver::SecondsNow() - started);
  }
  return MultiplyFlops(kRows, kRows, kInner) / best;
}

}  // namespace retarget
