// A dense matrix product at the instruction set that solver/optimizer/kernels.h chose on this
// machine. An elimination that did nothing else would run at this rate.
#pragma once

namespace retarget {

// c += a b for column-major a [m x k], b [k x n], c [m x n].
void Multiply(const double* a, const double* b, int m, int n, int k, double* c);

inline double MultiplyFlops(int m, int n, int k) { return 2.0 * m * n * k; }

// The product's best rate on this machine, now (flop/s): the fastest of many short trials, so that
// what else the machine does is left out. Shape: two frames and their anchors by one frame.
double MeasureMultiplyRate();

}  // namespace retarget
