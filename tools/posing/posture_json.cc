#include "tools/posing/posture_json.h"

#include <cmath>

#include "io/template_keys.h"
#include "model/geometry/so3.h"

namespace retarget::posing {
namespace {

double Rounded(double x) { return std::round(1e6 * x) / 1e6 + 0.0; }  // + 0.0 makes -0 a 0

}  // namespace

report::Json VectorJson(const Vec3& v) { return {Rounded(v.x()), Rounded(v.y()), Rounded(v.z())}; }

report::Json QuatJson(const Quat& q) {
  return {Rounded(q.x()), Rounded(q.y()), Rounded(q.z()), Rounded(q.w())};
}

report::Json DegreesJson(const Quat& q) { return VectorJson(LogSo3(q) / kDegree); }

report::Json RayJson(const PinRay& ray) {
  return {{"origin", VectorJson(ray.origin)}, {"direction", VectorJson(ray.direction)}};
}

report::Json NodesJson(const Body& body, const std::vector<int>& nodes) {
  report::Json out = report::Json::array();
  for (const int n : nodes) out.push_back(body.nodes[n].name);
  return out;
}

report::Json HoldPointJson(int figure, int node, const std::optional<Vec3>& offset,
                           const std::array<Body, 2>& body) {
  report::Json out = {{"figure", io::FigureNames()[figure]}};
  if (figure != kWorld) out["node"] = body[figure].nodes[node].name;
  if (offset) out["offset"] = VectorJson(*offset);
  return out;
}

report::Json TanglesJson(const std::vector<TangleRequest>& tangles,
                         const std::array<Body, 2>& body) {
  report::Json out = report::Json::array();
  for (const TangleRequest& t : tangles) {
    report::Json entry = {{"a", NodesJson(body[0], {t.a.from, t.a.to})},
                          {"b", NodesJson(body[1], {t.b.from, t.b.to})}};
    out.push_back(entry);
  }
  return out;
}

report::Json PhotoJson(const std::optional<TemplatePhoto>& photo) {
  if (!photo) return nullptr;
  return {{"file", photo->file},
          {"opacity", photo->opacity},
          {"scale", photo->scale},
          {"offset", {photo->offset.x(), photo->offset.y()}}};
}

report::Json CameraJson(const std::optional<TemplateCamera>& camera) {
  if (!camera) return nullptr;
  return {{"eye", VectorJson(camera->eye)},
          {"target", VectorJson(camera->target)},
          {"fov_deg", camera->fov_deg}};
}

}  // namespace retarget::posing
