// The trunk between the limbs of a figure. Inner part of io/recognition/joint_profiles.h.
#pragma once

#include <functional>
#include <vector>

#include "io/recognition/joint_words.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Fills root, spine and neck of `map`, which has shoulders, elbows, hips and knees and perhaps a
// head, from the chain between legs and head. The neck begins at the first bone above all arms that
// `named_necks` of a root holds, else at the first bone above all arms. False where arms and legs
// share no root. `neck_named` tells whether a bone of that list was taken.
bool ArrangeTrunk(const Rig& rig, const std::function<std::vector<int>(int)>& named_necks,
                  JointMap* map, bool* neck_named);

// The first joint of that word beyond the arms; -1 where there is none.
int HeadByWords(const Rig& rig, const std::vector<JointWords>& words, const JointMap& map);

// ArrangeTrunk with the necks that the words tell.
bool ArrangeByWords(const Rig& rig, const std::vector<JointWords>& words, JointMap* map);

}  // namespace retarget::io
