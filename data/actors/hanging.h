// Legs that do not stand: of an actor who sits on a stool or lies over a block. Lengths in m.
#pragma once

#include "data/actors/actor.h"

namespace retarget {

// A foot whose ankle is at `ankle` in the pelvis's frame (from the root, x to the left), pointing
// `yaw` rad from the actor's heading and `pitch` rad down. The knee goes the way the foot points.
inline FootPose HangingFoot(const Actor& actor, const Posture& posture, const Vec3& ankle,
                            double yaw, double pitch) {
  const Quat pelvis = YawRotation(posture.yaw) * ExpDegrees(posture.pelvis_deg);
  const Quat sole = YawRotation(posture.yaw + yaw) * ExpSo3(Vec3(pitch, 0, 0));
  const Vec3 ankle_over_toe = sole * Vec3(0, actor.ankle_over_toe, -actor.ankle_behind_toe);
  const Vec3 toe_joint = posture.root + pelvis * ankle - ankle_over_toe;
  return {toe_joint - Vec3(0, actor.toe_height, 0), posture.yaw + yaw, pitch};
}

}  // namespace retarget
