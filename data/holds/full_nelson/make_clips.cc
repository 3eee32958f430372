// Writes the two clips of the full nelson, a.bvh (the attacker) and b.bvh (his opponent), each as
// if its actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// The attacker walks his man forward, swings him round to the left, drags him back and presses his
// head down; the opponent is pushed along, gathers himself between his bursts, tries to bring his
// elbows down, twists and stamps. Both rest in between. Nothing is captured data: see actor.h.
#include "data/actors/performance.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

// Where the attacker drives, drags and presses: leans into it (1) or hauls backwards (-1).
double Drive(double t) { return Plateau(t, 1.0, 2.6, 0.6) - 1.1 * Plateau(t, 6.5, 8.0, 0.6); }
double Press(double t) { return Bursts(t, 1.3, {0.55, 3.6}) + 1.2 * Plateau(t, 8.4, 9.5, 0.6); }
// A man's strength comes in bursts; in between he only holds on and breathes.
double Struggle(double t) {
  return Bursts(t, 1.9, {1.15, 3.55, 7.4}) + 0.7 * Bursts(t, 1.2, {5.5});
}

Figure Attacker(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 200 + seed); };
  const double drive = Drive(t), press = Press(t);
  const double effort = 0.55 + 0.6 * Struggle(t - 0.12);  // he answers the other's bursts
  Posture p = OnFeet(actor, gait, t, 0.925 - 0.02 * std::abs(drive), 0.06 + 0.03 * drive);
  p.root += Vec3(0.014 * r(1), 0.010 * r(2) + 0.012 * press, 0.012 * r(3)) * effort;
  p.yaw += 2 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(-10 + 4 * drive + 2 * r(5), 0, 2.5 * r(6) * effort);
  p.spine_deg =
      Vec3(15 + 4 * drive + 7 * press + 4 * r(7) * effort, 9 * r(8) * effort, 5 * r(9) * effort);
  p.head_deg =
      Vec3(-6 - 3 * press + 5 * r(10), 14 + 12 * r(11), 5 * r(12));  // past the other's ear

  // The clasp behind the neck of a man who is not there.
  const Vec3 clasp(0.018 * r(13), 0.43 + 0.02 * r(14) - 0.02 * press,
                   0.20 + 0.014 * r(15) + 0.035 * press);
  const Vec3 half_gap = Vec3(0.034, 0.010, 0.0) * (1 + 0.15 * r(16));
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 40;
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 7 + 4 * r(seed) * effort + 3 * press;
    arm.protraction_deg = 5 + 4 * r(seed + 1) + 4 * press;
    const Vec3 knuckles = clasp + x * half_gap;
    arm.knuckles = Vec3(x * knuckles.x(), knuckles.y(), knuckles.z()) +
                   0.006 * effort * Vec3(r(seed + 2), r(seed + 3), r(seed + 4));
    arm.pointing = Vec3(-0.82, -0.44 + 0.1 * r(seed + 5), -0.36 + 0.1 * r(seed + 6));
    arm.palm = Vec3(-0.25, -0.3, 0.92);
    arm.elbow = Vec3(0.66, -0.2 + 0.12 * r(seed + 7), 0.74);
    arm.curl_deg = 50 + 8 * r(seed + 8);
  }
  return FigureOf(actor, p);
}

