// Tags that the template itself hardly shows: what the user is warned of.
#pragma once

#include <cmath>

#include "model/body/tangle.h"

namespace retarget::solver {

// |GLI| in the template (turns) under which a tag is weak: little is left over the half turn from
// which a tangle counts.
inline constexpr double kWeakGli = 0.6;
// Robustness radius (rad, m) under which a tag is easily lost: a change of the pose of so little in
// all its coordinates together can undo it.
inline constexpr double kEasilyLostRho = 0.1;

inline bool IsWeak(const Tag& tag) { return std::abs(tag.tangle.gli) < kWeakGli; }
inline bool IsEasilyLost(const Tag& tag) { return tag.rho < kEasilyLostRho; }

}  // namespace retarget::solver
