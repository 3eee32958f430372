#define RETARGET_KERNEL avx512
#include "solver/kernels_impl.h"
