// Walking of the example clips: footfalls along a curved path, and what feet, pelvis, trunk and
// arms do between them. Lengths in m, times in s; the walk lives in the actor's own frame as in
// gait.h: he stands at the origin and faces +Z, left is +X.
//
// Shares of time, and the turns of pelvis and trunk, follow J. B. Saunders, V. T. Inman and H. D.
// Eberhart, "The major determinants in normal and pathological gait", 1953 (pelvis turns 4 degrees
// with the leg that swings and drops 5 degrees on its side, the trunk's rise and fall is that of a
// leg over its foot), and D. A. Winter, "Biomechanics and Motor Control of Human Movement", 2009
// (heel strike with the toes about 15 to 20 degrees up, flat by an eighth of the stride, heel off
// before the other foot lands; the swing takes two fifths of the stride).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "data/actors/actor.h"
#include "data/actors/gait.h"
#include "model/geometry/types.h"

namespace retarget {

// Heading along the path: it turns by `turn_deg` between the distances `from` and `to`.
struct Bend {
  double from, to, turn_deg;
};

struct WalkPlan {
  double start;                  // when the first foot leaves the floor
  int steps;                     // the last one closes the feet
  FootSide first;                // foot that steps first
  std::array<double, 2> length;  // left, right: how far this foot lands ahead of the other
  std::array<double, 2> time;    // left, right: from the other foot's landing to this one's
  double half_width, toe_out_deg;
  std::vector<Bend> bends;
  double toe_clearance = 0.03, heel_lift_deg = 32, toe_lift_deg = 14;
  double heel_to_toe = 0.20;  // from the heel to the toe joint
};

// What the whole body does at an instant.
struct Stride {
  Vec3 point;        // on the floor, between the toes, where the trunk is on its way
  double yaw;        // rad, of the way
  double left_load;  // share of the weight on the left foot
  double reach;      // -1: the right foot is a step ahead; 1: the left
  double pace;       // 0 standing to 1 walking
};

class Walk {
 public:
  explicit Walk(const WalkPlan& plan) : plan_(plan) {
    double landed = plan.start - 0.25 * plan.time[plan.first], distance = 0;
    FootSide foot = plan.first;
    for (int k = 0; k < plan.steps; ++k) {
      const bool closing = k + 1 == plan.steps;
      distance += plan.length[foot] * (k == 0 ? 0.7 : closing ? 0.0 : 1.0);
      const double lift = landed + 0.25 * plan.time[foot];
      landed += plan.time[foot];
      falls_.push_back({foot, lift, landed, On(distance)});
      foot = foot == kLeft ? kRight : kLeft;
    }
  }

  double end() const { return falls_.back().land; }

  FootPose Foot(FootSide foot, double t) const {
    Place at;
    FootPose pose{ToeUnder(at, foot), YawUnder(at, foot), 0};
    double toe_up = 0;
    for (const Fall& fall : falls_) {
      if (fall.foot != foot) continue;
      const double swing = fall.land - fall.lift, s = (t - fall.lift) / swing;
      pose.toe += MinimumJerk(s) * (ToeUnder(fall.to, foot) - ToeUnder(at, foot));
      pose.toe.y() += plan_.toe_clearance * Bump(s);
      pose.yaw += MinimumJerk(s) * (YawUnder(fall.to, foot) - YawUnder(at, foot));
      pose.pitch += plan_.heel_lift_deg * kDegree * HeelRise(fall, t);
      toe_up += plan_.toe_lift_deg * kDegree * ToeRise(fall, t);
      at = fall.to;
    }
    // The toes are up about the heel, which is on the floor before and after the landing.
    pose.pitch -= toe_up;
    pose.toe.y() += plan_.heel_to_toe * std::sin(toe_up);
    return pose;
  }

