// Lays the body into a rig: which body the rig's owner has, which posture a rig frame shows, and
// how a changed posture goes back onto the rig.
//
// Binding is by bone directions. In a reference frame (the rest pose if it stands, else the clip's
// frame that stands best) every link is turned from its parent by the smallest rotation that brings
// its canonical bone direction onto the rig's; that fixes a constant turn between bone and link. In
// every other frame the link follows its bone. Equal link rotations are then equal postures on any
// rig, whatever its axes and zero pose.
//
// A link that the rig has no bone for stands at a tabulated place on the bone above and is locked
// (Link::locked). So it is with a spine of one bone: the body bends where the rig's trunk bends, at
// the chest if the bone stands there, else at the waist, and the other of the two is locked. Were
// the bone's turn shared among them, the solved neck could not be reached by the rig.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/rig/fit.h"
#include "model/rig/points.h"
#include "model/rig/rig.h"

namespace retarget {

// Difference in the chest's distance that is not worth bending a rig's spine for (m).
inline constexpr double kSpineSlack = 0.0015;

class RigBinding {
 public:
  // `chest_bone` is the rig joint at the chest node (io/recognition/recognise.h), -1 where none
  // stands there. With `stature` (m, 0: the rig's own) the motion is shown on a body of that
  // height, everything scaled alike. Throws InputError where a part that the body needs is missing.
  RigBinding(const RigMotion& motion, const RigFacts& facts, int chest_bone, double stature);

  const Body& body() const { return body_; }
  // Requested stature over the rig's own; 1 where none was asked for.
  double stature_ratio() const { return ratio_; }

  // The posture of a rig frame, in metres and Y up, where the file has it.
  Pose PoseOf(const RigFrame& frame) const;

  // `captured` with the posture `solved` in place of its own. Every bone is turned by what its link
  // was turned, G_solved G_captured^-1; bones without a link keep their local motion.
  RigFrame Apply(const RigFrame& captured, const Pose& solved) const;

  // The whole rig of a frame turned and moved (world axes, m), bones that do not hang from the root
  // with it: p -> turn p + shift. Where the root has no such bones beside it, it alone is moved.
  RigFrame Placed(const RigFrame& frame, const Quat& turn, const Vec3& shift) const;

  // The same as Apply with the mapped joints where the body's nodes are (model/rig/fit.h), as near
  // as the rig allows: what is to be written. The body is rigid and bends in fewer places; a rig
  // may turn helper bones, stretch, and bend a spine of many bones.
  RigFrame Fitted(const RigFrame& captured, const Pose& solved) const;

  // The turns that the rig's joints cannot make from a frame, by links that one bone alone follows:
  // a joint with one or two axes, as in Acclaim files, stays within them.
  std::vector<LockedAxis> LockedAxesOf(const RigFrame& frame) const;

  // World position (m, Y up) of every rig joint in a frame, for checks.
  std::vector<Vec3> JointPositions(const RigFrame& frame) const;

  // The rig joint that stands at a node of the body, -1 where there is none.
  int JointAtNode(int node) const { return joint_at_node_[static_cast<size_t>(node)]; }

 private:
  // How a link reads the rig: it follows `bone` and points from `from` to `to`.
  struct LinkBinding {
    int bone = -1;
    RigPoint from, to;
    Vec3 direction = Vec3::UnitY();  // canonical, in the link
    Quat turn = Quat::Identity();    // link = bone * turn
  };
  // A leaf bone on the axis of `bone`, between it and `child`, that takes a share of the child's
  // turn about that axis. Helpers may hang from one another; parents come first.
  struct TwistHelper {
    int joint = -1, bone = -1, child = -1;
    Vec3 axis = Vec3::UnitY();  // unit, in bone's frame
    double share = 0;           // of the turn, beyond its parent's
  };
  // A rig frame in the world: metres, Y up.
  struct World {
    std::vector<Quat> rotation;
    std::vector<Vec3> position;
  };

  void FindFreedom();
  RigFrame TurnBones(const RigFrame& captured, const Pose& solved) const;
  bool IsOthers(int top) const;
  void Follow(const RigFrame& captured, RigFrame* out) const;
  RigFrame Bend(const RigFrame& captured, const Pose& solved) const;
  // The joint that moves the root, where the file moves the root or one above it.
  int Mover() const;
  void MapLinks();
  void MapTrunk();
  void MapSide(const JointMap::Side& side, const RigPoints::Side& points, double x);
  // The link from one joint to the next, and the bone that it drives.
  void MapLimb(int link, int joint, const RigPoint& from, const RigPoint& to,
               const Vec3& direction);
  void FindTwistHelpers(const PosedRig& pose);
  void TurnTwistHelpers(const RigFrame& captured, RigFrame* out) const;
  Vec3 PointIn(const World& world, const RigPoint& point) const;
  World ToWorld(const RigFrame& frame) const;
  bool Direction(const World& world, const LinkBinding& link, Vec3* direction,
                 double* length) const;
  void BindTurns(const World& reference);
  World ReferenceFrame(const RigMotion& motion) const;
  Vec3 LeftOf(const World& world) const;
  double StandingScore(const World& world) const;
  BodyMeasures Measure(const std::vector<World>& frames) const;
  std::vector<Quat> LinkRotations(const World& world) const;
  void EstimateHinges(const std::vector<World>& frames);
  void LimitWaist(const std::vector<World>& frames);
  void SpreadOverSpine(const World& captured, const std::vector<Quat>& edit,
                       const Vec3& root_position, std::vector<Quat>* rotation) const;

  Rig rig_;
  JointMap map_;
  RigPoints points_;
  int chest_bone_ = -1;
  Quat up_ = Quat::Identity();  // file axes to world axes
  double scale_ = 0.01;         // metres per file unit, of the body as requested
  double ratio_ = 1;
  Body body_;
  std::vector<LinkBinding> link_;  // by link of the standard body
  std::vector<int> link_of_bone_;  // by rig joint; -1: keeps its local motion
  std::vector<int> spine_group_;   // bones between root and chest
  std::vector<int> joint_at_node_;
  std::vector<char> locked_;  // by link
  RigFreedom freedom_;        // what a fit may change
  // Of the joints at nodes, those that do not hang from the joint before them in the body, such as
  // feet beside the hips: they are moved to where they belong. By node.
  std::vector<char> detached_;
  std::vector<RigFollower> followers_;
  bool has_loose_joints_ = false;  // that neither hang from the root nor carry it
  std::vector<TwistHelper> twist_helpers_;
};

}  // namespace retarget
