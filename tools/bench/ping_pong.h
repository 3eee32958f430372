// A motion played forwards and backwards: as long as one likes, without a jump, and every stretch
// of it as hard to solve as the original.
#pragma once

#include <cstddef>

namespace retarget {

// Works for Clip and RigMotion alike. The end frames are not doubled.
template <typename Motion>
Motion PingPong(const Motion& motion, int num_frames) {
  const int last = motion.num_frames() - 1;
  Motion out = motion;
  out.frames.clear();
  for (int k = 0; k < num_frames; ++k) {
    const int phase = last > 0 ? k % (2 * last) : 0;
    out.frames.push_back(
        motion.frames[static_cast<std::size_t>(phase <= last ? phase : 2 * last - phase)]);
  }
  return out;
}

}  // namespace retarget
