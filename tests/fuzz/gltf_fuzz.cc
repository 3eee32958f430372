// Any bytes: the reader takes them or throws InputError with one line, and what it takes can be
// measured, written and read again as it was.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "io/gltf/clip.h"

namespace retarget {
namespace {

[[noreturn]] void Broken(const std::string& what) {
  std::cerr << what << "\n";
  std::abort();
}

void CheckMessage(const InputError& error) {
  const std::string message = error.what();
  if (message.empty() || message.size() > 1000 || message.find('\n') != std::string::npos) {
    Broken("a message is not one line: " + message);
  }
}

void CheckFrames(const io::GltfClip& clip) {
  if (clip.motion.frames.empty() || clip.joints.empty()) Broken("no frames");
  for (const RigFrame& frame : clip.motion.frames) {
    for (size_t j = 0; j < clip.joints.size(); ++j) {
      const bool sound = frame.translation[j].allFinite() &&
                         std::abs(frame.rotation[j].norm() - 1) < 1e-6 &&
                         clip.motion.rig.joints[j].parent < static_cast<int>(j);
      if (!sound) Broken("a frame is damaged");
    }
  }
}

void TakeApart(const std::string& bytes) {
  io::GltfClip clip;
  try {
    clip = io::ParseGltf(bytes, "a.glb", "");
  } catch (const InputError& error) {
    CheckMessage(error);
    // Where there is a choice, the first will do.
    try {
      clip = io::ParseGltf(bytes, "a.glb", "", {"0", "0"});
    } catch (const InputError& again) {
      return CheckMessage(again);
    }
  }
  CheckFrames(clip);
  try {
    for (const double radius : io::BoneRadii(clip)) {
      if (!(radius >= 0)) Broken("a radius is no length");
    }
  } catch (const InputError& error) {
    CheckMessage(error);
  }
  std::string written;
  try {
    written = io::FormatGltf(clip, clip.motion, 0, "retargeted");
  } catch (const InputError& error) {
    return CheckMessage(error);
  }
  try {
    // Its skin is not selected again: a document may hold several characters.
    const io::GltfClip again = io::ParseGltf(written, "again", "", {"retargeted", ""});
    if (again.motion.num_frames() != clip.motion.num_frames()) {
      std::cerr << again.motion.num_frames() << " frames for " << clip.motion.num_frames() << "\n";
    }
  } catch (const InputError& error) {
    CheckMessage(error);
  }
}

// A container whose lengths agree again after bytes were inserted or lost: else few mutants would
// be read any further than their header.
std::string Repaired(std::string bytes) {
  constexpr size_t kJsonAt = 20;
  if (bytes.size() < kJsonAt + 8 || bytes.substr(0, 4) != "glTF") return bytes;
  const auto set = [&](size_t at, size_t word) {
    for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(word >> (8 * i) & 0xFF);
  };
  bytes.resize(bytes.size() / 4 * 4);
  const size_t marker = bytes.find(std::string("BIN\0", 4), kJsonAt);
  const bool has_data = marker != std::string::npos && marker % 4 == 0 && marker >= kJsonAt + 4;
  set(8, bytes.size());
  set(12, (has_data ? marker - 4 : bytes.size()) - kJsonAt);
  if (has_data) set(marker - 4, bytes.size() - marker - 4);
  return bytes;
}

}  // namespace
}  // namespace retarget

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  retarget::TakeApart(bytes);
  const std::string repaired = retarget::Repaired(bytes);
  if (repaired != bytes) retarget::TakeApart(repaired);
  return 0;
}
