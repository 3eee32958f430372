#define RETARGET_KERNEL avx512
#include "solver/optimizer/kernels_impl.h"
