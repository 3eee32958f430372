// Ranges of motion of the standard body's joints.
//
// Figures (degrees), of which the comments below name the source:
//   B  Boone and Azen, "Normal range of motion of joints in male subjects", J. Bone Joint Surg. Am.
//      61, 1979: mean of 109 men, and here two standard deviations beyond it.
//   A  American Academy of Orthopaedic Surgeons, "Joint Motion: Method of Measuring and Recording",
//      1965.
//   K  Kapandji, "The Physiology of the Joints", vol. 1 to 3, 1974.
// Of the trunk and the neck the sources give the whole; the body has two joints for each, and a rig
// shares a turn among its joints as it likes: each may carry about two thirds of it.
#include <cmath>

#include "model/body/joint_limit.h"
#include "model/geometry/so3.h"

namespace retarget {
namespace {

struct Range {
  double least, most;  // degrees
};

// Up the trunk: forward bends are positive, sides equal.
JointLimit Spine(const Range& forward, double side, double twist) {
  JointLimit limit;
  limit.swing_min = forward.least * kDegree;
  limit.swing_max = forward.most * kDegree;
  limit.side_min = -side * kDegree;
  limit.side_max = side * kDegree;
  limit.twist_min = -twist * kDegree;
  limit.twist_max = twist * kDegree;
  return limit;
}

// A limb of the left side, in the terms of JointLimit; `middle` is where its bone points halfway.
JointLimit Limb(const Vec3& axis, const Vec3& middle, const Vec3& swing_axis, const Range& swing,
                const Range& side, const Range& twist) {
  JointLimit limit;
  limit.axis = axis;
  limit.middle = RotationBetween(axis, middle.normalized());
  const Vec3 c = limit.middle * axis;
  limit.swing_axis = (swing_axis - swing_axis.dot(c) * c).normalized();
  limit.swing_min = swing.least * kDegree, limit.swing_max = swing.most * kDegree;
  limit.side_min = side.least * kDegree, limit.side_max = side.most * kDegree;
  limit.twist_min = twist.least * kDegree, limit.twist_max = twist.most * kDegree;
  return limit;
}

JointLimit Hinge(const Vec3& axis, const Vec3& hinge, const Range& bend, double play,
                 const Range& twist) {
  JointLimit limit;
  limit.axis = axis;
  limit.hinge_axis = hinge;
  limit.bend_min = bend.least * kDegree, limit.bend_max = bend.most * kDegree;
  limit.hinge_play = play * kDegree;
  limit.twist_min = twist.least * kDegree, limit.twist_max = twist.most * kDegree;
  return limit;
}

// By reflection in the plane x = 0: directions are reflected; of axes of rotation the part along x
// stays and the others change their sign, and so does the twist about an axis that is reflected as
// a direction.
JointLimit Mirrored(const JointLimit& left) {
  const auto direction = [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); };
  const auto rotation = [](const Vec3& v) { return Vec3(v.x(), -v.y(), -v.z()); };
  JointLimit limit = left;
  limit.axis = direction(left.axis);
  const Quat& q = left.middle;
  limit.middle = Quat(q.w(), q.x(), -q.y(), -q.z());
  limit.twist_min = -left.twist_max, limit.twist_max = -left.twist_min;
  limit.with_parent_min = -left.with_parent_max, limit.with_parent_max = -left.with_parent_min;
  limit.swing_axis = rotation(left.swing_axis);
  // c x swing_axis is reflected as a direction, the rotation vector of a swing as an axis.
  limit.side_min = -left.side_max, limit.side_max = -left.side_min;
  limit.hinge_axis = rotation(left.hinge_axis);
  return limit;
}

JointLimit LeftLimit(const std::string& joint) {
  const Vec3 up = Vec3::UnitY(), down = -up, ahead = Vec3::UnitZ(), out = Vec3::UnitX();
  // K lumbar 60 forward, 35 back, 20 aside, 5 of twist; thoracic 45, 25, 20, 35. A: 45 of twist.
  if (joint == "waist") return Spine({-35, 60}, 25, 30);
  if (joint == "chest") return Spine({-30, 45}, 25, 35);
  // K cervical 40 forward, 75 back, 35 to 45 aside, 50 of twist; A 45, 45, 45, 60.
  if (joint == "neck" || joint == "head") return Spine({-50, 40}, 35, 50);
  // K 45 to 60 up with the shoulder blade, 10 to 20 down, 30 ahead and back, 30 to 50 of twist.
  if (joint == "clavicle") return Limb(out, out, -ahead, {-50, 20}, {-30, 30}, {-50, 50});
  // With the middle ahead, out and down, the extremes of B (flexion 167, extension 62 + 19,
  // abduction 184) and A (135 across the body) lie 85 to 118 degrees away; B outward turn 104 + 17,
  // inward 69 + 9, at the middle.
  if (joint == "shoulder") {
    return Limb(out, Vec3(0.6, -0.3, 0.6), down, {-118, 118}, {-118, 118}, {-121, 78});
  }
  // B bend 143 + 11, beyond straight 1 + 6; inward turn of the forearm 76 + 10, outward 82 + 8.
  if (joint == "elbow") return Hinge(out, down, {-7, 154}, 10, {-90, 86});
  // B flexion 76 + 13, extension 75 + 13, to the thumb 22 + 8, to the little finger 36 + 8. Its own
  // twist is give only.
  if (joint == "wrist") {
    JointLimit limit = Limb(out, out, -ahead, {-88, 89}, {-30, 44}, {-20, 20});
    limit.turns_with_parent = true;
    limit.with_parent_min = -90 * kDegree, limit.with_parent_max = 86 * kDegree;
    return limit;
  }
  // With the middle at 47 of flexion: B flexion 122 + 12, extension 10 + 14 (K to 30, with the
  // lumbar spine more); abduction 46 + 19, adduction 27 + 8, where it is largest; 47 + 13 of twist.
  if (joint == "hip") {
    const double middle = 47 * kDegree;
    return Limb(down, Vec3(0, -std::cos(middle), std::sin(middle)), -out, {-87, 87}, {-65, 40},
                {-60, 60});
  }
  // B bend 143 + 11 (K 160 where it is pushed); K 30 inward, 40 outward when bent.
  if (joint == "knee") return Hinge(down, out, {-8, 160}, 10, {-40, 40});
  // The foot stands about 25 down from the rest pose, in which it is straight ahead of the ankle
  // and not of the heel: B upward 13 + 9 (K to 30 under load), downward 56 + 12 from there; A 35
  // inward, 20 outward; K 30 of turn.
  if (joint == "ankle") {
    return Limb(ahead, Vec3(0, -0.42, 0.91), -out, {-65, 50}, {-40, 40}, {-40, 40});
  }
  return {};  // a joint of a larger table: no limit is known
}

}  // namespace

JointLimit StandardLimit(const std::string& joint) {
  if (joint.starts_with("left_")) return LeftLimit(joint.substr(5));
  if (joint.starts_with("right_")) return Mirrored(LeftLimit(joint.substr(6)));
  return LeftLimit(joint);
}

}  // namespace retarget
