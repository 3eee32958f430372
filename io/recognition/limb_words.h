// Limbs told by the words of their joints' names and, where these leave a gap, by the tree. Inner
// part of io/recognition/joint_profiles.h.
#pragma once

#include <string>
#include <vector>

#include "io/recognition/joint_profiles.h"
#include "io/recognition/joint_words.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Reads each limb as the chain of joints whose words fit its parts best, in order from the trunk
// outwards: "shoulder" is the collar bone before an "arm", the upper arm before an "elbow". What
// the words leave open stands between what they tell, where it parts the limb most evenly, or in
// the place that it has on the other side. The profile is "words".
NameMatch MatchWords(const Rig& rig, const std::vector<JointWords>& words,
                     const std::vector<PosedRig>& poses);

}  // namespace retarget::io
