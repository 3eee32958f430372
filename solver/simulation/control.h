// What drives the figures of the simulation: springs of joints and roots towards the captured
// motion (Ho and Komura 2007, section 5, tau_PD of Eq. 4).
#pragma once

#include <array>
#include <vector>

#include "model/settings.h"
#include "solver/problem/root_drift.h"
#include "solver/problem/root_targets.h"
#include "solver/simulation/physics_world.h"

namespace retarget::solver {

// What the control aims for at one instant.
struct ControlTarget {
  std::array<Pose, 2> pose;
  std::array<Vec3, 2> root_velocity = {Vec3::Zero(), Vec3::Zero()};  // m/s
  std::array<std::vector<Vec3>, 2> turn_velocity;                    // per link, own axes (rad/s)
};

class Control {
 public:
  // Scene and settings must outlive it.
  Control(const Scene& scene, const SimulationSettings& settings);

  // A figure with the damping that belongs to its springs.
  PhysicsFigure FigureOf(int figure) const;

  // The capture at `u` of the way from frame t to frame `next`; a figure that follows its partner
  // goes where it belongs on the partner, as that is in `world` now.
  ControlTarget TargetAt(int t, int next, double u, const PhysicsWorld& world) const;

  // Springs towards the target, and the target's own speed against the damping, which the engine
  // takes off implicitly. `posed` is the posture that `world` is in.
  void Apply(const ControlTarget& target, const std::array<PosedBody, 2>& posed,
             PhysicsWorld* world) const;

 private:
  // Of the root's place over the floor, and of its height where the figure follows its own clip:
  // the capture carries its own weight, and feet that sag with it would trip (N/m).
  Vec3 RootStiffness(int figure) const;

  const Scene& scene_;
  const SimulationSettings& settings_;
  std::array<std::vector<double>, 2> stiffness_;  // per link (N m/rad)
  std::array<std::vector<RelativeRoot>, 2> relative_;
  std::array<std::vector<RootShift>, 2> drift_correction_;
};

}  // namespace retarget::solver
