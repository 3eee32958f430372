// Writes the two clips of the fireman's carry, a.bvh (the carrier) and b.bvh (the carried), each as
// if its actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// The carrier kneels on the right knee, leans over the left foot, rises, sets the right foot beside
// it, hitches up and walks off along a curve (walk.h). The carried lay face down over a block in
// the posture of the template, limp: his root stays where it is but for breath, his head lolls, his
// free arm and his legs dangle.
#include "data/actors/limp.h"
#include "data/actors/restless.h"
#include "data/actors/walk.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10.5;

// The template's joint rotations of the carried, to a degree; the right arm is held off the leg.
const Vec3 kLeftArm(-52, -76, -14);
const Vec3 kLeftForeArm(23, -30, 6);
const Vec3 kLeftHand(0, 7, -9);
const Vec3 kRightArm(31, 16, 7);
const Vec3 kRightForeArm(-25, 48, 17);
const Vec3 kRightHand(0, -4, -12);
const Vec3 kLeftUpLeg(-73, 23, 2);
const Vec3 kLeftLeg(39, 0, 0);
const Vec3 kLeftFoot(21, -14, -5);
const Vec3 kRightUpLeg(-89, -78, 7);
const Vec3 kRightLeg(37, -6, 9);
const Vec3 kRightFoot(33, 26, 7);

// From 0 kneeling to 1 standing: the trunk goes ahead first, then up; the foot behind comes last.
double Ahead(double t) { return MinimumJerk((t - 0.8) / 1.5); }
double Up(double t) { return MinimumJerk((t - 1.15) / 1.75); }
double FootUp(double t) { return MinimumJerk((t - 2.15) / 0.75); }

// The right foot stands on its toes behind the kneeling man, then steps up beside the left.
FootPose RisingFoot(const FootPose& standing, double t) {
  const double behind = 1 - FootUp(t);
  FootPose foot = standing;
  foot.toe += Vec3(-0.02, 0, -0.70) * behind;
  foot.toe.y() += 0.09 * Bump((t - 2.15) / 0.75);
  foot.pitch += 58 * kDegree * behind + 10 * kDegree * Bump((t - 1.6) / 1.1);
  return foot;
}

Posture Carrier(const Actor& actor, const Walk& walk, double t) {
  const auto r = [t](int seed) { return Restless(t, seed); };
  const double effort = Bursts(t, 1.9, {1.85});
  const double gather = Bursts(t, 0.6, {3.2, 6.45}), hitch = Bursts(t, 0.7, {3.55, 6.8});
  const Stride stride = walk.At(t, actor.ankle_behind_toe - 0.05);
  Posture p;
  p.pelvis_deg = Vec3(10 + 6 * (1 - Up(t)) + 13 * effort + 1.2 * r(1) + 3 * gather, 0, 0);
  p.spine_deg = Vec3(11 + 3 * effort + 2 * r(2) - 3 * hitch, 2 + 1.5 * r(3), 5 + 1.5 * r(4));
  StrideInto(stride, {0.972, 0.022, 0.030, 4, 3.5, 0}, &p);
  p.root += Vec3(0.02, 0, -0.33) * (1 - Ahead(t));
  p.root.y() += -0.362 * (1 - Up(t)) + 0.004 * r(5) - 0.028 * gather + 0.008 * hitch;
  p.head_deg =
      Vec3(-6 - 10 * effort + 4 * r(6), 7 * r(7) + 14 * Bursts(t, 1.5, {4.6, 8.0}), 2 + 2 * r(8));
  p.feet[kLeft] = walk.Foot(kLeft, t);
  p.feet[kRight] = RisingFoot(walk.Foot(kRight, t), t);

  ArmPosture& right = p.arms[kRight];  // round a leg, hand at a wrist
  right.shrug_deg = -9 + 2.5 * r(10) + 4 * hitch;
  right.protraction_deg = 3 * r(11);
  right.knuckles = Vec3(0.29, 0.16 + 0.02 * hitch, 0.34) + 0.012 * Vec3(r(12), r(13), r(14));
  right.pointing = Vec3(-0.97, 0.2 + 0.08 * r(15), 0.05);
  right.palm = Vec3(-0.06, -0.10, -0.99);
  right.elbow = Vec3(0.58, -0.68 + 0.05 * r(16), -0.45);
  right.curl_deg = 60 + 8 * r(17);

  // The free arm: on the left knee to push off, then it swings against the left leg.
  const double swing = -stride.reach * stride.pace, kneeling = 1 - MinimumJerk((t - 1.5) / 1.0);
  ArmPosture& left = p.arms[kLeft];
  left.shrug_deg = -3 + 2.5 * r(20) + 3 * effort;
  left.protraction_deg = 1 + 3 * r(21) + 4 * swing;
  const Vec3 free(0.33 + 0.01 * r(22), -0.27, 0.20 + 0.13 * swing), knee(0.20, -0.06, 0.47);
  left.knuckles = free + kneeling * (knee - free) + 0.012 * Vec3(0, r(23), r(24));
  left.pointing = Vec3(-0.15, -0.75, 0.6 + 0.2 * swing);
  left.palm = Vec3(-0.99 + 0.8 * kneeling, 0.13 - 0.9 * kneeling, -0.09);
  left.elbow = Vec3(0.54 + 0.2 * kneeling, -0.34, -0.77);
  left.curl_deg = 40 + 10 * r(25);
  return p;
}

