// Writes the two example clips of the bear hug, a.bvh (the attacker) and b.bvh (his opponent), each
// as if its actor had been captured alone, miming. Run: make_clips OUT_DIR. Deterministic.
//
// Nothing here is captured data: feet follow a plan of steps (gait.h), legs and arms are two-bone
// inverse kinematics (actor.h), and trunk, head and hands are driven by sums of sines of
// incommensurate frequencies, 0.3 to 1.6 Hz, that swell with the actor's effort. The two plans
// agree only roughly, as those of two actors would: each steps at his own times to his own spots.
#include <cmath>
#include <string>
#include <vector>

#include "data/actors/actor.h"
#include "data/actors/gait.h"
#include "data/actors/restless.h"
#include "data/actors/write_clip.h"

namespace retarget {
namespace {

constexpr double kSeconds = 10;

// --- What the actors do ---

Posture Standing(const Actor& actor, const Gait& gait, double t, double root_height) {
  Posture p;
  p.root = gait.Support(t, actor.ankle_behind_toe - 0.03, &p.yaw);
  p.root.y() = root_height;
  for (const FootSide foot : {kLeft, kRight}) p.feet[foot] = gait.Foot(foot, t);
  return p;
}

// The attacker: knees bent, both arms round a chest that is not there, hands about to clasp; he
// sways, heaves and tugs to break his opponent's footing.
Posture Attacker(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, seed); };
  const double tug = Bursts(t, 0.9, {0.75, 2.35, 3.35, 5.15, 6.85, 8.1, 9.4});
  const double effort = 0.75 + 0.45 * Bursts(t, 2.4, {2.1, 5.3, 7.4});
  Posture p = Standing(actor, gait, t, 0.922);
  p.root += Vec3(0.018 * r(1), 0.014 * r(2) + 0.016 * tug, 0.016 * r(3)) * effort;
  p.yaw += 1.5 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(3 + 2 * r(5) - 3 * tug, 0, 2 * r(6) * effort);
  p.spine_deg = Vec3(6 + 5 * r(7) * effort - 8 * tug, 10 * r(8) * effort, 6 * r(9) * effort);
  p.head_deg = Vec3(4 + 6 * r(10) + 5 * tug, 16 + 15 * r(11), 5 * r(12));  // cheek to a back

  const Vec3 clasp =
      Vec3(0.025 * r(13), 0.01 + 0.03 * r(14) + 0.03 * tug, 0.455 + 0.022 * r(15) - 0.055 * tug) +
      Vec3(0.012, 0.014, 0.010) * Restless(t, 16, 0.8, 1.6) * effort;
  // Left hand above and behind the right; the gap changes, as there is nothing to hold.
  const Vec3 half_gap = Vec3(0.024, 0.042, -0.014) * (1 + 0.18 * r(17));
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 30;
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 4 + 4 * r(seed) + 4 * tug;
    arm.protraction_deg = 12 + 4 * r(seed + 1) - 5 * tug;
    const Vec3 knuckles = clasp + x * half_gap;
    arm.knuckles = Vec3(x * knuckles.x(), knuckles.y(), knuckles.z()) +
                   0.006 * Vec3(r(seed + 2), r(seed + 3), r(seed + 4));
    arm.pointing = Vec3(-0.85, -0.05 + 0.15 * r(seed + 5), 0.45 + 0.12 * r(seed + 6));
    arm.palm = Vec3(-0.3, -0.25, -0.9);
    arm.elbow = Vec3(0.87, -0.5 + 0.16 * r(seed + 7), 0.05);
    arm.curl_deg = 45 + 10 * r(seed + 8);
  }
  return p;
}

