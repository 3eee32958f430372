// Writes the two clips of the piggyback ride, a.bvh (the carrier) and b.bvh (the rider), each as if
// its actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// The carrier walks a curve (walk.h), bent forward, elbows out as if they hooked thighs; every few
// steps he hitches his load up. The rider sat on a high stool: his root stays where it is but for
// breath and sway, his arms are round a neck that is not there, his legs hang astride and swing.
#include "data/actors/hanging.h"
#include "data/actors/restless.h"
#include "data/actors/walk.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

Posture Carrier(const Actor& actor, const Walk& walk, double t) {
  const auto r = [t](int seed) { return Restless(t, seed); };
  const double hitch = Bursts(t, 0.8, {0.55, 3.35, 6.1, 8.9});
  const double gather = Bursts(t, 0.6, {0.2, 3.0, 5.75, 8.55});  // knees bend before it
  const Stride stride = walk.At(t, actor.ankle_behind_toe - 0.05);
  Posture p;
  p.pelvis_deg = Vec3(12 + 1.5 * r(1) + 3 * gather, 0, 0);
  p.spine_deg = Vec3(14 + 2.5 * r(2) + 4 * gather - 4 * hitch, 2 * r(3), 1.5 * r(4));
  StrideInto(stride, {0.965, 0.024, 0.030, 4, 4, 2}, &p);
  p.root.y() += 0.004 * r(5) - 0.028 * gather + 0.010 * hitch;
  p.head_deg =
      Vec3(-16 + 4 * r(6) + 4 * gather, 9 * r(7) + 18 * Bursts(t, 1.8, {2.2, 5.4, 8.2}), 3 * r(8));
  for (const FootSide foot : {kLeft, kRight}) p.feet[foot] = walk.Foot(foot, t);
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 10 : 30;
    const double swing = -x * stride.reach * stride.pace;  // what is left of the arms' swing
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 2 + 2.5 * r(seed) + 5 * hitch;
    arm.protraction_deg = -2 + 3 * r(seed + 1) + 2 * swing;
    arm.knuckles = Vec3(0.28, -0.18 + 0.035 * hitch, 0.09 + 0.02 * swing) +
                   Vec3(0.012 * r(seed + 2), 0.015 * r(seed + 3), 0.015 * r(seed + 4));
    arm.pointing = Vec3(-0.42, 0.72 + 0.1 * r(seed + 5), 0.55);
    arm.palm = Vec3(-0.18, 0.53, -0.83);
    arm.elbow = Vec3(0.80, 0.17 + 0.06 * r(seed + 6), -0.57);
    arm.curl_deg = 40 + 8 * r(seed + 7);
  }
  return p;
}

Posture Rider(const Actor& actor, double t) {
  const auto r = [t](int seed) { return Restless(t, 100 + seed); };
  const double breath = std::sin(2 * kPi * 0.28 * t + 0.6);
  const double snuggle = Bursts(t, 1.6, {2.0, 4.7, 7.3});
  Posture p;
  p.yaw = 0;
  p.root = Vec3(0.006 * r(1), 0.86 + 0.004 * breath, 0.006 * r(2));
  p.pelvis_deg = Vec3(6 + 2 * r(3) + 2 * snuggle, 1.5 * r(4), 2 * r(5));
  p.spine_deg = Vec3(6 + 2.5 * r(6) + 1.5 * breath + 4 * snuggle, 4 * r(7), 3 * r(8));
  p.head_deg = Vec3(4 + 5 * r(9) + 5 * snuggle, 12 * r(10) + 10, 4 + 4 * r(11));
  for (const double x : {1.0, -1.0}) {
    const FootSide side = x > 0 ? kLeft : kRight;
    const int seed = x > 0 ? 20 : 40;
    const double kick = Restless(t, 100 + seed, 0.5, 1.4);
    const Vec3 ankle =
        Vec3(x * (0.32 + 0.012 * r(seed + 1)), -0.33 + 0.02 * kick, 0.555 + 0.045 * kick) *
        (actor.Length("LeftLeg") / 0.41);
    p.feet[side] = HangingFoot(actor, p, ankle, x * (42 + 4 * r(seed + 2)) * kDegree,
                               (28 + 10 * r(seed + 3) + 6 * kick) * kDegree);
    ArmPosture& arm = p.arms[side];
    arm.shrug_deg = 10 + 3 * r(seed + 4) + 1.5 * breath + 3 * snuggle;
    arm.protraction_deg = 17 + 3 * r(seed + 5) + 3 * snuggle;
    arm.knuckles = Vec3(x > 0 ? -0.035 : -0.01, 0.235 + 0.02 * x, 0.45 - 0.02 * snuggle) +
                   Vec3(0.012 * r(seed + 6), 0.015 * r(seed + 7), 0.015 * r(seed + 8));
    arm.pointing = Vec3(-0.99, -0.03 + 0.08 * r(seed + 9), 0.09);
    arm.palm = Vec3(-0.07, -0.41, -0.91);
    arm.elbow = Vec3(0.97, -0.05 + 0.08 * r(seed + 10), 0.23);
    arm.curl_deg = 45 + 10 * r(seed + 11);
  }
  return p;
}

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor carrier = MakeActor({1.84, 1.00, 1.04, 1.00, 1.00, 0.077, 0.033});
  const Actor rider = MakeActor({1.63, 0.99, 0.97, 1.00, 1.01, 0.068, 0.029});
  const Walk curve({.start = 1.25,
                    .steps = 13,
                    .first = kLeft,
                    .length = {0.40, 0.37},
                    .time = {0.59, 0.61},
                    .half_width = 0.12,
                    .toe_out_deg = 8,
                    .bends = {{0.4, 4.4, 85}},
                    .toe_clearance = 0.035});
  return WriteClip(folder + "/a.bvh", carrier, kSeconds, {0.4, -1.5, 20},
                   [&](double t) { return Carrier(carrier, curve, t); }) &&
         WriteClip(folder + "/b.bvh", rider, kSeconds, {1.0, 0.3, -110},
                   [&](double t) { return Rider(rider, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
