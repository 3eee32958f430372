// Calibration poses at the start of a clip. Inner part of io/recognition/recognise.h.
#pragma once

#include <vector>

#include "io/recognition/option_words.h"
#include "model/rig/points.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Frames from the first one on. A clip that is nothing but a T-pose has no calibration to skip,
// unless it is a single frame, which the caller will want to know. Resampling tools blend the
// T-pose into the motion: a rough one counts if the figure leaves it in a leap.
std::vector<int> TPoseFrames(const RigMotion& motion, const RigPoints& points, const Vec3& up);

// Says where the motion begins: after the T-pose and the few hasty frames that a resampling tool
// made to lead away from it, those included in which its filter overshoots and swings back.
// `facts` has the frames of the T-pose.
void NoteTPose(const RigMotion& motion, const RigPoints& points, const OptionWords& words,
               RigFacts* facts);

}  // namespace retarget::io
