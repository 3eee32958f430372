// Writes the two clips of the supported walk, a.bvh (the helper) and b.bvh (the injured), each as
// if its actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// Both walk (walk.h) on plans of their own: the helper with even steps, the injured with a limp,
// that is, with a short time on the hurt right leg, a short step of the left past it, and a sag of
// the pelvis and a lean of the trunk over it (antalgic gait: J. Perry and J. M. Burnfield, "Gait
// Analysis", 2010). The helper walks faster, with longer steps, and along another curve.
#include "data/actors/restless.h"
#include "data/actors/walk.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

// The helper: trunk bent under the load, the right hand in front of the right shoulder as if it
// held a wrist there, the left arm behind a back that is not there. Now and then he hitches up.
Posture Helper(const Actor& actor, const Walk& walk, double t) {
  const auto r = [t](int seed) { return Restless(t, seed); };
  const double hitch = Bursts(t, 0.9, {2.6, 5.2, 7.7});
  const Stride stride = walk.At(t, actor.ankle_behind_toe - 0.03);
  Posture p;
  p.pelvis_deg = Vec3(5 + 1.5 * r(1) - 2 * hitch, 0, 0);
  p.spine_deg = Vec3(9 + 2.5 * r(2) - 4 * hitch, 9 + 2 * r(3), 4 + 1.5 * r(4));
  StrideInto(stride, {0.918, 0.024, 0.030, 4, 4, 3}, &p);
  p.root.y() += 0.004 * r(5) + 0.012 * hitch;
  p.head_deg = Vec3(-8 + 5 * r(6), 10 * r(7) + 14 * Bursts(t, 1.6, {3.4, 6.9}), -6 + 3 * r(8));
  for (const FootSide foot : {kLeft, kRight}) p.feet[foot] = walk.Foot(foot, t);

  ArmPosture& left = p.arms[kLeft];  // round the other's back
  left.shrug_deg = 7 + 3 * r(10) + 4 * hitch;
  left.protraction_deg = -14 + 3 * r(11);
  left.knuckles = Vec3(0.56, -0.10, 0.01) + Vec3(0.02 * r(12), 0.025 * r(13), 0.02 * r(14));
  left.pointing = Vec3(0.45, -0.04 + 0.1 * r(15), 0.89);
  left.palm = Vec3(-0.90, 0.18, 0.41);
  left.elbow = Vec3(-0.32, -0.33 + 0.05 * r(16), -0.89);
  left.curl_deg = 35 + 8 * r(17);

  ArmPosture& right = p.arms[kRight];  // holds a wrist
  right.shrug_deg = 5 + 3 * r(20) + 3 * hitch;
  right.protraction_deg = 2 + 3 * r(21);
  right.knuckles =
      Vec3(0.23, 0.27, 0.06) + Vec3(0.015 * r(22), 0.02 * r(23) - 0.02 * hitch, 0.015 * r(24));
  right.pointing = Vec3(-0.59, 0.76, -0.23 + 0.1 * r(25));
  right.palm = Vec3(-0.53, -0.64, -0.56);
  right.elbow = Vec3(0.10, -0.79, -0.59 + 0.08 * r(26));
  right.curl_deg = 60 + 10 * r(27);
  return p;
}

// The injured: the right arm up over shoulders that are not there, the left swings with the right
// leg; head and trunk sink over the hurt leg, and every few steps he all but buckles.
Posture Injured(const Actor& actor, const Walk& walk, double t) {
  const auto r = [t](int seed) { return Restless(t, 100 + seed); };
  const double buckle = Bursts(t, 1.1, {3.55, 7.1});
  const Stride stride = walk.At(t, actor.ankle_behind_toe - 0.03);
  const double hurt = stride.pace * std::max(0.0, 1 - 2 * stride.left_load);
  const double pain = hurt * hurt;
  Posture p;
  p.pelvis_deg = Vec3(3 + 1.5 * r(1) + 3 * buckle, 0, 4 * pain);
  p.spine_deg = Vec3(5 + 2 * r(2) + 5 * pain + 6 * buckle, 3 * r(3), 2 + 1.5 * r(4) + 4 * pain);
  StrideInto(stride, {0.985, 0.020, 0.030, 5, 3, 5}, &p);
  p.root.y() += 0.004 * r(5) - 0.018 * pain - 0.030 * buckle;
  p.head_deg = Vec3(9 + 4 * r(6) + 7 * pain + 6 * buckle, 9 * r(7), 3 + 4 * r(8));
  for (const FootSide foot : {kLeft, kRight}) p.feet[foot] = walk.Foot(foot, t);

  ArmPosture& right = p.arms[kRight];  // over the other's shoulders
  right.shrug_deg = 19 + 3 * r(10) + 4 * pain;
  right.protraction_deg = -17 + 3 * r(11);
  right.knuckles = Vec3(0.58, 0.26, 0.14) + Vec3(0.02 * r(12), 0.02 * r(13), 0.02 * r(14));
  right.pointing = Vec3(0.00, -0.60, 0.78 + 0.1 * r(15));
  right.palm = Vec3(0.63, -0.63, -0.44);
  right.elbow = Vec3(0.23, 0.17, -0.96);
  right.curl_deg = 40 + 8 * r(16);

  const double swing = -0.75 * stride.reach * stride.pace;  // against the left leg
  ArmPosture& left = p.arms[kLeft];
  left.shrug_deg = 2 + 3 * r(20) + 4 * pain;
  left.protraction_deg = 3 + 3 * r(21) + 5 * swing;
  left.knuckles = Vec3(0.27 + 0.015 * r(22), -0.33 + 0.03 * std::abs(swing), 0.12 + 0.16 * swing) +
                  Vec3(0.04, 0.05, 0.05) * buckle;
  left.pointing = Vec3(-0.1, -0.9, 0.35 + 0.25 * swing);
  left.palm = Vec3(-0.98, 0.1, -0.06);
  left.elbow = Vec3(0.6, 0, -0.8);
  left.curl_deg = 50 + 10 * r(23);
  return p;
}

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor helper = MakeActor({1.70, 1.01, 1.04, 1.00, 0.99, 0.070, 0.030});
  const Actor injured = MakeActor({1.83, 0.99, 0.98, 1.01, 1.01, 0.077, 0.033});
  const Walk even({.start = 0.75,
                   .steps = 13,
                   .first = kRight,
                   .length = {0.40, 0.39},
                   .time = {0.62, 0.62},
                   .half_width = 0.105,
                   .toe_out_deg = 5,
                   .bends = {{0.6, 2.6, 16}, {3.2, 4.6, -10}}});
  const Walk limp({.start = 0.85,
                   .steps = 14,
                   .first = kRight,
                   .length = {0.27, 0.43},
                   .time = {0.50, 0.68},
                   .half_width = 0.095,
                   .toe_out_deg = 6,
                   .bends = {{0.8, 2.4, 20}, {3.0, 4.4, -16}},
                   .toe_clearance = 0.025,
                   .heel_lift_deg = 26,
                   .toe_lift_deg = 10});
  return WriteClip(folder + "/a.bvh", helper, kSeconds, {0, 0, 0},
                   [&](double t) { return Helper(helper, even, t); }) &&
         WriteClip(folder + "/b.bvh", injured, kSeconds, {-1.2, 0.7, -65},
                   [&](double t) { return Injured(injured, limp, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
