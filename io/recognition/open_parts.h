// Parts of the body that a first look at a rig has left open. Inner part of
// io/recognition/joint_profiles.h.
#pragma once

#include <string>
#include <vector>

#include "io/recognition/joint_words.h"
#include "model/rig/points.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Fills parts that a map leaves open (collar bones, wrists, ankles, toes, hands, head): by words,
// else by the only place in the tree that can be meant, if the lengths allow it. Returns what was
// filled by place, "left_wrist ('left_hand')".
std::vector<std::string> FillOpenParts(const Rig& rig, const std::vector<JointWords>& words,
                                       const std::vector<PosedRig>& poses, JointMap* map);

}  // namespace retarget::io
