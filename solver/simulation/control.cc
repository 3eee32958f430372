#include "solver/simulation/control.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

Control::Control(const Scene& scene, const SimulationSettings& settings)
    : scene_(scene), settings_(settings), drift_correction_(RootDriftCorrection(scene)) {
  for (int f = 0; f < 2; ++f) {
    relative_[f] = RelativeRootTargets(scene, f);
    for (const Link& link : scene.body[f].links) {
      stiffness_[f].push_back(settings.stiffness * JointShare(settings.gains, link.name));
    }
  }
}

PhysicsFigure Control::FigureOf(int figure) const {
  PhysicsFigure out{scene_.body[figure], {}};
  for (const double stiffness : stiffness_[figure]) {
    out.damping.push_back(settings_.damping * stiffness);
  }
  out.damping[0] = settings_.root_damping * settings_.root_turn_stiffness;
  const Vec3 stiffness = RootStiffness(figure);
  out.root_damping = settings_.root_damping * stiffness.x();
  out.root_height_damping = settings_.root_damping * stiffness.y();
  return out;
}

Vec3 Control::RootStiffness(int figure) const {
  const double k = settings_.root_stiffness;
  return {k, relative_[figure].empty() ? settings_.root_height_stiffness : k, k};
}

ControlTarget Control::TargetAt(int t, int next, double u, const PhysicsWorld& world) const {
  const double frame_time = 1 / scene_.fps();
  ControlTarget target;
  for (int f = 0; f < 2; ++f) {
    const Pose from = ShiftedRoot(scene_.source[f].frames[t], drift_correction_[f][t]);
    const Pose to = ShiftedRoot(scene_.source[f].frames[next], drift_correction_[f][next]);
    target.pose[f] = Interpolate(from, to, u);
    target.root_velocity[f] = (to.root_position - from.root_position) / frame_time;
    for (size_t l = 0; l < from.rotation.size(); ++l) {
      target.turn_velocity[f].push_back(LogSo3(from.rotation[l].conjugate() * to.rotation[l]) /
                                        frame_time);
    }
    if (relative_[f].empty()) continue;
    const Pose partner = world.PoseOf(1 - f);
    const RelativeRoot &a = relative_[f][t], &b = relative_[f][next];
    target.pose[f].rotation[0] = partner.rotation[0] * a.rotation.slerp(u, b.rotation);
    target.pose[f].root_position =
        partner.root_position + partner.rotation[0] * ((1 - u) * a.position + u * b.position);
    target.root_velocity[f] = world.RootVelocity(1 - f);
    target.turn_velocity[f][0] = target.pose[f].rotation[0].conjugate() *
                                 (partner.rotation[0] * world.JointVelocity(1 - f, 0));
  }
  return target;
}

void Control::Apply(const ControlTarget& target, const std::array<PosedBody, 2>& posed,
                    PhysicsWorld* world) const {
  for (int f = 0; f < 2; ++f) {
    const Pose pose = world->PoseOf(f);
    const Pose& aim = target.pose[f];
    world->AddForce(
        f, 0, posed[f].centre[0],
        RootStiffness(f).cwiseProduct(aim.root_position - pose.root_position +
                                      settings_.root_damping * target.root_velocity[f]));
    for (int l = 0; l < scene_.body[f].num_links(); ++l) {
      const Vec3 error = LogSo3(pose.rotation[l].conjugate() * aim.rotation[l]);
      const double stiffness = l == 0 ? settings_.root_turn_stiffness : stiffness_[f][l];
      const double damping = l == 0 ? settings_.root_damping : settings_.damping;
      world->AddJointTorque(f, l, stiffness * (error + damping * target.turn_velocity[f][l]));
    }
  }
}

}  // namespace retarget::solver
