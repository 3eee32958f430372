// Writes the two clips of the octopus hold, a.bvh (the attacker, astride a block that stands for
// his man) and b.bvh (his opponent, bent forward under a weight that is not there), each as if its
// actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// The attacker wrenches the arm that he hugs, presses the neck down with his thigh and rides what
// comes; the opponent heaves to straighten up, staggers to the side, turns, staggers back, paws at
// the leg with his free hand, and sags in between. Nothing is captured data: see actor.h.
#include "data/actors/performance.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

double Heave(double t) { return Bursts(t, 1.3, {0.95, 3.35, 5.55}) + 0.7 * Bursts(t, 1.1, {8.3}); }
double Wrench(double t) { return Bursts(t, 1.2, {1.75, 4.25, 6.45, 9.1}); }
double Sag(double t) { return Plateau(t, 6.1, 7.0, 0.7) + Plateau(t, 8.8, 12.0, 1.0); }

// Upright astride a block; only what the legs clasp is fixed.
Figure Attacker(const Actor& actor, double t) {
  const auto r = [t](int seed) { return Restless(t, 800 + seed); };
  const double wrench = Wrench(t), heave = Heave(t - 0.12);
  const double effort = 0.5 + 0.5 * heave + 0.4 * wrench;
  Posture p{};
  p.root =
      Vec3(0.010 * r(1), 1.0 + 0.008 * r(2) * effort, 0.010 * r(3)) + Vec3(0, 0.012, 0) * heave;
  p.pelvis_deg = Vec3(-12 + 3 * heave - 3 * wrench + 2 * r(4) * effort, -14 + 2 * r(5),
                      -12 + 3 * r(6) * effort);
  p.spine_deg = Vec3(2 + 6 * heave - 10 * wrench + 3 * r(7) * effort,
                     12 + 8 * r(8) * effort - 8 * wrench, 4 * r(9) * effort);
  p.head_deg = Vec3(18 + 5 * r(10), -16 + 14 * r(11), 9 + 4 * r(12));
  const Vec3 tug = Vec3(0.012 * r(13), 0.016 * r(14), 0.012 * r(15)) * effort +
                   Vec3(0.02, 0.02, -0.015) * wrench;
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 30;
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 4 + 3 * r(seed) + 5 * wrench;
    arm.protraction_deg = 12 + 3 * r(seed + 1) - 5 * wrench;
    arm.knuckles = (x > 0 ? Vec3(0.125, -0.02, 0.305) : Vec3(-0.075, -0.055, 0.31)) +
                   Vec3(x * tug.x(), tug.y(), tug.z());
    arm.pointing = x > 0 ? Vec3(-0.72, -0.37, 0.59) : Vec3(-0.87, 0.45, -0.2);
    arm.palm = x > 0 ? Vec3(-0.6, -0.1, -0.79) : Vec3(0.25, 0.05, -0.97);
    arm.elbow = Vec3(0.85, -0.5 + 0.12 * r(seed + 2), 0.03);
    arm.curl_deg = 60 + 8 * r(seed + 3);
  }
  Figure figure = FigureOf(actor, p);
  // Left leg hooked backwards round a thigh, right leg over a neck.
  PoseFreeLeg(actor, kLeft,
              {Vec3(-0.19 + 0.012 * r(40), -0.71 + 0.012 * r(41), -0.15 + 0.015 * r(42)),
               Vec3(0.48, -0.31 + 0.08 * r(43), 0.82), Vec3(0.38, -0.1, -0.92)},
              &figure);
  PoseFreeLeg(actor, kRight,
              {Vec3(0.2 + 0.012 * r(44), -0.42 - 0.03 * wrench + 0.015 * r(45) * effort,
                    0.37 + 0.012 * r(46)),
               Vec3(0.24, 0.7 + 0.06 * r(47), 0.67), Vec3(-0.76, -0.23, -0.6 - 0.2 * wrench)},
              &figure);
  return figure;
}

