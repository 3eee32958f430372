// Writes the two clips of the Argentine backbreaker, a.bvh (the attacker, upright under a load that
// is not there) and b.bvh (his opponent, who lies face up, arched over a block), each as if its
// actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// The attacker settles the weight, walks, turns to the left to show his man round, and bounces him;
// the opponent kicks, arches, reaches for the head in front of him, and hangs limp in between.
// Nothing is captured data: see actor.h.
#include "data/actors/performance.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

// A bounce: the knees give, the legs drive up, the load comes down again.
double Bounce(double t) {
  double y = 0;
  for (const double at : {0.85, 5.30, 5.95, 8.55, 9.20}) {
    y += -Bump((t - at) / 0.44 + 0.5) + 0.7 * Bump((t - at - 0.30) / 0.46 + 0.5);
  }
  return y;
}
double Kick(double t) { return Bursts(t, 1.7, {1.9, 4.6, 7.7}) + 0.5 * Bursts(t, 1.0, {6.3, 9.4}); }
double Arch(double t) { return Bursts(t, 1.2, {2.2, 4.9, 7.4, 9.2}); }

Figure Attacker(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 600 + seed); };
  const double bounce = Bounce(t), kick = Kick(t - 0.1);  // he braces against the kicks
  const double effort = 0.6 + 0.5 * kick;
  Posture p = OnFeet(actor, gait, t, 0.945 + 0.045 * bounce, 0.02);
  p.root += Vec3(0.016 * r(1), 0.006 * r(2), 0.012 * r(3)) * effort;
  p.yaw += 2 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(2 - 3 * bounce + 1.5 * r(5), 0, 2 * r(6) * effort);
  p.spine_deg = Vec3(16 - 4 * bounce + 2.5 * r(7) * effort, 4 * r(8) * effort, 4 * r(9) * effort);
  p.head_deg = Vec3(12 + 4 * r(10) - 3 * bounce, 14 * r(11), 3 * r(12));
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 40;
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 16.5 + 3 * r(seed) * effort + 3 * bounce;
    arm.protraction_deg = 4 + 3 * r(seed + 1);
    // The left arm reaches over a thigh, the right over a neck.
    const Vec3 knuckles = x > 0 ? Vec3(0.355, 0.285, -0.30) : Vec3(0.37, 0.215, -0.355);
    arm.knuckles = knuckles + Vec3(0.014 * r(seed + 2), 0.016 * r(seed + 3) + 0.012 * bounce,
                                   0.016 * r(seed + 4)) *
                                  effort;
    arm.pointing = Vec3(-0.38, -0.9, 0.05 + 0.1 * r(seed + 5));
    arm.palm = Vec3(-0.85, 0.32, -0.4);
    arm.elbow = Vec3(0.55, 0.82, 0.14 + 0.1 * r(seed + 6));
    arm.curl_deg = 55 + 8 * r(seed + 7);
  }
  return FigureOf(actor, p);
}

