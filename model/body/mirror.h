// Left and right exchanged, as a mirror at x = 0 shows a body.
#pragma once

#include <string>
#include <vector>

#include "model/body/pose.h"

namespace retarget {

// "left_wrist" for "right_wrist" and the other way round; a name without a side stays.
std::string OtherSide(const std::string& name);

// A rotation R becomes D R D, D = diag(-1, 1, 1).
Vec3 Reflected(const Vec3& v);
Quat Reflected(const Quat& q);

// Every joint turns in the mirror as its counterpart does; the root as itself.
std::vector<Quat> ReflectedRotations(const Body& body, const Pose& pose);

}  // namespace retarget
