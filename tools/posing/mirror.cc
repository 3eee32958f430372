#include "tools/posing/mirror.h"

#include <algorithm>
#include <string>
#include <utility>

#include "model/body/mirror.h"

namespace retarget::posing {
namespace {

using retarget::Reflected;  // points and rotations; below: bodies and paths

int OtherNode(const Body& body, int node) {
  return body.FindNode(OtherSide(body.nodes[node].name));
}
int OtherLink(const Body& body, int link) {
  return body.FindLink(OtherSide(body.links[link].name));
}

// Joint limits stay with their side.
Body Reflected(const Body& body) {
  Body out = body;
  for (int l = 0; l < body.num_links(); ++l) {
    const Link& other = body.links[OtherLink(body, l)];
    out.links[l].centre = Reflected(other.centre);
    out.links[l].locked = other.locked;
  }
  for (int n = 0; n < body.num_nodes(); ++n) {
    const Node& other = body.nodes[OtherNode(body, n)];
    out.nodes[n].offset = Reflected(other.offset);
    out.nodes[n].radius = other.radius;
    out.nodes[n].mass = other.mass;
  }
  return out;
}

// Joints alone; the root stays.
std::vector<Quat> ReflectedJoints(const Body& body, const Pose& pose) {
  std::vector<Quat> rotation = ReflectedRotations(body, pose);
  rotation[0] = pose.rotation[0];
  return rotation;
}

Path Reflected(const Body& body, const Path& path) {
  const int from = OtherNode(body, path.from), to = OtherNode(body, path.to);
  return {std::min(from, to), std::max(from, to)};
}

void ReflectPoint(const Body& body, HoldPoint* point) {
  point->node = OtherNode(body, point->node);
  point->offset = Reflected(point->offset);
}

// Body, joints, supports, tangles, contacts and pinned nodes of one figure; holds are the caller's.
void ReflectOwn(int figure, PoseState* state) {
  TemplatePosture& posture = state->posture;
  Body& body = posture.body[figure];
  posture.pose[figure].rotation = ReflectedJoints(body, posture.pose[figure]);
  for (int& node : posture.supports[figure]) node = OtherNode(body, node);
  for (TangleRequest& tangle : posture.tangles) {
    Path& path = figure == 0 ? tangle.a : tangle.b;
    path = Reflected(body, path);
  }
  if (posture.contacts) {
    for (HandContact& contact : *posture.contacts) {
      int& node = contact.figure == figure ? contact.hand : contact.to;
      node = OtherNode(body, node);
    }
  }
  for (PinnedNode& pin : state->pins) {
    if (pin.figure == figure) pin.node = OtherNode(body, pin.node);
  }
  body = Reflected(body);
}

}  // namespace

PoseState MirroredScene(const PoseState& state) {
  PoseState out = state;
  for (int f = 0; f < 2; ++f) {
    ReflectOwn(f, &out);
    Pose& pose = out.posture.pose[f];
    pose.root_position = Reflected(pose.root_position);
    pose.rotation[0] = Reflected(pose.rotation[0]);
  }
  for (Hold& hold : out.posture.holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      if (point->figure == kWorld) {
        point->offset = Reflected(point->offset);
      } else {
        ReflectPoint(out.posture.body[point->figure], point);
      }
    }
    hold.relative_rotation = Reflected(hold.relative_rotation);
  }
  for (PinnedNode& pin : out.pins) {
    pin.position = Reflected(pin.position);
    if (pin.ray) pin.ray = PinRay{Reflected(pin.ray->origin), Reflected(pin.ray->direction)};
  }
  return out;
}

PoseState MirroredFigure(const PoseState& state, int figure) {
  PoseState out = state;
  ReflectOwn(figure, &out);
  for (Hold& hold : out.posture.holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      if (point->figure == figure) ReflectPoint(out.posture.body[figure], point);
    }
    if (hold.from.figure == figure && hold.to.figure == figure) {
      hold.relative_rotation = Reflected(hold.relative_rotation);
    }
  }
  return out;
}

PoseState Swapped(const PoseState& state) {
  PoseState out = state;
  TemplatePosture& posture = out.posture;
  std::swap(posture.body[0], posture.body[1]);
  std::swap(posture.pose[0], posture.pose[1]);
  std::swap(posture.supports[0], posture.supports[1]);
  std::swap(posture.root[0], posture.root[1]);
  for (Hold& hold : posture.holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      if (point->figure != kWorld) point->figure = 1 - point->figure;
    }
  }
  for (TangleRequest& tangle : posture.tangles) std::swap(tangle.a, tangle.b);
  if (posture.contacts) {
    for (HandContact& contact : *posture.contacts) contact.figure = 1 - contact.figure;
  }
  for (PinnedNode& pin : out.pins) pin.figure = 1 - pin.figure;
  return out;
}

PoseState WithSideCopied(const PoseState& state, int figure, bool from_left) {
  PoseState out = state;
  const Body& body = state.posture.body[figure];
  const std::vector<Quat> mirrored = ReflectedJoints(body, state.posture.pose[figure]);
  for (int l = 1; l < body.num_links(); ++l) {
    if (body.links[l].name.starts_with(from_left ? "right_" : "left_")) {
      out.posture.pose[figure].rotation[l] = mirrored[l];
    }
  }
  return out;
}

}  // namespace retarget::posing
