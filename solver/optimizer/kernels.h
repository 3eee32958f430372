// The dense loops that the solve spends its time in, built once per instruction set and chosen at
// run time, so that one binary runs everywhere and fast.
#pragma once

namespace retarget::solver {

// Eliminates the first `own` of `size` unknowns of a symmetric positive definite system, in place:
//   a [size x size], lower triangle, column-major with leading dimension `stride`;  b [size]
// leaves L (own columns), the Schur complement (rest) and the forward-substituted right-hand side.
// The last `triangular` rows may be promised to be zero before their diagonal position in the own
// columns, entries (size - triangular + i, j) with j < i, as the smoothness stencil leaves them:
// what stays zero is skipped. False where a pivot is not positive.
bool PartialCholesky(double* a, int stride, int size, int own, int triangular, double* b);

// h += J^T J (lower triangle, [n x n], column-major, leading dimension n) and g += J^T r, for
// row-major J [rows x n] with leading dimension n.
void AddNormalEquations(const double* jacobian, const double* residual, int rows, int n, double* h,
                        double* g);

// "avx512", "avx2" or "portable": what this machine was given.
const char* KernelName();

}  // namespace retarget::solver
