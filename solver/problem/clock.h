// The clock of run times and time limits.
#pragma once

#include <chrono>

namespace retarget::solver {

// Seconds of a steady clock, from an origin of its own.
inline double SecondsNow() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

}  // namespace retarget::solver
