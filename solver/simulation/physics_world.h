// Rigid-body physics of figures: all of MuJoCo is behind this (physics_world.cc).
// Todorov, Erez, Tassa, "MuJoCo: a physics engine for model-based control", 2012.
#pragma once

#include <memory>
#include <vector>

#include "model/body/pose.h"
#include "solver/simulation/mjcf.h"

namespace retarget::solver {

// Forces act between BeginStep and EndStep and are forgotten after. The figures' joint rotations
// are those of model/body/pose.h; angular velocities and torques of a joint are in the link's own
// axes. The same calls give the same motion, bit for bit.
class PhysicsWorld {
 public:
  PhysicsWorld(const std::vector<PhysicsFigure>& figures,
               const std::vector<EqualityConstraint>& ties, const PhysicsOptions& options);
  ~PhysicsWorld();
  PhysicsWorld(PhysicsWorld&&) noexcept;

  double time_step() const;

  // Puts a figure into a pose, at rest.
  void SetPose(int figure, const Pose& pose);
  // Velocities: of the root (m/s, world), and of every joint (rad/s, own axes; [0] the root's).
  void SetVelocity(int figure, const Vec3& root, const std::vector<Vec3>& joint);
  Pose PoseOf(int figure) const;
  Vec3 RootVelocity(int figure) const;
  Vec3 JointVelocity(int figure, int link) const;

  // Where the engine has every link and node, at the last BeginStep or UpdateKinematics.
  void UpdateKinematics();
  PosedBody Posed(int figure) const;

  // Fastens a tie: `point` in the link's frame to `to_point` in the other's (or the world's);
  // `relative` is the first link's turn in the second's frame.
  void EnableEquality(int tie, const Vec3& point, const Vec3& to_point,
                      const Quat& relative = Quat::Identity());
  void DisableEquality(int tie);

  // Whether a segment (by its outer node) collides with the floor; all do to begin with.
  void SetFloorContact(int figure, int node, bool collides);

  void BeginStep();
  void AddForce(int figure, int link, const Vec3& world_point, const Vec3& force);  // N, world
  void AddTorque(int figure, int link, const Vec3& torque);       // N m, world, from outside
  void AddJointTorque(int figure, int link, const Vec3& torque);  // N m, own axes, parent's reacts
  void EndStep();

  // After BeginStep: kinetic and potential energy of all figures (J), and their momentum about the
  // world's origin (kg m/s; kg m^2/s).
  double Energy() const;
  Vec3 LinearMomentum() const;
  Vec3 AngularMomentum() const;
  double Mass() const;  // kg, all figures

  // False once the engine has met a number that is none, or a speed out of all reason.
  bool IsStable() const;

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace retarget::solver
