// A figure that does not pose itself: its posture is a table of joint rotations, as of one who was
// laid over a block. Lengths in m, rotation vectors in degrees.
#pragma once

#include <map>
#include <string>

#include "data/actors/actor.h"

namespace retarget {

struct LimpPosture {
  Vec3 root;                          // over the floor (m)
  Vec3 hips_deg;                      // rotation vector in the actor's own frame
  std::map<std::string, Vec3> turns;  // by the rig's joint, child in parent; others are zero
};

inline LocalFigure LocalOf(const Actor& actor, const LimpPosture& posture) {
  LocalFigure local{posture.root, {ExpDegrees(posture.hips_deg)}};
  for (size_t j = 1; j < actor.joints.size(); ++j) {
    const auto it = posture.turns.find(actor.joints[j].name);
    local.turns.push_back(it == posture.turns.end() ? Quat::Identity() : ExpDegrees(it->second));
  }
  return local;
}

}  // namespace retarget