// Face up, the head to his own -Z; the block is as high as a hip.
Figure Opponent(const Actor& actor, double t) {
  const auto r = [t](int seed) { return Restless(t, 700 + seed); };
  const double kick = Kick(t), arch = Arch(t), effort = 0.35 + 0.8 * kick;
  const double jolt = Bounce(t - 0.06);  // he is shaken, a little later
  const double breath = std::sin(2 * kPi * 0.5 * t);
  Posture p{};
  p.root = Vec3(0.008 * r(1), 1.0 + 0.006 * r(2) * effort + 0.010 * jolt, 0.012 * r(3) * effort);
  p.pelvis_deg = Vec3(-82 - 4 * arch + 3 * r(4) * effort, 0, 0);
  p.spine_deg = Vec3(-40 - 7 * arch + 3 * r(5) * effort + 2 * breath + 4 * jolt,
                     -7 + 7 * r(6) * effort, 4 * r(7) * effort);
  p.head_deg = Vec3(-8 + 10 * r(8) * effort - 5 * arch + 6 * jolt, 12 * r(9) * effort, 6 * r(10));
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 40;
    const auto quick = [&](int k) { return Restless(t, 700 + seed + k, 0.6, 1.7) * effort; };
    // Right: claws upwards, at the head before him; left: hangs, flung about by the kicks.
    const double reach = x > 0 ? 0 : Bursts(t, 1.6, {2.9, 6.6, 8.3});
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = (x > 0 ? -3 : 6) + 4 * r(seed) * effort;
    arm.protraction_deg = (x > 0 ? 0 : -9) + 4 * r(seed + 1) + 8 * reach;
    arm.knuckles = (x > 0 ? Vec3(0.36, 0.54, -0.24) : Vec3(0.46, 0.16, 0.25)) +
                   Vec3(0.04 * quick(2), 0.05 * quick(3), 0.05 * quick(4)) +
                   reach * Vec3(-0.03, -0.03, 0.12);
    arm.pointing = x > 0 ? Vec3(0.16, 0.71, -0.69) : Vec3(0.36, -0.85, 0.3 + 0.2 * quick(5));
    arm.palm = x > 0 ? Vec3(0.59, 0.49, 0.64) : Vec3(0.36, -0.16, -0.92);
    arm.elbow = x > 0 ? Vec3(0.76, -0.44, -0.49) : Vec3(0.68, 0.64, -0.36);
    arm.curl_deg = 35 + 20 * reach + 10 * r(seed + 6);
  }
  Figure figure = FigureOf(actor, p);
  // The legs pedal out of step; the right thigh is held, so it is mostly the shank that kicks.
  const auto pedal = [&](double phase) {
    return std::sin(2 * kPi * (1.15 * t + phase) + 0.5 * r(60)) * kick;
  };
  const double left = pedal(0), right = pedal(0.45);
  PoseFreeLeg(actor, kLeft,
              {Vec3(0.17 + 0.02 * r(61), -0.65 + 0.13 * left, -0.20 - 0.20 * left + 0.02 * r(62)),
               Vec3(0.31, -0.17, 0.93), Vec3(0.2, -0.88 + 0.2 * left, -0.43)},
              &figure);
  PoseFreeLeg(actor, kRight,
              {Vec3(0.035, -0.62 - 0.08 * right, -0.47 + 0.16 * right + 0.02 * r(63)),
               Vec3(0.2, -0.59, 0.78), Vec3(0.03, -0.7, -0.7 + 0.2 * right)},
              &figure);
  return figure;
}

// Wide and slow under the load: forward, round to the left, a step back to catch the balance.
const std::vector<Step> kSteps = {{kLeft, 1.50, 0.46, {0.00, 0.18, 4}, 0.05, 14},
                                  {kRight, 2.12, 0.46, {0.02, 0.32, 10}, 0.05, 14},
                                  {kLeft, 2.76, 0.46, {0.04, 0.36, 34}, 0.05, 12},
                                  {kRight, 3.36, 0.48, {0.05, 0.36, 58}, 0.05, 12},
                                  {kLeft, 3.98, 0.46, {0.05, 0.36, 80}, 0.05, 12},
                                  {kRight, 4.56, 0.40, {0.05, 0.36, 88}, 0.05, 12},
                                  {kRight, 6.70, 0.44, {-0.10, 0.35, 90}, 0.05, 10},
                                  {kLeft, 7.28, 0.44, {-0.16, 0.35, 86}, 0.05, 10},
                                  {kRight, 7.84, 0.36, {-0.15, 0.37, 82}, 0.05, 10}};

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor attacker = MakeActor({1.92, 1.02, 1.05, 1.01, 0.99, 0.079, 0.034});
  const Actor opponent = MakeActor({1.68, 0.99, 0.98, 1.00, 1.00, 0.070, 0.030});
  const Gait plodding({0.28, 0.09, 14}, kSteps);
  return WriteClip(folder + "/a.bvh", attacker, kSeconds, {0.2, 0.5, -35},
                   [&](double t) { return Attacker(attacker, plodding, t); }) &&
         WriteClip(folder + "/b.bvh", opponent, kSeconds, {-0.9, 1.1, 50},
                   [&](double t) { return Opponent(opponent, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
