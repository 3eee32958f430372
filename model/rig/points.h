// Where the joints of a human stand in a rig, those included that the rig has no bone for: they are
// put at tabulated places in the frame of the bone that carries them. All in file units.
#pragma once

#include <vector>

#include "model/rig/rig.h"

namespace retarget {

// A joint, or a place in its frame.
struct RigPoint {
  int joint = -1;              // -1: the rig does not say
  Vec3 offset = Vec3::Zero();  // in the joint's frame

  bool known() const { return joint >= 0; }
  // The joint itself, not a place beside it.
  bool is_joint() const { return known() && offset.isZero(0); }
};

struct RigPoints {
  RigPoint root, chest, neck, head;
  RigPoint head_top;  // may be unknown, as hands and toes
  struct Side {
    RigPoint clavicle;  // the neck where there is no such bone
    RigPoint shoulder, elbow, wrist, hand;
    RigPoint hip, knee, ankle, toe;
  };
  Side left, right;
};

inline Vec3 At(const PosedRig& pose, const RigPoint& point) {
  return pose.position[point.joint] + pose.rotation[point.joint] * point.offset;
}

// Poses evenly over the motion, first and last frame included: what lengths and places are measured
// in. At least one frame.
std::vector<PosedRig> SamplePoses(const RigMotion& motion);

// Distance of two known points: the median over the poses, since position channels may stretch
// bones.
double MedianDistance(const std::vector<PosedRig>& poses, const RigPoint& a, const RigPoint& b);

// The stature that the limbs speak of: the mean of what each bone would be a share of (Drillis and
// Contini 1966). For places and tolerances, not for the body.
double ReferenceStature(const std::vector<PosedRig>& poses, const JointMap& map);

// `map` has at least root, shoulders, elbows, hips and knees. `chest_bone`: the spine bone that
// stands at the chest node, -1 where none does.
RigPoints FindPoints(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map,
                     int chest_bone);

// The spine bone that stands at the chest node: the last one that lies apart from both the neck and
// the root. -1 where none does.
int FindChestBone(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map);

// The lowest spine bone that still lies apart from the neck, which carries a chest without a bone;
// the root where there is none.
int ChestCarrier(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map);

}  // namespace retarget
