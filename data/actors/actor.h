// The actors of the example clips: their rigs, the postures they take, and the joint rotations that
// a posture takes. Lengths in m.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "data/actors/gait.h"
#include "model/body/body.h"
#include "model/body/joint_limit.h"
#include "model/geometry/so3.h"
#include "model/geometry/types.h"

namespace retarget {

// --- The rig: zero pose is a T-pose that faces +Z, left is +X; offsets in m ---

struct Joint {
  std::string name;
  int parent;
  Vec3 offset;
  Vec3 end_site = Vec3::Zero();  // of a leaf
};

// How an actor differs from the average of his stature (ratios; the average is Drillis and Contini
// 1966, see AverageMeasures), and the heights of ankle and toe joint of a planted foot (m).
struct Build {
  double stature, trunk, shoulders, arms, legs;
  double ankle_height, toe_height;
};

inline BodyMeasures MeasuresOf(const Build& build) {
  const auto shaped = [&](double stature) {
    BodyMeasures m = AverageMeasures(stature);
    m.chest_neck *= build.trunk;
    m.root_chest *= build.trunk;
    for (BodyMeasures::Side* side : {&m.left, &m.right}) {
      side->clavicle.y() *= build.trunk;
      side->clavicle_shoulder *= build.shoulders;
      side->shoulder_elbow *= build.arms;
      side->elbow_wrist *= build.arms;
      side->hip_knee *= build.legs;
      side->knee_ankle *= build.legs;
    }
    return m;
  };
  return shaped(build.stature * build.stature / StatureOf(shaped(build.stature)));
}

struct Actor {
  std::vector<Joint> joints;  // parents first, in the order of the file
  double toe_height, ankle_over_toe, ankle_behind_toe;

  int Find(const std::string& name) const {
    for (size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].name == name) return static_cast<int>(j);
    }
    return -1;
  }
  double Length(const std::string& name) const { return joints[Find(name)].offset.norm(); }
  void Add(const std::string& name, const std::string& parent, const Vec3& offset,
           const Vec3& end_site = Vec3::Zero()) {
    joints.push_back({name, Find(parent), offset, end_site});
  }
};

inline void AddArm(double x, const std::string& side, const BodyMeasures::Side& m, Actor* actor) {
  actor->Add(side + "Shoulder", "Spine2", m.clavicle);
  actor->Add(side + "Arm", side + "Shoulder", Vec3(x * m.clavicle_shoulder, 0, 0));
  actor->Add(side + "ForeArm", side + "Arm", Vec3(x * m.shoulder_elbow, 0, 0));
  actor->Add(side + "Hand", side + "ForeArm", Vec3(x * m.elbow_wrist, 0, 0));
  const Vec3 palm(x * m.wrist_hand, 0, 0);
  actor->Add(side + "HandMiddle1", side + "Hand", palm, 0.9 * palm);
}

inline void AddLeg(const std::string& side, const BodyMeasures::Side& m, Actor* actor) {
  actor->Add(side + "UpLeg", "Hips", m.hip);
  actor->Add(side + "Leg", side + "UpLeg", Vec3(0, -m.hip_knee, 0));
  actor->Add(side + "Foot", side + "Leg", Vec3(0, -m.knee_ankle, 0));
  actor->Add(side + "ToeBase", side + "Foot",
             Vec3(0, -actor->ankle_over_toe, actor->ankle_behind_toe), Vec3(0, 0, 0.065));
}

inline Actor MakeActor(const Build& build) {
  const BodyMeasures m = MeasuresOf(build);
  Actor actor;
  actor.toe_height = build.toe_height;
  actor.ankle_over_toe = build.ankle_height - build.toe_height;
  actor.ankle_behind_toe =
      std::sqrt(m.left.ankle_toe * m.left.ankle_toe - actor.ankle_over_toe * actor.ankle_over_toe);
  const auto up = [](double y) { return Vec3(0, y, 0); };
  actor.Add("Hips", "", Vec3::Zero());
  actor.Add("Spine", "Hips", up(0.36 * m.root_chest));
  actor.Add("Spine1", "Spine", up(0.32 * m.root_chest));
  actor.Add("Spine2", "Spine1", up(0.32 * m.root_chest));
  actor.Add("Neck", "Spine2", up(m.chest_neck));
  actor.Add("Head", "Neck", up(m.neck_head));
  actor.Add("HeadTop_End", "Head", up(m.head_top));
  AddArm(1, "Left", m.left, &actor);
  AddArm(-1, "Right", m.right, &actor);
  AddLeg("Left", m.left, &actor);
  AddLeg("Right", m.right, &actor);
  return actor;
}

// --- A posture: what the actor does at an instant, and the joint rotations that it takes ---

