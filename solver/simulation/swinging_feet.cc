#include "solver/simulation/swinging_feet.h"

#include <algorithm>

namespace retarget::solver {
namespace {
constexpr double kTouches = 0.002;  // m: feet of a clip no further from the floor touch it
}

SwingingFeet::SwingingFeet(const Scene& scene) {
  for (int f = 0; f < 2; ++f) {
    const Body& body = scene.body[f];
    for (const char* name : {"left_ankle", "left_toe", "right_ankle", "right_toe"}) {
      const int node = body.FindNode(name);
      if (node >= 0) segments_.push_back({f, node, {}});
    }
    for (const Pose& pose : scene.source[f].frames) {
      const std::vector<Vec3> at = PoseBody(body, pose).node;
      for (Segment& s : segments_) {
        if (s.figure != f) continue;
        const Node& node = body.nodes[s.node];
        const double lowest = std::min(at[s.node].y(), at[node.parent].y());
        s.touches.push_back(lowest < node.radius + kTouches);
      }
    }
  }
}

void SwingingFeet::Apply(int t, int next, PhysicsWorld* world) const {
  for (const Segment& s : segments_) {
    world->SetFloorContact(s.figure, s.node, s.touches[t] || s.touches[next]);
  }
}

}  // namespace retarget::solver
