// An operation as a few words, for a list of what can be undone.
#pragma once

#include <string>

#include "tools/posing/operations.h"

namespace retarget::posing {

// "drag of a/left_hand". Indices that are not valid are left out.
std::string LabelOf(const Operation& operation, const TemplatePosture& posture);

}  // namespace retarget::posing
