// Inverse kinematics: both figures posed by drags and pins of their nodes. One frame of the
// spacetime problem with its very terms: holds, joint limits, penetration, floor, and tracking of
// the pose before the drag; drags and pins are holds to the world with weights of their own.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/body/template_posture.h"
#include "model/settings.h"
#include "solver/problem/scene.h"
#include "solver/problem/terms/ray.h"

namespace retarget::solver {

// A node that is to be at a place in the world (m).
struct NodeTarget {
  int figure = 0;
  int node = 0;
  Vec3 position = Vec3::Zero();
};

// What is asked of a pose.
struct PoseTask {
  std::array<Body, 2> body;
  std::array<Pose, 2> before;  // the pose before the drag: what the solve stays close to.
                               // Self-penetration counts beyond what it shows, joint limits do not.
  std::vector<NodeTarget> drags, pins;
  std::vector<NodeRay> drag_rays, pin_rays;
  std::vector<Hold> holds;
  std::vector<TangleTarget> tangles;
};

struct PoseSettings {
  Settings settings;                // weights and the solve's; a weight of 0 switches the term off
  double drag = 60;                 // 1/m, weight of drags
  double pin = 600;                 // 1/m, weight of pins
  double max_target_step_m = 0.10;  // a target draws from no further than this: a far one is
                                    // approached in steps, and one out of reach tears nothing apart
  int max_iterations = 200;
  double max_seconds = 0;  // 0: no limit; else it stops after the iteration that reaches it
};

// Weights for posing: contacts and limits are stiffer than the drag, tracking much softer.
PoseSettings DefaultPoseSettings();

// Two limbs, each by figure and outer node.
struct LimbPair {
  std::array<int, 2> figure{};
  std::array<int, 2> node{};
};

struct PoseResult {
  std::array<Pose, 2> pose;
  double drag_error_m = 0;  // largest distance of a drag's node from its target or ray
  double pin_error_m = 0;   // the same of pins
  // Limbs that the way to the target leads through: the figures stop before.
  std::optional<LimbPair> blocked;
  bool stalled = false;    // only a step that the guard refuses leads on
  bool converged = false;  // nothing is left to gain; else the iterations or the time ran out
  int iterations = 0;      // accepted steps
  double seconds = 0;
};

// Solves from `start`: the pose before the drag, or where its last step ended. No step moves a node
// further than solve.step_limit_m or takes a limb through a limb, of the other body or of its own.
PoseResult SolvePose(const PoseTask& task, const std::array<Pose, 2>& start,
                     const PoseSettings& settings);

}  // namespace retarget::solver
