#define RETARGET_KERNEL avx2
#include "solver/optimizer/kernels_impl.h"
