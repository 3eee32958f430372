// `pingpong IN.bvh N OUT.bvh`: the clip played forwards and backwards to N frames.
#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>

#include "io/bvh/bvh.h"
#include "io/files.h"
#include "tools/bench/ping_pong.h"

namespace retarget {
namespace {

int Run(const char* in, const char* count, const char* out) {
  int num_frames = 0;
  const char* end = count + std::strlen(count);
  if (std::from_chars(count, end, num_frames).ptr != end || num_frames < 1) {
    throw InputError(std::string(count) + ": expected a number of frames, at least 1");
  }
  const io::BvhFile file = io::ReadBvh(in);
  if (file.motion.num_frames() == 0) throw InputError(std::string(in) + ": no frames");
  io::WriteFile(out, io::FormatBvh(file, PingPong(file.motion, num_frames)), /*force=*/true);
  return 0;
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: pingpong IN.bvh N OUT.bvh\n");
    return 2;
  }
  try {
    return retarget::Run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pingpong: %s\n", error.what());
    return 2;
  }
}
