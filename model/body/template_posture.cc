#include "model/body/template_posture.h"

#include <cassert>

namespace retarget {

Vec3 HoldPosition(const HoldPoint& point, const std::array<Body, 2>& body,
                  const std::array<PosedBody, 2>& posed) {
  if (point.figure == kWorld) return point.offset;
  const PosedBody& p = posed[point.figure];
  return p.node[point.node] + p.rotation[body[point.figure].nodes[point.node].link] * point.offset;
}

std::vector<HandContact> HandContactsOf(const TemplatePosture& posture, double reach) {
  if (posture.contacts) return *posture.contacts;
  return FindHandContacts(
      posture.body,
      {PoseBody(posture.body[0], posture.pose[0]), PoseBody(posture.body[1], posture.pose[1])},
      reach);
}

std::vector<int> StandingNodes(const Body& body, const PosedBody& posed) {
  std::vector<int> standing;
  for (const char* name : {"left_ankle", "left_toe", "right_ankle", "right_toe"}) {
    const int n = body.FindNode(name);
    if (n >= 0 && posed.node[n].y() < 0.15) standing.push_back(n);
  }
  return standing;
}

TemplatePosture OnBodies(const TemplatePosture& posture, const std::array<Body, 2>& body) {
  TemplatePosture out = posture;
  out.body = body;
  std::array<double, 2> ratio;
  for (int f = 0; f < 2; ++f) {
    assert(posture.body[f].links.size() == body[f].links.size());
    ratio[f] = body[f].stature / posture.body[f].stature;
  }
  const double between = 0.5 * (ratio[0] + ratio[1]);
  const Vec3 middle = 0.5 * (posture.pose[0].root_position + posture.pose[1].root_position);
  for (int f = 0; f < 2; ++f) {
    Vec3& root = out.pose[f].root_position;
    const double height = root.y() * ratio[f];
    root = middle + between * (root - middle);
    root.y() = height;
  }
  for (Hold& hold : out.holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      if (point->figure != kWorld) point->offset *= ratio[point->figure];
    }
  }
  return out;
}

}  // namespace retarget
