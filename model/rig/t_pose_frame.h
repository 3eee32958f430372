// A T-pose on a rig, for tools that take a clip's first frame for its rest pose.
#pragma once

#include "model/rig/binding.h"

namespace retarget {

// The T-pose of the binding's body on `rig`, in file units and axes of a figure of that body: it
// stands on the floor under `place` (metres, Y up) and looks along the world's +Z. Bones without a
// link are as the rig has them at rest.
RigFrame TPoseFrame(const Rig& rig, const RigBinding& binding, const Vec3& place);

}  // namespace retarget
