#define RETARGET_KERNEL avx2
#include "solver/kernels_impl.h"