// In the frame of the chest joint; the right arm's x is mirrored, so that out is +x for both.
struct ArmPosture {
  double shrug_deg, protraction_deg;  // of the shoulder girdle
  Vec3 knuckles;                      // base of the middle finger (m)
  Vec3 pointing;                      // from the wrist to the knuckles
  Vec3 palm;                          // out of the palm
  Vec3 elbow;                         // where the elbow goes
  double curl_deg;                    // of the fingers
};

struct Posture {
  Vec3 root;        // over the floor (m)
  double yaw;       // rad
  Vec3 pelvis_deg;  // rotation vectors: x forwards, y to the left, z leaning to the right
  Vec3 spine_deg;   // shared by the three spine joints
  Vec3 head_deg;    // shared by neck and head
  std::array<FootPose, 2> feet;
  std::array<ArmPosture, 2> arms;
};

// World rotation of every joint that turns; the others go with their parents.
using Rotations = std::map<std::string, Quat>;

inline Quat ExpDegrees(const Vec3& v) { return ExpSo3(v * kDegree); }

inline Vec3 PositionOf(const Actor& actor, const std::string& name, const Vec3& root,
                       const Rotations& world) {
  Vec3 p = root;
  for (int j = actor.Find(name); j > 0; j = actor.joints[j].parent) {
    p += world.at(actor.joints[actor.joints[j].parent].name) * actor.joints[j].offset;
  }
  return p;
}

// The rotation that takes the orthonormal pair (u, v) to u_world and, as near as that allows,
// v_world.
inline Quat Aim(const Vec3& u, const Vec3& v, const Vec3& u_world, const Vec3& v_world) {
  const auto frame = [](const Vec3& a, const Vec3& b) {
    Mat3 m;
    m.col(0) = a.normalized();
    m.col(1) = (b - m.col(0) * m.col(0).dot(b)).normalized();
    m.col(2) = m.col(0).cross(m.col(1));
    return m;
  };
  return Quat(frame(u_world, v_world) * frame(u, v).transpose());
}

// Middle joint of a two-bone chain from `from` to `to`, bent towards `pole`.
inline Vec3 MiddleJoint(const Vec3& from, const Vec3& to, double upper, double lower,
                        const Vec3& pole) {
  const double reach = (to - from).norm();
  const Vec3 along = (to - from) / reach;
  const double foot = (reach * reach + upper * upper - lower * lower) / (2 * reach);
  const double height = std::sqrt(std::max(upper * upper - foot * foot, 0.0));
  return from + foot * along + height * (pole - along * along.dot(pole)).normalized();
}

// Shortens `v` so that a limb of `length` never stretches out, where its middle joint would snap:
// above 85 % of the length by a hyperbolic tangent, which joins on with continuous curvature.
inline Vec3 WithinReach(const Vec3& v, double length) {
  const double free = 0.85 * length, rest = 0.12 * length, wanted = v.norm();
  if (wanted <= free) return v;
  return v * ((free + rest * std::tanh((wanted - free) / rest)) / wanted);
}

// A hinge chain: both bones (direction `bone` in the rest pose) turn about the plane's normal,
// which is `hinge` in the rest pose, so that elbows and knees are pure hinges.
inline void AimHinge(const Vec3& bone, const Vec3& hinge, const Vec3& upper, const Vec3& lower,
                     Quat* upper_world, Quat* lower_world) {
  const Vec3 normal = upper.cross(lower);
  *upper_world = Aim(bone, hinge, upper, normal);
  *lower_world = Aim(bone, hinge, lower, normal);
}

inline void PoseLeg(const Actor& actor, const std::string& side, const Vec3& root,
                    const FootPose& foot, Rotations* world) {
  const Quat flat = YawRotation(foot.yaw);
  const Quat sole = flat * ExpSo3(Vec3(foot.pitch, 0, 0));
  const Vec3 ankle = foot.toe + Vec3(0, actor.toe_height, 0) +
                     sole * Vec3(0, actor.ankle_over_toe, -actor.ankle_behind_toe);
  const Vec3 hip = PositionOf(actor, side + "UpLeg", root, *world);
  const Vec3 ahead = world->at("Hips") * Vec3::UnitZ() + flat * Vec3(0, 0, 1.5);
  const Vec3 knee =
      MiddleJoint(hip, ankle, actor.Length(side + "Leg"), actor.Length(side + "Foot"), ahead);
  AimHinge(-Vec3::UnitY(), Vec3::UnitX(), knee - hip, ankle - knee, &(*world)[side + "UpLeg"],
           &(*world)[side + "Leg"]);
  (*world)[side + "Foot"] = sole;
  (*world)[side + "ToeBase"] = flat;  // toes stay on the floor under a rising heel
}

