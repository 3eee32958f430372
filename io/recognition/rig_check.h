// Whether the joints of a mapped figure stand where a human's do. Inner part of
// io/recognition/recognise.h.
#pragma once

#include <string>

#include "io/recognition/rig_measure.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Notes what is odd about the figure and which joints are virtual, fills its facing, and brings the
// share of checks that it passed into `facts->confidence`, which holds the share of its joints
// found by name. `facts` has map, unit and up axis.
void CheckRig(const RigMeasure& figure, RigFacts* facts);

// Throws InputError, one line that begins with `file`, where an upper arm, forearm, thigh or shin
// has no length in most frames: such a figure can hold nobody.
void RefuseLimbsWithoutLength(const RigMeasure& figure, const std::string& file);

}  // namespace retarget::io
