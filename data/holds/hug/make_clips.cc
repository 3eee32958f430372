// Writes the two clips of the hug, a.bvh (the taller) and b.bvh (the smaller), each as if its actor
// had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// Both sway from foot to foot in the same slow time, which they were given beforehand, and step the
// free foot round a little at every sway, so that each turns about a place in front of him. Phase,
// depth, turn and the instants of their squeezes are their own.
#include <vector>

#include "data/actors/gait.h"
#include "data/actors/restless.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10, kBeat = 2.5;  // s from one sway to the left to the next

// How one of them dances: times in s, lengths in m, angles in degrees.
struct Sway {
  double side;     // 1: to his left first; -1: to his right
  double late;     // behind the beat
  double width;    // of the pelvis's way to either side
  double ahead;    // he turns about a place this far before him
  double turn;     // at every step of a foot
  double reverse;  // when he begins to turn back
};

// Where he stands after he has turned by `turn_deg` about the place before him.
Place Turned(double ahead, double turn_deg) {
  const Vec3 back = YawRotation(turn_deg * kDegree) * Vec3(0, 0, -ahead);
  return {back.x(), ahead + back.z(), turn_deg};
}

// The free foot steps half-way through each sway to the other side.
std::vector<Step> StepsOf(const Sway& sway) {
  std::vector<Step> steps;
  double turned = 0;
  for (int k = 0; k < 7; ++k) {
    const double middle = (0.25 + 0.5 * k) * kBeat + sway.late + 0.6;
    const bool to_left = (k % 2 == 0) == (sway.side > 0);
    turned += middle < sway.reverse ? sway.turn : -sway.turn;
    steps.push_back(
        {to_left ? kRight : kLeft, middle - 0.25, 0.46, Turned(sway.ahead, turned), 0.035, 16});
  }
  return steps;
}

// -1 to 1, to his left, in the time of the steps; he begins slowly.
double SideAt(const Sway& sway, double t) {
  const double wave = std::sin(2 * kPi * (t - 0.6 - sway.late) / kBeat);
  return sway.side * wave * MinimumJerk((t - 0.2) / 1.0) * MinimumJerk((kSeconds + 0.2 - t) / 1.0);
}

Posture Swaying(const Actor& actor, const Gait& gait, const Sway& sway, double height, double t) {
  const double side = SideAt(sway, t);
  Posture p;
  p.root = gait.Support(t, actor.ankle_behind_toe - 0.03, &p.yaw);
  p.root += YawRotation(p.yaw) * Vec3(sway.width * side, 0, 0);
  p.root.y() = height - 0.008 * side * side;
  p.pelvis_deg = Vec3(0, 0, 3.5 * side);
  p.spine_deg = Vec3(0, 3 * side, -2.5 * side);
  for (const FootSide foot : {kLeft, kRight}) p.feet[foot] = gait.Foot(foot, t);
  return p;
}

// The taller stoops: right arm over a shoulder, left arm under an arm, hands behind a back.
Posture Taller(const Actor& actor, const Gait& gait, const Sway& sway, double t) {
  const auto r = [t](int seed) { return Restless(t, seed); };
  const double squeeze = Bursts(t, 1.5, {1.9, 5.3, 8.3});
  const double side = SideAt(sway, t);
  Posture p = Swaying(actor, gait, sway, 0.985, t);
  p.root += Vec3(0.006 * r(1), -0.006 * squeeze, 0.008 * r(2));
  p.pelvis_deg += Vec3(9 + 1.5 * r(3) + 1.5 * squeeze, 1.5 * r(4), 0);
  p.spine_deg += Vec3(13 + 2.5 * r(5) + 3 * squeeze, -1 + 3 * r(6), 1.5 * r(7));
  p.head_deg = Vec3(-15 + 4 * r(8) + 4 * squeeze, -11 + 7 * r(9), -12 + 3 * r(10) - 3 * side);
  ArmPosture& over = p.arms[kRight];
  over.shrug_deg = 9 + 2.5 * r(20) + 3 * squeeze;
  over.protraction_deg = 3 + 3 * r(21) + 4 * squeeze;
  over.knuckles =
      Vec3(0.03, 0.26 - 0.01 * squeeze, 0.51 - 0.02 * squeeze) + 0.012 * Vec3(r(22), r(23), r(24));
  over.pointing = Vec3(-0.59, -0.71 + 0.1 * r(25), 0.39);
  over.palm = Vec3(-0.06, -0.45, -0.89);
  over.elbow = Vec3(0.70, 0.71 + 0.08 * r(26), 0.04);
  over.curl_deg = 35 + 8 * r(27);
  ArmPosture& under = p.arms[kLeft];
  under.shrug_deg = -4 + 2.5 * r(30) + 3 * squeeze;
  under.protraction_deg = 9 + 3 * r(31) + 4 * squeeze;
  under.knuckles =
      Vec3(0.03, 0.20 + 0.01 * squeeze, 0.49 - 0.02 * squeeze) + 0.012 * Vec3(r(32), r(33), r(34));
  under.pointing = Vec3(-0.77, 0.63 + 0.1 * r(35), 0.05);
  under.palm = Vec3(-0.31, -0.30, -0.90);
  under.elbow = Vec3(0.88, -0.46 + 0.08 * r(36), 0.09);
  under.curl_deg = 35 + 8 * r(37);
  return p;
}