// The opponent: upright, held round the chest. He twists, drops his weight, shrugs, looks round,
// and works his forearms outside the arms that hold him: elbows out, nothing in front of his chest.
Posture Opponent(const Actor& actor, const Gait& gait, double t) {
  const auto r = [t](int seed) { return Restless(t, 100 + seed); };
  const double effort = 0.75 + 0.5 * Bursts(t, 2.0, {1.9, 4.9, 7.0, 9.0});
  const double drop = Bursts(t, 1.3, {1.75, 3.5, 5.05, 6.9, 8.35});
  Posture p = Standing(actor, gait, t, 0.938);
  p.root += Vec3(0.018 * r(1), 0.010 * r(2), 0.016 * r(3)) * effort - Vec3(0, 0.045 * drop, 0);
  p.yaw += 1.5 * kDegree * r(4) * effort;
  p.pelvis_deg = Vec3(1 + 2 * r(5) + 3 * drop, 0, 2.5 * r(6) * effort);
  p.spine_deg = Vec3(2 + 4 * r(7) * effort + 5 * drop, 16 * r(8) * effort, 8 * r(9) * effort);
  p.head_deg = Vec3(5 * r(10) * effort - 2 * drop, 26 * r(11), 6 * r(12) * effort);
  for (const double x : {1.0, -1.0}) {
    const int seed = x > 0 ? 20 : 40;
    const auto quick = [&](int k) { return Restless(t, 100 + seed + k, 0.6, 1.6) * effort; };
    ArmPosture& arm = p.arms[x > 0 ? kLeft : kRight];
    arm.shrug_deg = 5 + 6 * r(seed) * effort + 5 * drop;
    arm.protraction_deg = 3 + 6 * r(seed + 1);
    arm.pointing = Vec3(0.1 + 0.2 * r(seed + 2), -0.6 + 0.25 * quick(3), 0.7);
    arm.knuckles = Vec3(0.39, -0.22, 0.275) + Vec3(0.025 * r(seed + 4), 0.06 * r(seed + 5), 0) +
                   Vec3(0.02 * quick(6), 0.055 * quick(7), 0.055 * quick(8));
    arm.palm = Vec3(-0.8, -0.5, 0.1 + 0.3 * r(seed + 9));
    arm.elbow = Vec3(0.85, -0.65 + 0.1 * r(seed + 10), -0.26);
    arm.curl_deg = 60 + 15 * r(seed + 11);
  }
  return p;
}

// Pulled forward, turned to the left, shoved to the left, dragged back, turned to the right.
std::vector<Step> OpponentSteps() {
  return {{kRight, 0.98, 0.44, {0.00, 0.35, 2}},
          {kLeft, 1.45, 0.42, {0.00, 0.36, 4}},
          {kLeft, 2.45, 0.40, {0.03, 0.37, 18}},
          {kRight, 2.95, 0.40, {0.03, 0.37, 18}},
          {kLeft, 4.00, 0.44, {0.27, 0.36, 14}},
          {kRight, 4.52, 0.46, {0.28, 0.36, 12}},
          {kRight, 5.72, 0.44, {0.26, 0.07, 2}, 0.06, 14},
          {kLeft, 6.24, 0.42, {0.26, 0.06, 0}, 0.06, 14},
          {kRight, 7.20, 0.42, {0.23, 0.08, -18}},
          {kLeft, 7.72, 0.42, {0.22, 0.09, -18}},
          {kLeft, 8.62, 0.38, {0.16, 0.15, -10}},
          {kRight, 9.08, 0.40, {0.14, 0.16, -8}}};
}

// The same walk a pace behind, in his own frame; he leads only where he drags the other back.
std::vector<Step> AttackerSteps() {
  return {{kRight, 1.05, 0.46, {0.01, 0.33, 1}},
          {kLeft, 1.56, 0.42, {0.00, 0.35, 3}},
          {kLeft, 2.55, 0.42, {-0.06, 0.37, 17}},
          {kRight, 3.06, 0.42, {-0.06, 0.38, 19}},
          {kLeft, 4.10, 0.46, {0.19, 0.38, 15}},
          {kRight, 4.63, 0.44, {0.21, 0.36, 11}},
          {kRight, 5.62, 0.46, {0.25, 0.08, 3}, 0.06, 14},
          {kLeft, 6.16, 0.44, {0.26, 0.05, 1}, 0.06, 14},
          {kRight, 7.30, 0.44, {0.31, 0.09, -17}},
          {kLeft, 7.83, 0.42, {0.31, 0.10, -18}},
          {kLeft, 8.72, 0.40, {0.21, 0.15, -11}},
          {kRight, 9.20, 0.40, {0.18, 0.16, -8}}};
}

// --- The clips ---

bool WriteClips(const std::string& folder) {
  // Stature, then ratios to the average: trunk, shoulders, arms, legs; then ankle and toe height.
  const Actor attacker = MakeActor({1.82, 1.01, 1.03, 1.01, 0.99, 0.076, 0.032});
  const Actor opponent = MakeActor({1.72, 0.99, 0.98, 1.00, 1.01, 0.072, 0.030});
  const Gait stalking({0.20, 0.06, 8}, AttackerSteps());
  const Gait stumbling({0.14, 0.02, 6}, OpponentSteps());
  return WriteClip(folder + "/a.bvh", attacker, kSeconds, {0, 0, 0},
                   [&](double t) { return Attacker(attacker, stalking, t); }) &&
         WriteClip(folder + "/b.bvh", opponent, kSeconds, {1.5, 0.8, 40},
                   [&](double t) { return Opponent(opponent, stumbling, t); });
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::RunGenerator(argc, argv, retarget::WriteClips); }
