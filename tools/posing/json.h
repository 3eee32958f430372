// Operations as JSON of the studio's page: {"op": "drag", "figure": "a", "node": "left_hand", ...}
// (docs/studio.md).
#pragma once

#include "io/text/document.h"
#include "tools/posing/operations.h"
#include "tools/report/report.h"

namespace retarget::posing {

// By its name, or that of its option ("hold" for "add_hold"). Throws InputError:
// `ops[0].node: unknown name "left_hnad", did you mean "left_hand"?`.
PoseStep ParsePoseJson(const io::Value& op, const TemplatePosture& posture);

// What reads back to it. Indices must be valid; not of SetPosture.
report::Json PoseJson(const Operation& operation, const TemplatePosture& posture);

}  // namespace retarget::posing
