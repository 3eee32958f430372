// What the studio's page is told of a session, as JSON. Lengths in m, angles in degrees,
// quaternions [x, y, z, w]; schema in docs/studio.md.
#pragma once

#include <array>

#include "solver/optimizer/pose_solve.h"
#include "tools/posing/session.h"
#include "tools/report/report.h"

namespace retarget::studio {

// What does not change with the pose: {a: {stature, nodes, links}, b: ...}.
report::Json BodiesJson(const std::array<Body, 2>& body);

// Figures, pins, options and all that the template says; without the queries.
report::Json PostureStateJson(const posing::PoseSession& session);

// What the solver did: {drag_error_m, pin_error_m, blocked?, stalled, converged, iterations, ms}.
report::Json PoseResultJson(const solver::PoseResult& result, const TemplatePosture& posture);

}  // namespace retarget::studio
