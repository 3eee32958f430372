// Rotations as turns about coordinate axes, as motion files spell them.
#pragma once

#include <array>
#include <span>

#include "model/geometry/types.h"

namespace retarget {

// The turn by `angle` (rad) about axis 0, 1 or 2.
Quat AxisTurn(int axis, double angle);

// Three different axes: those of `axes` in their order (repeated ones once), then the others.
std::array<int, 3> CompleteAxes(std::span<const int> axes);

// Angles (rad) with r = R_i(a) R_j(b) R_k(c), (i, j, k) = `axes`: of all such triples the nearest
// to `previous`, so that curves have no jumps of half or whole turns. At a gimbal lock the first
// angle stays as it was.
Vec3 EulerAngles(const Mat3& r, const std::array<int, 3>& axes, const Vec3& previous);

}  // namespace retarget
