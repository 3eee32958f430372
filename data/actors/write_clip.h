// What an actor does as a BVH file, and the main of a program that writes two. Lengths in m, BVH in
// cm. Not by io/bvh, which writes frames into a hierarchy that it has read: these files are made
// from nothing, and with as many digits as a person may want to read.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "data/actors/actor.h"

namespace retarget {

// Rotations are written Y, Z, X: for a figure this order meets its gimbal lock only where an arm
// points straight up or down or the trunk lies on its side, so the curves have no jumps.
inline void WriteAngles(const Quat& q, std::FILE* out) {
  const Mat3 m = q.toRotationMatrix();
  const double y = std::atan2(-m(2, 0), m(0, 0));
  const double z = std::asin(std::clamp(m(1, 0), -1.0, 1.0));
  const double x = std::atan2(-m(1, 2), m(1, 1));
  std::fprintf(out, " %.5f %.5f %.5f", y / kDegree, z / kDegree, x / kDegree);
}

inline void WriteVector(const Vec3& metres, std::FILE* out) {
  std::fprintf(out, "%.5f %.5f %.5f", 100 * metres.x(), 100 * metres.y(), 100 * metres.z());
}

inline void WriteJoint(const Actor& actor, int j, int depth, std::FILE* out) {
  const std::string tab(depth, '\t');
  const Joint& joint = actor.joints[j];
  std::fprintf(out, "%s%s %s\n%s{\n%s\tOFFSET ", tab.c_str(), j == 0 ? "ROOT" : "JOINT",
               joint.name.c_str(), tab.c_str(), tab.c_str());
  WriteVector(joint.offset, out);
  std::fprintf(out, "\n%s\tCHANNELS %sYrotation Zrotation Xrotation\n", tab.c_str(),
               j == 0 ? "6 Xposition Yposition Zposition " : "3 ");
  bool leaf = true;
  for (size_t child = 0; child < actor.joints.size(); ++child) {
    if (actor.joints[child].parent != j) continue;
    WriteJoint(actor, static_cast<int>(child), depth + 1, out);
    leaf = false;
  }
  if (leaf) {
    std::fprintf(out, "%s\tEnd Site\n%s\t{\n%s\t\tOFFSET ", tab.c_str(), tab.c_str(), tab.c_str());
    WriteVector(joint.end_site, out);
    std::fprintf(out, "\n%s\t}\n", tab.c_str());
  }
  std::fprintf(out, "%s}\n", tab.c_str());
}

// `stage`: where on the capture stage the actor's own frame lies.
inline void WriteFrame(const LocalFigure& figure, const Place& stage, std::FILE* out) {
  const Quat turn = YawRotation(stage.yaw_deg * kDegree);
  WriteVector(turn * figure.root + Vec3(stage.x, 0, stage.z), out);
  WriteAngles(turn * figure.turns[0], out);
  for (size_t j = 1; j < figure.turns.size(); ++j) WriteAngles(figure.turns[j], out);
  std::fprintf(out, "\n");
}

// `perform(t)`: the actor's posture at t s, anything that LocalOf takes. False where the file
// cannot be written.
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
  for (int k = 0; k < frames; ++k) {
    WriteFrame(LocalOf(actor, perform(k / kFps)), stage, out);
  }
  return std::fclose(out) == 0;
}

// main() of a generator: one argument, the folder. `write(folder)` writes both clips into it.
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
