#define RETARGET_KERNEL portable
#include "solver/kernels_impl.h"
