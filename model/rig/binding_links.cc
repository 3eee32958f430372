// Which bones each link of the body reads and drives.
#include "model/rig/binding.h"
#include "model/rig/standard_links.h"
#include "model/rig/tree.h"

namespace retarget {
namespace {

void Require(int joint, const char* part) {
  if (joint < 0) throw InputError(std::string("the rig has no ") + part);
}

}  // namespace

void RigBinding::MapLimb(int link, int joint, const RigPoint& from, const RigPoint& to,
                         const Vec3& direction) {
  locked_[link] = joint < 0;
  link_[link].from = from;
  link_[link].to = to;
  link_[link].direction = direction;
  // Roll bones in the chain carry the twist: the last of them is the one to read.
  const bool chain = joint >= 0 && to.is_joint() && DescendsFrom(rig_, to.joint, joint);
  link_[link].bone = joint < 0                    ? from.joint
                     : chain && to.joint != joint ? rig_.joints[to.joint].parent
                                                  : joint;
  if (joint >= 0) link_of_bone_[joint] = link;
}

// Root, spine, neck and head. The spine bones below the chest turn with the waist, those above with
// the chest.
void RigBinding::MapTrunk() {
  const RigPoints& p = points_;
  const Vec3 up = Vec3::UnitY();
  const int pelvis = CommonAncestor(rig_, map_.left.hip, map_.right.hip);
  link_[kRoot].bone = pelvis > map_.root ? pelvis : map_.root;
  link_[kRoot].from = p.root;
  link_of_bone_[map_.root] = kRoot;

  bool past_chest = chest_bone_ < 0 && p.chest.joint == map_.root;
  for (const int bone : map_.spine) {
    past_chest = past_chest || bone == chest_bone_;
    if (!past_chest) spine_group_.push_back(bone);
    link_of_bone_[bone] = past_chest ? kChest : kWaist;
    past_chest = past_chest || (chest_bone_ < 0 && bone == p.chest.joint);
  }
  MapLimb(kWaist, -1, p.root, p.chest, up);
  if (!spine_group_.empty()) link_[kWaist].bone = spine_group_[spine_group_.size() / 2];
  locked_[kWaist] = spine_group_.empty();
  MapLimb(kChest, -1, p.chest, p.neck, up);
  link_[kChest].bone = map_.spine.empty() ? map_.root : map_.spine.back();
  locked_[kChest] = chest_bone_ < 0;
  const bool neck = p.neck.is_joint();
  MapLimb(kNeck, neck ? p.neck.joint : -1, p.neck, p.head, up);
  if (neck) link_[kNeck].bone = p.neck.joint;
  for (const int bone : map_.neck) link_of_bone_[bone] = kNeck;
  MapLimb(kHead, map_.head, p.head, p.head_top, up);
  if (map_.head >= 0) link_[kHead].bone = map_.head;
}

void RigBinding::MapSide(const JointMap::Side& side, const RigPoints::Side& p, double x) {
  const Vec3 out(x, 0, 0), down(0, -1, 0);
  const int arm = x > 0 ? kLeftClavicle : kRightClavicle;
  MapLimb(arm, side.clavicle, p.clavicle, p.shoulder, out);
  if (side.clavicle < 0) link_[arm].bone = link_[kChest].bone;
  MapLimb(arm + 1, side.shoulder, p.shoulder, p.elbow, out);
  MapLimb(arm + 2, side.elbow, p.elbow, p.wrist, out);
  MapLimb(arm + 3, side.wrist, p.wrist, p.hand, out);
  const int leg = x > 0 ? kLeftHip : kRightHip;
  MapLimb(leg, side.hip, p.hip, p.knee, down);
  MapLimb(leg + 1, side.knee, p.knee, p.ankle, down);
  MapLimb(leg + 2, side.ankle, p.ankle, p.toe, Vec3(0, 0, 1));
  for (const int end : {arm + 3, leg + 2}) {  // the child of a hand or foot may be any finger
    const int joint = end == arm + 3 ? side.wrist : side.ankle;
    if (joint >= 0) link_[end].bone = joint;
  }
}

void RigBinding::MapLinks() {
  Require(map_.root, "root");
  for (const JointMap::Side* side : {&map_.left, &map_.right}) {
    for (const auto& [joint, part] : {std::pair{side->shoulder, "shoulder"},
                                      {side->elbow, "elbow"},
                                      {side->hip, "hip"},
                                      {side->knee, "knee"}}) {
      Require(joint, part);
    }
  }
  link_.resize(kNumLinks);
  locked_.assign(kNumLinks, 0);
  link_of_bone_.assign(rig_.joints.size(), -1);
  MapTrunk();
  MapSide(map_.left, points_.left, 1);
  MapSide(map_.right, points_.right, -1);
}

}  // namespace retarget
