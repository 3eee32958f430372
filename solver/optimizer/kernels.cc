#include "solver/optimizer/kernels.h"

#define RETARGET_DECLARE_KERNEL(isa)                                                          \
  extern "C" bool retarget_partial_cholesky_##isa(double*, int, int, int, int, double*);      \
  extern "C" void retarget_add_normal_equations_##isa(const double*, const double*, int, int, \
                                                      double*, double*);
RETARGET_DECLARE_KERNEL(portable)
RETARGET_DECLARE_KERNEL(avx2)
RETARGET_DECLARE_KERNEL(avx512)

namespace retarget::solver {
namespace {

struct Kernels {
  const char* name;
  bool (*partial_cholesky)(double*, int, int, int, int, double*);
  void (*add_normal_equations)(const double*, const double*, int, int, double*, double*);
};

Kernels Choose() {
#ifdef RETARGET_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("fma")) {
    return {"avx512", retarget_partial_cholesky_avx512, retarget_add_normal_equations_avx512};
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return {"avx2", retarget_partial_cholesky_avx2, retarget_add_normal_equations_avx2};
  }
#endif
  return {"portable", retarget_partial_cholesky_portable, retarget_add_normal_equations_portable};
}

const Kernels& Chosen() {
  static const Kernels kernels = Choose();
  return kernels;
}

}  // namespace

bool PartialCholesky(double* a, int stride, int size, int own, int triangular, double* b) {
  return Chosen().partial_cholesky(a, stride, size, own, triangular, b);
}

void AddNormalEquations(const double* jacobian, const double* residual, int rows, int n, double* h,
                        double* g) {
  if (rows > 0) Chosen().add_normal_equations(jacobian, residual, rows, n, h, g);
}

const char* KernelName() { return Chosen().name; }

}  // namespace retarget::solver
