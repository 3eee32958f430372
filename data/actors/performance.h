// What the generators of the shipped holds share: a figure that stands or has its legs in the air,
// where two people stand who hold each other.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "data/actors/actor.h"
#include "data/actors/gait.h"
#include "data/actors/restless.h"

namespace retarget {

// Feet and pelvis of somebody on his feet; trunk, head and arms are up to the performance. The
// pelvis hangs `ahead` (m) of the ankles.
inline Posture OnFeet(const Actor& actor, const Gait& gait, double t, double root_height,
                      double ahead = 0.03) {
  Posture p{};
  p.root = gait.Support(t, actor.ankle_behind_toe - ahead, &p.yaw);
  p.root.y() = root_height;
  for (const FootSide foot : {kLeft, kRight}) p.feet[foot] = gait.Foot(foot, t);
  return p;
}

// A leg that bears nothing, in the frame of the pelvis (right leg: x mirrored, so that out is +x).
struct LegPosture {
  Vec3 ankle;     // from the hip (m)
  Vec3 knee;      // where the knee goes
  Vec3 pointing;  // from the ankle to the toes
};

inline void PoseFreeLeg(const Actor& actor, FootSide foot, const LegPosture& leg, Figure* figure) {
  const double x = foot == kLeft ? 1 : -1;
  const std::string side = foot == kLeft ? "Left" : "Right";
  Rotations& world = figure->world;
  const auto to_world = [&](const Vec3& v) {
    return world.at("Hips") * Vec3(x * v.x(), v.y(), v.z());
  };
  const double upper = actor.Length(side + "Leg"), lower = actor.Length(side + "Foot");
  const Vec3 hip = PositionOf(actor, side + "UpLeg", figure->root, world);
  const Vec3 ankle = hip + WithinReach(to_world(leg.ankle), upper + lower);
  const Vec3 knee = MiddleJoint(hip, ankle, upper, lower, to_world(leg.knee));
  AimHinge(-Vec3::UnitY(), Vec3::UnitX(), knee - hip, ankle - knee, &world[side + "UpLeg"],
           &world[side + "Leg"]);
  // The toe joint lies below the ankle; toes are straight.
  const Vec3 toe = actor.joints[actor.Find(side + "ToeBase")].offset;
  world[side + "Foot"] = Aim(toe, Vec3::UnitY(), to_world(leg.pointing), knee - ankle);
  world[side + "ToeBase"] = world[side + "Foot"];
}

// Where one of two people stands who move as a pair: `beside` (x to the left, z ahead, yaw) from
// the pair's place, told in his own frame, which begins where he stands at first.
inline Place PlaceInPair(const Place& pair, const Place& beside) {
  const auto at = [&](const Place& p) {
    const Vec3 v = YawRotation(p.yaw_deg * kDegree) * Vec3(beside.x, 0, beside.z);
    return Place{p.x + v.x(), p.z + v.z(), p.yaw_deg + beside.yaw_deg};
  };
  const Place here = at(pair), first = at({});
  const Vec3 v =
      YawRotation(-first.yaw_deg * kDegree) * Vec3(here.x - first.x, 0, here.z - first.z);
  return {v.x(), v.z(), here.yaw_deg - first.yaw_deg};
}

// Steps of one of the pair out of a plan for both: what is given to `to` is the pair's place.
inline Gait GaitInPair(const Stance& stance, const Place& beside, std::vector<Step> steps) {
  for (Step& step : steps) step.to = PlaceInPair(step.to, beside);
  return Gait(stance, std::move(steps));
}

}  // namespace retarget
