// A figure that does not pose itself: its posture is a table of joint rotations, as of one who was
// laid over a block. Lengths in m, rotation vectors in degrees.
#pragma once

#include <cstdio>
#include <map>
#include <string>

#include "data/actors/actor.h"

namespace retarget {

struct LimpPosture {
  Vec3 root;                          // over the floor (m)
  Vec3 hips_deg;                      // rotation vector in the actor's own frame
  std::map<std::string, Vec3> turns;  // by the rig's joint, child in parent; others are zero
};

// As that of a posture in actor.h; WriteClip (write_clip.h) finds either.
inline void WriteFrame(const Actor& actor, const LimpPosture& posture, const Place& stage,
                       std::FILE* out) {
  const Quat turn = YawRotation(stage.yaw_deg * kDegree);
  WriteVector(turn * posture.root + Vec3(stage.x, 0, stage.z), out);
  WriteAngles(turn * ExpDegrees(posture.hips_deg), out);
  for (size_t j = 1; j < actor.joints.size(); ++j) {
    const auto it = posture.turns.find(actor.joints[j].name);
    WriteAngles(it == posture.turns.end() ? Quat::Identity() : ExpDegrees(it->second), out);
  }
  std::fprintf(out, "\n");
}

}  // namespace retarget
