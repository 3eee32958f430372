// Operations that need no solver, as a function from state to state.
#pragma once

#include "tools/posing/state.h"

namespace retarget::posing {

// The state after an operation; pins go with nodes that are moved by hand. Throws InputError where
// a figure, node, link, hold or value is not valid. Not for Drag, DragRay and Settle.
PoseState Edited(const PoseState& state, const Operation& operation);

// Throw InputError.
void CheckFigure(int figure);
void CheckNode(const TemplatePosture& posture, int figure, int node);
void CheckPlace(const Vec3& place, const char* what);
void CheckDirection(const Vec3& direction);

}  // namespace retarget::posing
