// A frame on bones that cannot hold all of it. Inner part of io/acclaim/acclaim.h.
#pragma once

#include <array>
#include <vector>

#include "io/acclaim/acclaim.h"

namespace retarget::io::acclaim {

// Number of a bone's turns, and their axes: the outermost (last) turn first, filled up to three.
int NumTurns(const AcclaimBone& bone);
std::array<int, 3> TurnAxes(const AcclaimBone& bone);

// The values of every bone for one frame.
struct BoneValues {
  std::vector<Vec3> angles;  // rad, in the order of TurnAxes; 0 for axes that do not turn
  std::vector<Vec3> shift;   // of all axes, of which a bone may have but some
};

// Values for `frame` on the skeleton of `file` with offsets scaled by `scale`; angles are those
// nearest to `previous`. Where all bones can hold their rotation, that is what they get. Where some
// cannot, all values together are those that bring the joints nearest to their places in the frame
// and, much less important, the bones to their orientations: a thigh rolls so that a knee that only
// bends still brings the foot where it should be.
BoneValues FitFrame(const AcclaimFile& file, const RigFrame& frame, double scale,
                    const BoneValues& previous);

}  // namespace retarget::io::acclaim