  Stride At(double t, double behind_toes) const {
    Stride out{Vec3::Zero(), 0, 0, 0, 0};
    double total = 0;
    for (int k = -kSamples; k <= kSamples; ++k) {
      const double u = static_cast<double>(k) / (kSamples + 1), when = t + kWindow * u;
      const double weight = (1 - u * u) * (1 - u * u);
      const FootPose left = Foot(kLeft, when), right = Foot(kRight, when);
      const double yaw = 0.5 * (left.yaw + right.yaw);
      const Vec3 apart = YawRotation(-yaw) * (left.toe - right.toe);
      out.point +=
          weight * (0.5 * (left.toe + right.toe) + YawRotation(yaw) * Vec3(0, 0, -behind_toes));
      out.yaw += weight * yaw;
      out.left_load += weight * LeftLoad(when);
      out.reach += weight * apart.z();
      total += weight;
    }
    out.point = Vec3(out.point.x() / total, 0, out.point.z() / total);
    out.yaw /= total;
    out.left_load /= total;
    out.reach /= total * 0.5 * (plan_.length[kLeft] + plan_.length[kRight]);
    out.pace = Plateau(t, plan_.start - 0.3, end() - 0.7, 0.9);
    return out;
  }

 private:
  static constexpr int kSamples = 5;  // on each side
  static constexpr double kWindow = 0.30, kHeelLead = 0.20, kFlat = 0.13;

  struct Fall {
    FootSide foot;
    double lift, land;
    Place to;
  };

  // Where the path is after `distance`.
  Place On(double distance) const {
    constexpr double kStep = 0.01;
    Place at;
    for (double s = 0; s < distance; s += kStep) {
      const double step = std::min(kStep, distance - s);
      at.yaw_deg = 0;
      for (const Bend& bend : plan_.bends) {
        at.yaw_deg += bend.turn_deg * MinimumJerk((s - bend.from) / (bend.to - bend.from));
      }
      at.x += step * std::sin(at.yaw_deg * kDegree);
      at.z += step * std::cos(at.yaw_deg * kDegree);
    }
    return at;
  }
  Vec3 ToeUnder(const Place& place, FootSide foot) const {
    const double side = foot == kLeft ? 1 : -1;
    return Vec3(place.x, 0, place.z) +
           YawRotation(place.yaw_deg * kDegree) * Vec3(side * plan_.half_width, 0, 0);
  }
  double YawUnder(const Place& place, FootSide foot) const {
    return (place.yaw_deg + (foot == kLeft ? 1 : -1) * plan_.toe_out_deg) * kDegree;
  }
  // The heel rises over the planted toes, and comes down while the leg swings.
  static double HeelRise(const Fall& fall, double t) {
    const double top = fall.lift + 0.25 * (fall.land - fall.lift), begin = fall.lift - kHeelLead;
    return MinimumJerk((t - begin) / (top - begin)) - MinimumJerk((t - top) / (fall.land - top));
  }
  // The toes are up when the heel lands, and flat soon after.
  static double ToeRise(const Fall& fall, double t) {
    const double begin = fall.lift + 0.5 * (fall.land - fall.lift);
    return MinimumJerk((t - begin) / (fall.land - begin)) - MinimumJerk((t - fall.land) / kFlat);
  }
  // The weight leaves a foot before the foot leaves the floor.
  double LeftLoad(double t) const {
    constexpr double kShift = 0.30;
    double load = 0.5;
    for (const Fall& fall : falls_) {
      const double off = 0.5 * Plateau(t, fall.lift - kShift, fall.land - 0.1, kShift);
      load += fall.foot == kLeft ? -off : off;
    }
    return load;
  }

  WalkPlan plan_;
  std::vector<Fall> falls_;
};

// How the trunk goes with the feet: lengths in m, angles in degrees.
struct Manner {
  double height;           // of the root at mid-stance
  double dip = 0.022;      // lower than that with the feet apart
  double sway = 0.025;     // to the side of the foot that carries
  double pelvis_turn = 4;  // with the leg ahead
  double pelvis_drop = 4;  // on the side of the leg that swings
  double trunk_turn = 7;   // against the pelvis, with the arm ahead
};

inline void StrideInto(const Stride& stride, const Manner& manner, Posture* p) {
  const double side = 2 * stride.left_load - 1, apart = stride.reach * stride.reach;
  p->yaw = stride.yaw;
  p->root = stride.point + YawRotation(stride.yaw) * Vec3(manner.sway * side, 0, 0);
  p->root.y() = manner.height - manner.dip * apart;
  p->pelvis_deg += Vec3(0, -manner.pelvis_turn * stride.reach, manner.pelvis_drop * side);
  p->spine_deg += Vec3(0, (manner.pelvis_turn + manner.trunk_turn) * stride.reach,
                       -0.9 * manner.pelvis_drop * side);
}

}  // namespace retarget
