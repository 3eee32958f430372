// Feet that swing in the simulated run pass through the floor where the clip's do not touch it: a
// foot that the physics has a little lower than the clip would trip, which no performer did.
#pragma once

#include <array>
#include <vector>

#include "solver/problem/scene.h"
#include "solver/simulation/physics_world.h"

namespace retarget::solver {

class SwingingFeet {
 public:
  explicit SwingingFeet(const Scene& scene);
  // Lets feet and shins collide with the floor, or not, on the way from frame t to `next`.
  void Apply(int t, int next, PhysicsWorld* world) const;

 private:
  struct Segment {
    int figure, node;
    std::vector<char> touches;  // the floor, in the clip, per frame
  };
  std::vector<Segment> segments_;
};

}  // namespace retarget::solver
