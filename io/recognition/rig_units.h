// The unit and the up axis of a motion file. Inner part of io/recognition/recognise.h.
#pragma once

#include <string>

#include "io/recognition/recognise.h"
#include "io/recognition/rig_measure.h"
#include "model/rig/rig.h"

namespace retarget::io {

// Fills unit, its name and stature of `facts`, whose figure is `height` file units tall: the unit
// of the options, else the listed one that makes the stature an adult's, else a child's, as near as
// can be to the stature of the options or to the usual one; where none does so, the unit that makes
// it the stature of the options. Notes what is odd; throws InputError, one line that begins with
// `file`, where no unit makes a human.
void FindUnit(double height, const RecogniseOptions& options, const std::string& file,
              RigFacts* facts);

// Fills the up axis: of the options, else the one of y and z along which the figure stands; where
// it lies, the one along which its offsets draw it.
// Notes what is odd; throws InputError on options that are no axis.
void FindUp(const RigMeasure& figure, const RecogniseOptions& options, const std::string& file,
            RigFacts* facts);

Vec3 UpAxis(const RigFacts& facts);

}  // namespace retarget::io