LimpPosture Carried(double t) {
  const auto r = [t](int seed) { return Restless(t, 100 + seed); };
  const auto slack = [t](int seed) { return Restless(t, 100 + seed, 0.25, 1.1); };
  const double breath = std::sin(2 * kPi * 0.3 * t + 0.4);
  const double groan = Bursts(t, 1.4, {2.4, 5.6, 8.7});
  LimpPosture p;
  p.root = Vec3(0.004 * r(1), 1.06 + 0.004 * breath, 0.004 * r(2));
  p.hips_deg = Vec3(54.3 + 1.2 * r(3), 77.6 + 1.2 * r(4), -54.3 + 1.2 * r(5));
  const Vec3 lower(15 + 1.5 * r(6) + breath, 0, 10 + r(7));
  const Vec3 upper(13 + 2 * r(8) + breath - 4 * groan, 3, 8 + 1.5 * r(9));
  p.turns = {{"Spine", 0.5 * lower},
             {"Spine1", 0.5 * lower},
             {"Spine2", upper},
             {"Neck", Vec3(8 + 6 * slack(10) - 9 * groan, 5 * slack(11), 4 * slack(12))},
             {"Head", Vec3(4 * slack(13) - 4 * groan, 4 * slack(14), 3 * slack(15))},
             {"RightShoulder", Vec3(1, 16 + 2 * r(16), 1 + 2 * r(17))},
             {"LeftArm", kLeftArm + Vec3(5 * slack(20), 6 * slack(21), 7 * slack(22))},
             {"LeftForeArm", kLeftForeArm + Vec3(0, 7 * slack(23), 0)},
             {"LeftHand", kLeftHand + Vec3(0, 6 * slack(24), 8 * slack(25))},
             {"RightArm", kRightArm + Vec3(2 * r(26), -6 + 1.5 * r(27), 1.5 * r(28))},
             {"RightForeArm", kRightForeArm + Vec3(0, -8 + 2 * r(29), 0)},
             {"RightHand", kRightHand + Vec3(0, 5 * r(30), 4 * r(31))},
             {"LeftUpLeg", kLeftUpLeg + Vec3(4 * slack(32), 3 * slack(33), 3 * slack(34))},
             {"LeftLeg", kLeftLeg + Vec3(7 * slack(35) + 6 * groan, 0, 0)},
             {"LeftFoot", kLeftFoot + Vec3(6 * slack(36), 0, 0)},
             {"RightUpLeg", kRightUpLeg + Vec3(1.5 * slack(37), 1.5 * slack(38), 1.5 * slack(39))},
             {"RightLeg", kRightLeg + Vec3(2 * slack(40) + 3 * groan, 0, 0)},
             {"RightFoot", kRightFoot + Vec3(6 * slack(41), 0, 0)}};
  return p;
}

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor carrier = MakeActor({1.86, 1.00, 1.04, 1.00, 1.00, 0.078, 0.033});
  const Actor carried = MakeActor({1.72, 0.99, 0.98, 1.01, 1.00, 0.072, 0.031});
  const Walk curve({.start = 4.1,
                    .steps = 9,
                    .first = kLeft,
                    .length = {0.37, 0.39},
                    .time = {0.63, 0.61},
                    .half_width = 0.125,
                    .toe_out_deg = 7,
                    .bends = {{0.4, 2.8, -45}},
                    .toe_clearance = 0.035});
  return WriteClip(folder + "/a.bvh", carrier, kSeconds, {-0.5, -1.0, -30},
                   [&](double t) { return Carrier(carrier, curve, t); }) &&
         WriteClip(folder + "/b.bvh", carried, kSeconds, {0.6, 0.4, 125}, Carried);
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
