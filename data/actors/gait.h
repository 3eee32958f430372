// Footwork of the example clips: a plan of steps, and where it puts feet and pelvis at any time.
//
// Everything is a sum of C2 functions of time, so feet and pelvis have continuous accelerations;
// between its steps a foot does not move at all. The plan lives in the actor's own frame: he starts
// at the origin and faces +Z, left is +X. Lengths in m, times in s.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "model/geometry/so3.h"
#include "model/geometry/types.h"

namespace retarget {

enum FootSide { kLeft = 0, kRight = 1 };

// From 0 at s = 0 to 1 at s = 1 with no speed or acceleration at either end, as people reach and
// step: T. Flash and N. Hogan, "The coordination of arm movements", 1985 (minimum jerk).
inline double MinimumJerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (-15 + 6 * s));
}

// From 0 to 1 at s = 1/2 and back to 0 at s = 1, as smooth at both ends.
inline double Bump(double s) {
  s = std::clamp(s, 0.0, 1.0);
  const double arch = 4 * s * (1 - s);
  return arch * arch * arch;
}

// Up, a plateau, and down: the two ramps begin at `on` and `off` and last `ramp` each.
inline double Plateau(double t, double on, double off, double ramp) {
  return MinimumJerk((t - on) / ramp) - MinimumJerk((t - off) / ramp);
}

// Where a body stands on the floor; each foot has its own spot under it (Stance).
struct Place {
  double x = 0, z = 0, yaw_deg = 0;
};

// `foot` is set down under the body's next place.
struct Step {
  FootSide foot;
  double start, duration;  // of the swing: the toes leave the floor and stand again
  Place to;
  double toe_clearance = 0.055;
  double heel_lift_deg = 20;  // the heel rises first, over the planted toes
};

struct Stance {
  double half_width;  // between the toes
  double left_ahead;  // the left foot stands this much ahead of the right
  double toe_out_deg;
};

struct FootPose {
  Vec3 toe;      // displacement of the toe joint over the floor; y = 0 while it is planted
  double yaw;    // rad
  double pitch;  // rad, heel up about the toe joint
};

class Gait {
 public:
  Gait(Stance stance, std::vector<Step> steps) : stance_(stance), steps_(std::move(steps)) {}

  FootPose Foot(FootSide foot, double t) const {
    Place at;
    FootPose pose{ToeUnder(at, foot), YawUnder(at, foot), 0};
    for (const Step& step : steps_) {
      if (step.foot != foot) continue;
      const double s = (t - step.start) / step.duration;
      pose.toe += MinimumJerk(s) * (ToeUnder(step.to, foot) - ToeUnder(at, foot));
      pose.toe.y() += step.toe_clearance * Bump(s);
      pose.yaw += MinimumJerk(s) * (YawUnder(step.to, foot) - YawUnder(at, foot));
      pose.pitch += step.heel_lift_deg * kDegree * HeelRise(step, t);
      at = step.to;
    }
    return pose;
  }

  // Point over which the pelvis hangs, `behind_toes` behind the toes (y = 0), and its yaw (rad).
  // Averaged over half a second, since a trunk is too heavy to follow every swing.
  Vec3 Support(double t, double behind_toes, double* yaw) const {
    constexpr int kSamples = 4;  // on each side
    constexpr double kReach = 0.24;
    Vec3 point = Vec3::Zero();
    double total = 0;
    *yaw = 0;
    for (int k = -kSamples; k <= kSamples; ++k) {
      const double u = static_cast<double>(k) / (kSamples + 1);
      const double weight = (1 - u * u) * (1 - u * u);
      const double left = LeftShare(t + kReach * u);
      for (const FootSide foot : {kLeft, kRight}) {
        const FootPose pose = Foot(foot, t + kReach * u);
        const double share = weight * (foot == kLeft ? left : 1 - left);
        const Vec3 heelwards = YawRotation(pose.yaw) * Vec3(0, 0, -behind_toes);
        point += share * (pose.toe + heelwards);
        *yaw += share * pose.yaw;
      }
      total += weight;
    }
    *yaw /= total;
    return Vec3(point.x() / total, 0, point.z() / total);
  }

 private:
  static constexpr double kHeelLead = 0.16;  // the heel lifts so long before the toes
  static constexpr double kShift = 0.36;     // time to shift the weight

  Vec3 ToeUnder(const Place& place, FootSide foot) const {
    const double side = foot == kLeft ? 1 : -1;
    const Vec3 spot(side * stance_.half_width, 0, side * stance_.left_ahead / 2);
    return Vec3(place.x, 0, place.z) + YawRotation(place.yaw_deg * kDegree) * spot;
  }
  double YawUnder(const Place& place, FootSide foot) const {
    return (place.yaw_deg + (foot == kLeft ? 1 : -1) * stance_.toe_out_deg) * kDegree;
  }
  // Highest a third into the swing, flat again as the toes land.
  static double HeelRise(const Step& step, double t) {
    const double top = step.start + 0.35 * step.duration, begin = step.start - kHeelLead;
    return MinimumJerk((t - begin) / (top - begin)) -
           MinimumJerk((t - top) / (step.start + step.duration - top));
  }
  // Share of the weight on the left foot: it leaves a foot before the foot leaves the floor.
  double LeftShare(double t) const {
    constexpr double kSwayed = 0.20;  // a quick step is caught before the weight is all across
    double share = 0.5;
    for (const Step& step : steps_) {
      const double end = step.start + step.duration;
      const double off = kSwayed * Plateau(t, step.start - kShift, end - 0.08, kShift);
      share += step.foot == kLeft ? -off : off;
    }
    return share;
  }

  Stance stance_;
  std::vector<Step> steps_;
};

}  // namespace retarget
