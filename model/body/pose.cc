#include "model/body/pose.h"

#include <cassert>

namespace retarget {

Pose RestPose(const Body& body) {
  Pose pose;
  pose.rotation.assign(body.links.size(), Quat::Identity());
  return pose;
}

void PoseBody(const Body& body, const Pose& pose, PosedBody* out) {
  const size_t num_links = body.links.size();
  assert(pose.rotation.size() == num_links);
  out->rotation.resize(num_links);
  out->centre.resize(num_links);
  out->node.resize(body.nodes.size());
  out->rotation[0] = pose.rotation[0].toRotationMatrix();
  out->centre[0] = pose.root_position;
  for (size_t l = 1; l < num_links; ++l) {
    const Link& link = body.links[l];
    const Mat3& parent = out->rotation[link.parent];
    out->rotation[l].noalias() = parent * pose.rotation[l].toRotationMatrix();
    out->centre[l] = out->centre[link.parent] + parent * link.centre;
  }
  for (size_t n = 0; n < body.nodes.size(); ++n) {
    const Node& node = body.nodes[n];
    out->node[n] = out->centre[node.link] + out->rotation[node.link] * node.offset;
  }
}

PosedBody PoseBody(const Body& body, const Pose& pose) {
  PosedBody posed;
  PoseBody(body, pose, &posed);
  return posed;
}

Pose Interpolate(const Pose& a, const Pose& b, double u) {
  Pose out;
  out.root_position = (1 - u) * a.root_position + u * b.root_position;
  out.rotation.resize(a.rotation.size());
  for (size_t l = 0; l < a.rotation.size(); ++l) {
    out.rotation[l] = a.rotation[l].slerp(u, b.rotation[l]);
  }
  return out;
}

Pose Moved(const Pose& pose, const Quat& rotation, const Vec3& translation) {
  Pose out = pose;
  out.root_position = rotation * pose.root_position + translation;
  out.rotation[0] = (rotation * pose.rotation[0]).normalized();
  return out;
}

}  // namespace retarget