// A bend of the wrist that stays this far (rad) within its range: who holds somebody for long does
// not hold him at the end of it.
inline constexpr double kWristSpare = 15 * kDegree;
inline Quat WithinWrist(const std::string& joint, const Quat& bent) {
  const JointLimit limit = StandardLimit(joint);
  double beyond = -kPi;
  for (const LimitExcess& e : LimitExcesses(limit, bent, Quat::Identity(), limit.axis)) {
    beyond = std::max(beyond, e.beyond);
  }
  const Vec3 turn = LogSo3(bent);
  const double most = turn.norm() - beyond - kWristSpare;  // in this direction
  return turn.norm() <= most ? bent : ExpSo3(most / turn.norm() * turn);
}

inline void PoseArm(const Actor& actor, double x, const std::string& side, const Vec3& root,
                    const ArmPosture& arm, Rotations* world) {
  const Quat chest = world->at("Spine2");
  const auto to_world = [&](const Vec3& v) { return chest * Vec3(x * v.x(), v.y(), v.z()); };
  const Vec3 bone(x, 0, 0), hinge(0, -x, 0);
  (*world)[side + "Shoulder"] =
      chest * ExpDegrees(Vec3(0, -x * arm.protraction_deg, x * arm.shrug_deg));
  const Vec3 shoulder = PositionOf(actor, side + "Arm", root, *world);
  const double upper = actor.Length(side + "ForeArm"), lower = actor.Length(side + "Hand");
  Quat forearm,
      hand = Aim(bone, -Vec3::UnitY(), to_world(arm.pointing.normalized()), to_world(arm.palm));
  // A wrist that would bend too far gives way, and the arm brings the knuckles to their place.
  for (int k = 0; k < 12; ++k) {
    const Vec3 wanted = PositionOf(actor, "Spine2", root, *world) + to_world(arm.knuckles) -
                        actor.Length(side + "HandMiddle1") * (hand * bone);
    const Vec3 wrist = shoulder + WithinReach(wanted - shoulder, upper + lower);
    const Vec3 elbow = MiddleJoint(shoulder, wrist, upper, lower, to_world(arm.elbow));
    AimHinge(bone, hinge, elbow - shoulder, wrist - elbow, &(*world)[side + "Arm"], &forearm);
    // The forearm, not the wrist, turns the palm.
    forearm = forearm * TwistAbout(forearm.conjugate() * hand, bone);
    const Quat within =
        WithinWrist(x > 0 ? "left_wrist" : "right_wrist", forearm.conjugate() * hand);
    if (within.angularDistance(forearm.conjugate() * hand) < 1e-9) break;
    hand = forearm * within;
  }
  (*world)[side + "ForeArm"] = forearm;
  (*world)[side + "Hand"] = hand;
  (*world)[side + "HandMiddle1"] = hand * ExpDegrees(Vec3(0, 0, -x * arm.curl_deg));
}

inline Rotations PoseActor(const Actor& actor, const Posture& posture) {
  Rotations world;
  world["Hips"] = YawRotation(posture.yaw) * ExpDegrees(posture.pelvis_deg);
  world["Spine"] = world["Hips"] * ExpDegrees(posture.spine_deg / 3);
  world["Spine1"] = world["Spine"] * ExpDegrees(posture.spine_deg / 3);
  world["Spine2"] = world["Spine1"] * ExpDegrees(posture.spine_deg / 3);
  world["Neck"] = world["Spine2"] * ExpDegrees(0.5 * posture.head_deg);
  world["Head"] = world["Neck"] * ExpDegrees(0.5 * posture.head_deg);
  for (const FootSide side : {kLeft, kRight}) {
    const std::string name = side == kLeft ? "Left" : "Right";
    PoseLeg(actor, name, posture.root, posture.feet[side], &world);
    PoseArm(actor, side == kLeft ? 1 : -1, name, posture.root, posture.arms[side], &world);
  }
  return world;
}

// An actor at an instant: where his root is in his own frame (m), and how all joints are turned.
struct Figure {
  Vec3 root = Vec3::Zero();
  Rotations world;
};

inline Figure FigureOf(const Actor& actor, const Posture& posture) {
  return {posture.root, PoseActor(actor, posture)};
}

// The same as a file tells it: every joint in its parent, in the order of the rig; the root in the
// actor's own frame.
struct LocalFigure {
  Vec3 root;
  std::vector<Quat> turns;
};

// A joint that the figure does not name goes with its parent.
inline LocalFigure LocalOf(const Actor& actor, const Figure& figure) {
  LocalFigure local{figure.root, {figure.world.at("Hips")}};
  Rotations world = figure.world;
  for (size_t j = 1; j < actor.joints.size(); ++j) {  // parents first, so they are in `world`
    const Quat parent = world.at(actor.joints[actor.joints[j].parent].name);
    const Quat own = world.try_emplace(actor.joints[j].name, parent).first->second;
    local.turns.push_back(parent.conjugate() * own);
  }
  return local;
}

inline LocalFigure LocalOf(const Actor& actor, const Posture& posture) {
  return LocalOf(actor, FigureOf(actor, posture));
}

}  // namespace retarget
