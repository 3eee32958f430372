// Bones that belong to the figure but hang from elsewhere: feet beside the hips, targets of inverse
// kinematics, what is carried. Inner part of io/recognition/recognise.h.
#pragma once

#include <string>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

// Gives `map` the ankles (and toes) that it lacks, where a bone is called a foot or an ankle of
// that side and stands at the end of the shin, whatever it hangs from. Returns their names.
std::vector<std::string> FindLooseFeet(const RigMotion& motion, JointMap* map);

// The bones that `map` does not use, that hang neither from its root nor above it nor from the bone
// that they go with, and that
//  - are called a target of a limb: ik_foot_l, LeftHandIK, PoleTarget.Knee.R, ctrl_foot.L; a pole
//    goes with the limb's upper bone, in whose plane it stands, others with the limb's end; or
//  - are called the hand or foot of a limb that has none, and keep their distance to its end; or
//  - stand at a joint throughout, or keep their place in the frame of a bone that moves.
// `metres_per_unit`: of the motion; the figure stands `stature` m tall.
std::vector<RigFollower> FindFollowers(const RigMotion& motion, const JointMap& map,
                                       double metres_per_unit, double stature);

}  // namespace retarget::io
