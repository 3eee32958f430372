// Limits of a joint's rotation, per direction.
#pragma once

#include <string>
#include <vector>

#include "model/geometry/types.h"

namespace retarget {

// Limits of a joint rotation R (child in parent). `axis` is the direction of the link's bone in the
// rest pose. A *swing* takes the bone from where it points in the middle of the range, c = middle
// axis, along the shortest way to where it points, R axis; the *twist* is what is left,
// R middle^-1 = swing * twist about c.
//  - Twist within [twist_min, twist_max] rad.
//  - Swing, as a rotation vector perpendicular to c with components u along `swing_axis` and v
//  along
//    c x swing_axis, within the ellipse whose quarters have the half axes swing_min, swing_max (of
//    u < 0, u > 0) and side_min, side_max (of v).
//  - A hinge (`hinge_axis`, in the parent, not zero) bends only between bend_min and bend_max rad
//    about that axis and leaves the plane of bending by hinge_play rad at most.
//  - The bone no further than `reach` rad from `reach_centre`: what a rig allows, where it has no
//    joint at the body's joint centre.
struct JointLimit {
  Vec3 axis = Vec3::UnitY();
  Quat middle = Quat::Identity();
  double twist_min = -kPi, twist_max = kPi;
  Vec3 swing_axis = Vec3::UnitX();  // unit, in the parent, perpendicular to c
  double swing_min = -kPi, swing_max = kPi;
  double side_min = -kPi, side_max = kPi;
  // A wrist: the swing is told in the hand's own frame (R = twist * swing; middle is the identity),
  // since the turn of the forearm, which some rigs leave to the hand, does not turn the axes of the
  // wrist; and the twists of forearm and wrist together stay within [with_parent_min,
  // with_parent_max] rad.
  bool turns_with_parent = false;
  double with_parent_min = -kPi, with_parent_max = kPi;
  Vec3 hinge_axis = Vec3::Zero();
  double bend_min = -kPi, bend_max = kPi;
  double hinge_play = kPi;
  Vec3 reach_centre = Vec3::UnitY();
  double reach = kPi;

  bool is_hinge() const { return hinge_axis.squaredNorm() > 0; }
  bool has_swing() const;  // the ellipse bounds something
};

// Limits of the standard body's joint ("left_wrist") from published ranges of motion; those of the
// right side are mirrored; none for a joint that the standard body does not have. Sources and
// figures: joint_ranges.cc.
JointLimit StandardLimit(const std::string& joint);

// How far a rotation lies beyond one of its limits (rad; negative: within), and the derivative by a
// turn R -> R exp(w); by_parent is that by the same turn of the parent joint, of rotations that
// share a limit with it.
struct LimitExcess {
  double beyond;
  Vec3 gradient;
  Vec3 by_parent = Vec3::Zero();
};
// Always the same limits in the same order for one `limit`. `parent` and `parent_axis` are the
// rotation and the bone of the parent joint, read where limit.turns_with_parent.
std::vector<LimitExcess> LimitExcesses(const JointLimit& limit, const Quat& rotation,
                                       const Quat& parent, const Vec3& parent_axis);

struct Body;
struct Pose;
// Of the rotation of `link` in a pose; of a locked link too.
std::vector<LimitExcess> LimitExcesses(const Body& body, int link, const Pose& pose);
// The largest of them (rad).
double FurthestBeyondLimit(const Body& body, int link, const Pose& pose);

}  // namespace retarget
