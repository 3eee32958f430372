// The force that keeps tagged tangles in the simulation (Ho and Komura 2007, section 5, Eq. 4).
//  elastic: an elastic pull between the segments that cross: for a tag with paths P and Q, every
//    pair of segments whose share of the template's s GLI, s p_i q_j G_ij, is at least a tenth of
//    the largest is drawn together by
//      F = share * min(k (d - r_i - r_j), F_max)        (N)
//    at their closest points, d the distance of the axes, r the radii; share relative to the
//    largest. Nothing pushes: contact does that.
//  gli: a force along the gradient of the tag itself,
//      F = k_gli max(0, target - s GLI) d(s GLI)/d point   (N), at the nodes of both paths.
#pragma once

#include <array>
#include <vector>

#include "model/settings.h"
#include "solver/problem/scene.h"
#include "solver/simulation/physics_world.h"

namespace retarget::solver {

class TangleForce {
 public:
  TangleForce(const Scene& scene, const SimulationSettings& settings);
  // Adds the forces of the posture that `world` is in; between BeginStep and EndStep.
  void Apply(const std::array<PosedBody, 2>& posed, PhysicsWorld* world) const;

 private:
  struct Pull {
    int node_a, node_b;  // segments, by outer node
    double share;
  };
  void ApplyElastic(const std::array<PosedBody, 2>& posed, PhysicsWorld* world) const;
  void ApplyGli(const std::array<PosedBody, 2>& posed, PhysicsWorld* world) const;

  const Scene* scene_;
  SimulationSettings settings_;
  std::vector<Pull> pulls_;
};

}  // namespace retarget::solver
