#include "model/body/mirror.h"

namespace retarget {

std::string OtherSide(const std::string& name) {
  if (name.starts_with("left_")) return "right_" + name.substr(5);
  if (name.starts_with("right_")) return "left_" + name.substr(6);
  return name;
}

Vec3 Reflected(const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); }
Quat Reflected(const Quat& q) { return Quat(q.w(), q.x(), -q.y(), -q.z()); }

std::vector<Quat> ReflectedRotations(const Body& body, const Pose& pose) {
  std::vector<Quat> rotation = pose.rotation;
  for (int l = 0; l < body.num_links(); ++l) {
    rotation[l] = Reflected(pose.rotation[body.FindLink(OtherSide(body.links[l].name))]);
  }
  return rotation;
}

}  // namespace retarget
