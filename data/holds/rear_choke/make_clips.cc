// Writes the two clips of the rear choke, a.bvh (the attacker) and b.bvh (his opponent), each as if
// its actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// The attacker drags his man backwards, swings him round to the right and, when he weakens, lets
// him sink. The opponent claws at the forearm, bends forward to throw the man on his back, twists,
// stamps, is dragged along, and in the end slaps the arm. Nothing is captured data: see actor.h.
#include "data/actors/performance.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

// What happens to the pair: b bends forward to throw him, a hauls him back; in the end b sinks.
double Throw(double t) { return Bursts(t, 1.5, {1.0, 4.15}) + 0.7 * Bursts(t, 1.1, {6.9}); }
double Haul(double t) { return Plateau(t, 1.7, 3.2, 0.5) + 0.8 * Plateau(t, 7.1, 8.0, 0.5); }
double Sink(double t) { return Plateau(t, 8.1, 12.0, 1.5); }
double Struggle(double t) {
  return (Bursts(t, 2.0, {1.1, 4.2, 6.9}) + 0.6 * Bursts(t, 1.4, {2.9, 5.6})) * (1 - 0.6 * Sink(t));
}

Figure Attacker(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 400 + seed); };
  const double lift = Throw(t - 0.12), haul = Haul(t), sink = Sink(t - 0.15);
  const double effort = 0.5 + 0.55 * Struggle(t - 0.12);
  const double squeeze = Bursts(t, 1.1, {0.5, 2.5, 5.2, 8.6, 9.5});
  Posture p = OnFeet(actor, gait, t, 0.945 - 0.035 * haul - 0.09 * sink, 0.03 - 0.03 * haul);
  p.root += Vec3(0.013 * r(1), 0.008 * r(2), 0.012 * r(3)) * effort;
  p.yaw += 2 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(-3 - 5 * haul + 9 * lift + 4 * sink + 2 * r(5), 0, 2 * r(6) * effort);
  p.spine_deg = Vec3(7 - 4 * haul + 7 * lift + 6 * sink + 3 * r(7) * effort, 8 * r(8) * effort,
                     4 * r(9) * effort);
  // His cheek against the back of his own hand; he shakes his head clear now and then.
  p.head_deg = Vec3(-4 + 4 * r(10), -20 + 8 * r(11), 17 + 4 * r(12));

  const Vec3 tug = Vec3(0.008 * r(13), 0.012 * r(14), 0.012 * r(15)) * effort;
  ArmPosture& left = p.arms[kLeft];
  left.shrug_deg = 6 + 3 * r(20) * effort + 4 * squeeze;
  left.protraction_deg = 10 + 3 * r(21);
  left.knuckles = Vec3(0.015, 0.385, 0.135) + tug + Vec3(0, 0, 0.015) * squeeze;
  left.pointing = Vec3(-0.97, -0.2 + 0.1 * r(22), -0.1);
  left.palm = Vec3(-0.08, -0.16, 0.98);
  left.elbow = Vec3(0.5, 0.08 + 0.1 * r(23), 0.86);
  left.curl_deg = 35 + 10 * r(24);
  ArmPosture& right = p.arms[kRight];
  right.shrug_deg = 19 + 3 * r(30) * effort + 4 * squeeze;
  right.protraction_deg = 14 + 3 * r(31) - 3 * squeeze;
  right.knuckles =
      Vec3(-0.2, 0.27, 0.345) + Vec3(-tug.x(), tug.y(), tug.z()) + Vec3(0, 0.01, -0.02) * squeeze;
  right.pointing = Vec3(-0.97, -0.2, -0.17 + 0.08 * r(32));
  right.palm = Vec3(0.2, -0.15, -0.97);
  right.elbow = Vec3(0.55, 0.22 + 0.1 * r(33), 0.8);
  right.curl_deg = 60 + 8 * r(34);
  return FigureOf(actor, p);
}