// The smaller stretches up to him; now and then a pat on the back.
Posture Smaller(const Actor& actor, const Gait& gait, const Sway& sway, double t) {
  const auto r = [t](int seed) { return Restless(t, 100 + seed); };
  const double squeeze = Bursts(t, 1.6, {2.2, 5.0, 8.5});
  const double pat = Bursts(t, 0.34, {3.6, 3.95, 4.3, 6.8, 7.15});
  const double side = SideAt(sway, t);
  Posture p = Swaying(actor, gait, sway, 0.912, t);
  p.root += Vec3(0.006 * r(1), 0.006 * squeeze, 0.008 * r(2));
  p.pelvis_deg += Vec3(-3 + 1.5 * r(3), 1.5 * r(4), 0);
  p.spine_deg += Vec3(1 + 2.5 * r(5) + 2 * squeeze, 2 + 3 * r(6), -6 + 1.5 * r(7));
  p.head_deg = Vec3(-10 + 4 * r(8) + 3 * squeeze, -13 + 7 * r(9), -11 + 3 * r(10) - 3 * side);
  ArmPosture& over = p.arms[kRight];
  over.shrug_deg = 18 + 2.5 * r(20) + 3 * squeeze;
  over.protraction_deg = 7 + 3 * r(21) + 4 * squeeze;
  over.knuckles = Vec3(0.03, 0.15 + 0.015 * pat, 0.49 - 0.02 * squeeze + 0.02 * pat) +
                  0.012 * Vec3(r(22), r(23), r(24));
  over.pointing = Vec3(-0.56, -0.77 + 0.1 * r(25) + 0.2 * pat, 0.31);
  over.palm = Vec3(-0.28, -0.17, -0.94);
  over.elbow = Vec3(0.62, 0.75 + 0.08 * r(26), 0.22);
  over.curl_deg = 30 + 8 * r(27);
  ArmPosture& under = p.arms[kLeft];
  under.shrug_deg = 1 + 2.5 * r(30) + 3 * squeeze;
  under.protraction_deg = 11 + 3 * r(31) + 4 * squeeze;
  under.knuckles = Vec3(0.05, 0.14, 0.49 - 0.02 * squeeze) + 0.012 * Vec3(r(32), r(33), r(34));
  under.pointing = Vec3(-0.79, 0.58 + 0.1 * r(35), 0.19);
  under.palm = Vec3(-0.19, 0.07, -0.98);
  under.elbow = Vec3(0.92, -0.40 + 0.08 * r(36), -0.01);
  under.curl_deg = 35 + 8 * r(37);
  return p;
}

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor taller = MakeActor({1.84, 1.00, 1.03, 1.01, 1.00, 0.077, 0.033});
  const Actor smaller = MakeActor({1.64, 0.99, 0.97, 1.00, 1.00, 0.068, 0.029});
  const Sway leads{1, 0, 0.026, 0.24, 9, 6.2}, follows{-1, 0.12, 0.022, 0.20, 8, 6.0};
  const Gait of_taller({0.13, 0.04, 8}, StepsOf(leads));
  const Gait of_smaller({0.10, -0.04, 8}, StepsOf(follows));
  return WriteClip(folder + "/a.bvh", taller, kSeconds, {0, 0, 0},
                   [&](double t) { return Taller(taller, of_taller, leads, t); }) &&
         WriteClip(folder + "/b.bvh", smaller, kSeconds, {0.8, -0.5, 70},
                   [&](double t) { return Smaller(smaller, of_smaller, follows, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