Figure Opponent(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 900 + seed); };
  const double heave = Heave(t), wrench = Wrench(t - 0.12), sag = Sag(t);
  const double effort = 0.45 + 0.7 * heave;
  const double breath = std::sin(2 * kPi * 0.55 * t) * (1 - 0.5 * std::min(heave, 1.0));
  Posture p = OnFeet(actor, gait, t, 0.87 + 0.03 * heave - 0.035 * sag, -0.045);
  p.root += Vec3(0.018 * r(1), 0.007 * r(2), 0.012 * r(3)) * effort;
  p.yaw += 2.5 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(30 - 7 * heave + 4 * sag + 2 * r(5) * effort, 0, 2.5 * r(6) * effort);
  p.spine_deg = Vec3(32 - 10 * heave + 4 * sag + 3 * wrench + 3 * r(7) * effort - 1.5 * breath,
                     9 * r(8) * effort - 6 * wrench, 5 * r(9) * effort);
  p.head_deg = Vec3(21 + 5 * r(10) * effort - 4 * heave, 8 * r(11) * effort, 5 * r(12) * effort);

  ArmPosture& left = p.arms[kLeft];  // the arm that is not his own any more
  left.shrug_deg = 20 + 3 * r(20) * effort;
  left.protraction_deg = 3 * r(21);
  left.knuckles = Vec3(0.46, 0.46, -0.60) +
                  Vec3(0.02 * r(22), 0.025 * r(23), 0.025 * r(24)) * effort +
                  Vec3(0, 0.0, -0.02) * wrench;
  left.pointing = Vec3(0.35, 0.33, -0.88 + 0.15 * r(25));
  left.palm = Vec3(0.94, -0.12, 0.33);
  left.elbow = Vec3(0.29, -0.42, -0.86);
  left.curl_deg = 40 + 20 * heave + 10 * r(26);
  ArmPosture& right = p.arms[kRight];  // braced over the knee, then pawing at the leg on his neck
  const double paw = Bursts(t, 1.5, {2.45, 7.6}) + Bursts(t, 1.2, {4.9});
  const auto quick = [&](int k) { return Restless(t, 900 + k, 0.7, 1.7) * effort; };
  right.shrug_deg = 3 + 4 * r(30) * effort;
  right.protraction_deg = 6 + 5 * r(31);
  right.knuckles = Vec3(0.26, 0.10, 0.47) +
                   Vec3(0.03 * quick(32), 0.04 * quick(33), 0.04 * quick(34)) +
                   paw * Vec3(0.06, 0.12, -0.05);
  right.pointing = Vec3(-0.44 + 0.2 * quick(35), -0.22 + 0.6 * paw, 0.87);
  right.palm = Vec3(-0.57, -0.68, -0.46);
  right.elbow = Vec3(0.75, -0.65 + 0.12 * quick(36), -0.09);
  right.curl_deg = 45 + 15 * r(37);
  return FigureOf(actor, p);
}

// Pulled to the left, turned to the right, staggering backwards.
const std::vector<Step> kSteps = {{kLeft, 1.30, 0.40, {0.16, 0.04, 3}, 0.05, 12},
                                  {kRight, 1.84, 0.44, {0.20, 0.10, 6}, 0.05, 12},
                                  {kLeft, 2.52, 0.38, {0.24, 0.12, 8}, 0.05, 12},
                                  {kRight, 3.86, 0.42, {0.25, 0.12, -12}, 0.05, 12},
                                  {kLeft, 4.40, 0.44, {0.26, 0.14, -30}, 0.05, 12},
                                  {kRight, 4.98, 0.40, {0.27, 0.14, -38}, 0.05, 12},
                                  {kLeft, 6.56, 0.40, {0.36, 0.00, -38}, 0.05, 10},
                                  {kRight, 7.06, 0.42, {0.42, -0.08, -36}, 0.05, 10},
                                  {kLeft, 7.60, 0.38, {0.43, -0.09, -34}, 0.05, 10}};

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor attacker = MakeActor({1.72, 1.00, 1.00, 1.01, 1.01, 0.072, 0.031});
  const Actor opponent = MakeActor({1.88, 1.01, 1.03, 1.00, 1.00, 0.077, 0.033});
  const Gait staggering({0.335, 0.05, 16}, kSteps);
  return WriteClip(folder + "/a.bvh", attacker, kSeconds, {0.9, -0.4, 65},
                   [&](double t) { return Attacker(attacker, t); }) &&
         WriteClip(folder + "/b.bvh", opponent, kSeconds, {-0.5, 0.6, -20},
                   [&](double t) { return Opponent(opponent, staggering, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