Figure Opponent(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 500 + seed); };
  const double bend = Throw(t), haul = Haul(t - 0.1), sink = Sink(t);
  const double struggle = Struggle(t), effort = 0.4 + 0.75 * struggle;
  const double slap = std::sin(2 * kPi * 2.6 * t) * Plateau(t, 8.2, 9.6, 0.4);
  Posture p = OnFeet(actor, gait, t, 0.905 - 0.03 * bend - 0.01 * haul - 0.075 * sink,
                     0.0 + 0.05 * bend + 0.03 * haul);
  p.root += Vec3(0.018 * r(1), 0.008 * r(2), 0.012 * r(3)) * effort;
  p.yaw += 3 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(-6 + 10 * bend - 3 * haul + 2 * r(5) * effort, 0, 3 * r(6) * effort);
  p.spine_deg = Vec3(-4 + 13 * bend - 1 * haul + 6 * sink + 4 * r(7) * effort, 12 * r(8) * effort,
                     6 * r(9) * effort);
  p.head_deg =
      Vec3(4 + 4 * r(10) * effort - 4 * haul, 10 * r(11) * effort, -4 + 4 * r(12) * effort);
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 40;
    const auto quick = [&](int k) { return Restless(t, 500 + seed + k, 0.7, 1.8) * effort; };
    // The right hand claws throughout; the left also reaches back for the head behind his own.
    const double reach = x > 0 ? Bursts(t, 1.5, {2.75, 5.75}) : 0.0;
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 7 + 4 * r(seed) * effort;
    arm.protraction_deg = 6 + 4 * r(seed + 1) - 8 * reach;
    arm.knuckles = Vec3(x > 0 ? 0.05 : 0.10, 0.25, 0.25) +
                   Vec3(0.02 * quick(2), 0.035 * quick(3), 0.01 + 0.02 * quick(4)) +
                   reach * Vec3(0.33, 0.16, -0.12) + Vec3(0, 0, -0.03) * bend;
    if (x < 0) arm.knuckles += Vec3(0.02, -0.02, 0.045) * slap + Vec3(0.02, -0.02, 0.06) * sink;
    if (x > 0) arm.knuckles += Vec3(0.10, -0.22, 0.05) * sink;  // it drops
    arm.pointing = Vec3(-0.6 + 0.5 * reach, 0.72, 0.1 + 0.15 * quick(5));
    arm.palm = Vec3(-0.7, -0.65, -0.3);
    arm.elbow = Vec3(0.72, -0.65 + 0.12 * quick(6), 0.1);
    arm.curl_deg = 65 - 30 * sink + 10 * r(seed + 7);
  }
  return FigureOf(actor, p);
}

// Places are the pair's: dragged back, swung round to the right, dragged back once more.
const std::vector<Step> kAttackerSteps = {{kRight, 1.78, 0.42, {0.00, -0.20, 0}, 0.05, 12},
                                          {kLeft, 2.26, 0.44, {0.00, -0.36, -2}, 0.05, 12},
                                          {kRight, 2.78, 0.42, {0.01, -0.42, -3}, 0.05, 12},
                                          {kLeft, 4.88, 0.44, {0.02, -0.43, -24}},
                                          {kRight, 5.42, 0.44, {0.03, -0.43, -42}},
                                          {kLeft, 5.96, 0.40, {0.03, -0.43, -48}},
                                          {kRight, 7.16, 0.44, {0.13, -0.53, -48}, 0.05, 12},
                                          {kLeft, 7.70, 0.42, {0.15, -0.55, -45}, 0.05, 12}};
const std::vector<Step> kOpponentSteps = {{kLeft, 0.62, 0.32, {0.02, 0.02, 0}, 0.07, 8},
                                          {kRight, 1.90, 0.42, {0.00, -0.22, 1}, 0.05, 10},
                                          {kLeft, 2.40, 0.42, {0.00, -0.38, -2}, 0.05, 10},
                                          {kRight, 2.92, 0.40, {0.01, -0.42, -4}, 0.05, 10},
                                          {kRight, 3.92, 0.30, {0.01, -0.41, -4}, 0.11, 6},
                                          {kRight, 4.96, 0.42, {0.02, -0.43, -22}},
                                          {kLeft, 5.50, 0.44, {0.03, -0.43, -44}},
                                          {kRight, 6.04, 0.42, {0.03, -0.43, -49}},
                                          {kLeft, 7.24, 0.42, {0.12, -0.52, -47}, 0.05, 10},
                                          {kRight, 7.76, 0.44, {0.15, -0.55, -45}, 0.05, 10}};

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor attacker = MakeActor({1.83, 1.00, 1.02, 1.02, 1.00, 0.075, 0.032});
  const Actor opponent = MakeActor({1.69, 1.01, 0.99, 1.00, 0.99, 0.071, 0.030});
  const Gait hauling = GaitInPair({0.23, 0.24, 12}, {0.01, -0.16}, kAttackerSteps);
  const Gait staggering = GaitInPair({0.165, 0.07, 11}, {0, 0.16}, kOpponentSteps);
  return WriteClip(folder + "/a.bvh", attacker, kSeconds, {-0.6, 0.3, 15},
                   [&](double t) { return Attacker(attacker, hauling, t); }) &&
         WriteClip(folder + "/b.bvh", opponent, kSeconds, {1.1, 1.4, -60},
                   [&](double t) { return Opponent(opponent, staggering, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