Figure Opponent(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 300 + seed); };
  const double struggle = Struggle(t), drive = Drive(t - 0.1), press = Press(t - 0.1);
  const double effort = 0.45 + 0.75 * struggle;
  const double elbows_down = Bursts(t, 1.0, {1.3, 3.8, 7.2, 8.05});
  const double breath = std::sin(2 * kPi * 0.55 * t) * (1 - 0.5 * std::min(struggle, 1.0));
  Posture p =
      OnFeet(actor, gait, t, 0.925 - 0.03 * elbows_down - 0.015 * press, 0.02 + 0.02 * drive);
  p.root += Vec3(0.016 * r(1), 0.008 * r(2), 0.012 * r(3)) * effort;
  p.yaw += 3 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(2 + 3 * drive + 2 * r(5) + 3 * elbows_down, 0, 3 * r(6) * effort);
  p.spine_deg = Vec3(3 + 3 * drive + 8 * press + 4 * r(7) * effort - 1.5 * breath,
                     12 * r(8) * effort, 7 * r(9) * effort);
  p.head_deg = Vec3(38 + 6 * press + 5 * r(10) * effort - 6 * elbows_down, 10 * r(11) * effort,
                    5 * r(12) * effort);
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 40;
    const auto quick = [&](int k) { return Restless(t, 300 + seed + k, 0.6, 1.7) * effort; };
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 20 - 6 * elbows_down + 3 * r(seed) * effort + 2 * breath;
    arm.protraction_deg = -20 + 4 * r(seed + 1);
    arm.knuckles = Vec3(0.39, 0.66, -0.10) + Vec3(0.02, -0.09, 0.10) * elbows_down +
                   Vec3(0.04 * quick(2), 0.06 * quick(3), 0.07 * quick(4)) +
                   Vec3(0.02 * r(seed + 5), -0.04 + 0.03 * r(seed + 6), 0.03 * r(seed + 7));
    arm.pointing = Vec3(0.05 + 0.2 * quick(8), 0.8, 0.58 + 0.2 * quick(9));
    arm.palm = Vec3(0.97, -0.2, 0.17);
    arm.elbow = Vec3(-0.1, -0.1, -0.99);
    arm.curl_deg = 40 + 25 * struggle + 10 * r(seed + 10);
  }
  return FigureOf(actor, p);
}

// Places are the pair's: driven forward, swung round to the left, dragged back and to the side.
const std::vector<Step> kAttackerSteps = {{kLeft, 1.22, 0.44, {0.00, 0.26, 2}},
                                          {kRight, 1.74, 0.44, {0.00, 0.38, 2}},
                                          {kLeft, 2.28, 0.42, {0.02, 0.40, 5}},
                                          {kRight, 4.30, 0.44, {0.03, 0.42, 24}},
                                          {kLeft, 4.84, 0.44, {0.04, 0.42, 40}},
                                          {kRight, 5.38, 0.40, {0.04, 0.42, 46}},
                                          {kRight, 6.62, 0.44, {-0.10, 0.28, 46}, 0.05, 12},
                                          {kLeft, 7.16, 0.46, {-0.18, 0.18, 44}, 0.05, 12},
                                          {kRight, 7.74, 0.42, {-0.19, 0.18, 41}, 0.05, 12}};
const std::vector<Step> kOpponentSteps = {{kRight, 1.15, 0.42, {0.00, 0.25, 1}},
                                          {kLeft, 1.64, 0.42, {0.01, 0.36, 3}},
                                          {kRight, 2.16, 0.42, {0.02, 0.40, 4}},
                                          {kRight, 3.42, 0.30, {0.02, 0.41, 3}, 0.10, 6},
                                          {kLeft, 4.20, 0.42, {0.03, 0.42, 22}},
                                          {kRight, 4.70, 0.44, {0.04, 0.42, 38}},
                                          {kLeft, 5.26, 0.40, {0.04, 0.43, 47}},
                                          {kLeft, 6.74, 0.42, {-0.09, 0.30, 45}, 0.05, 12},
                                          {kRight, 7.26, 0.44, {-0.18, 0.19, 43}, 0.05, 12},
                                          {kLeft, 7.82, 0.40, {-0.19, 0.18, 42}, 0.05, 12}};

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor attacker = MakeActor({1.88, 1.01, 1.04, 1.02, 0.99, 0.077, 0.033});
  const Actor opponent = MakeActor({1.70, 1.00, 0.98, 0.99, 1.00, 0.071, 0.030});
  const Gait driving = GaitInPair({0.225, 0.12, 9}, {0, -0.13}, kAttackerSteps);
  const Gait stumbling = GaitInPair({0.135, 0.04, 8}, {0, 0.13}, kOpponentSteps);
  return WriteClip(folder + "/a.bvh", attacker, kSeconds, {0.4, -0.7, -25},
                   [&](double t) { return Attacker(attacker, driving, t); }) &&
         WriteClip(folder + "/b.bvh", opponent, kSeconds, {-1.2, 0.9, 70},
                   [&](double t) { return Opponent(opponent, stumbling, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
