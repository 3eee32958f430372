// The shipped example, played for as long as a benchmark wants.
#pragma once

#include <string>

#include "solver/retarget.h"

namespace retarget {

// The clips a.bvh and b.bvh of `folder` on their own bodies at 30 frames/s, played forwards and
// backwards to `num_frames`, with its template.yaml laid at the first frame: what `retarget` makes
// of ping-pong files with its default options. Throws InputError.
solver::RetargetInput LoadExample(const std::string& folder, int num_frames);

}  // namespace retarget
