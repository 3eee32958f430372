// Writes what an actor does as a BVH file.
#pragma once

#include <cstdio>
#include <string>

#include "data/actors/actor.h"

namespace retarget {

// `perform(t)` is the actor's posture at t s; false where the file cannot be written.
template <typename Perform>
bool WriteClip(const std::string& path, const Actor& actor, double seconds, const Place& stage,
               const Perform& perform) {
  constexpr double kFps = 30;
  std::FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) return false;
  const int frames = static_cast<int>(seconds * kFps) + 1;
  std::fprintf(out, "HIERARCHY\n");
  WriteJoint(actor, 0, 0, out);
  std::fprintf(out, "MOTION\nFrames: %d\nFrame Time: %.6f\n", frames, 1 / kFps);
  for (int k = 0; k < frames; ++k) WriteFrame(actor, perform(k / kFps), stage, out);
  return std::fclose(out) == 0;
}

// The whole of a generator's main: `write(folder)` writes the clips there.
template <typename Write>
int RunGenerator(int argc, char** argv, const Write& write) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_clips OUT_DIR\n");
    return 2;
  }
  if (write(std::string(argv[1]))) return 0;
  std::fprintf(stderr, "%s: cannot write the clips there\n", argv[1]);
  return 1;
}

}  // namespace retarget
