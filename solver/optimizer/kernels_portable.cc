#define RETARGET_KERNEL portable
#include "solver/optimizer/kernels_impl.h"
