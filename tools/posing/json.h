// Operations as JSON of the studio's page: {"op": "drag", "figure": "a", "node": "left_hand", ...}
// (docs/studio.md).
#pragma once

#include "io/text/message.h"
#include "model/body/template_posture.h"
#include "tools/posing/operations.h"

namespace retarget::posing {

// Throws InputError: `ops[0].node: unknown name "left_hnad", did you mean "left_hand"?`.
PoseStep ParsePoseJson(const io::Fields& op, const TemplatePosture& posture);

}  // namespace retarget::posing
