// What a posture says, as JSON of the studio. Numbers are rounded to 1e-6 (m, degrees): to what is
// seen, and a message is half as long so.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/body/template_posture.h"
#include "tools/posing/operations.h"
#include "tools/report/report.h"

namespace retarget::posing {

report::Json VectorJson(const Vec3& v);
report::Json QuatJson(const Quat& q);     // [x, y, z, w]
report::Json DegreesJson(const Quat& q);  // the rotation vector
report::Json RayJson(const PinRay& ray);
report::Json NodesJson(const Body& body, const std::vector<int>& nodes);  // their names
// A place in the world is an offset from its origin.
report::Json HoldPointJson(int figure, int node, const std::optional<Vec3>& offset,
                           const std::array<Body, 2>& body);
report::Json TanglesJson(const std::vector<TangleRequest>& tangles,
                         const std::array<Body, 2>& body);
// Null where there is none.
report::Json PhotoJson(const std::optional<TemplatePhoto>& photo);
report::Json CameraJson(const std::optional<TemplateCamera>& camera);

}  // namespace retarget::posing
