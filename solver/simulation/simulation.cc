#include "solver/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "solver/problem/clock.h"
#include "solver/simulation/control.h"
#include "solver/simulation/judge.h"
#include "solver/simulation/physics_world.h"
#include "solver/simulation/swinging_feet.h"
#include "solver/simulation/tangle_force.h"

namespace retarget::solver {
namespace {

// A root this share of the stature below its target: it stands at a little over half of the
// stature, so the figure sits, kneels or lies.
constexpr double kFallen = 0.35;
constexpr double kRestTime = 0.1;  // s at rest before the clips begin: one slow step is none

class Simulator {
 public:
  Simulator(const Scene& scene, const SimulationSettings& settings)
      : scene_(scene),
        settings_(settings),
        frame_time_(1 / scene.fps()),
        steps_per_frame_(static_cast<int>(std::ceil(frame_time_ / settings.time_step - 1e-9))),
        control_(scene, settings),
        world_({control_.FigureOf(0), control_.FigureOf(1)}, EqualityConstraints(), Options()),
        tangle_force_(scene, settings),
        swinging_feet_(scene) {
    for (int f = 0; f < 2; ++f) {
      result_.motion[f].fps = scene.fps();
      result_.motion[f].frames.assign(static_cast<size_t>(scene.num_frames()),
                                      scene.posture.pose[f]);
    }
    simulated_.assign(static_cast<size_t>(scene.num_frames()), 0);
  }

  SimulationResult Run() {
    const double started = SecondsNow();
    for (int f = 0; f < 2; ++f) world_.SetPose(f, scene_.posture.pose[f]);
    FastenHolds();
    if (Settle()) {
      const std::array<Pose, 2> rest = {world_.PoseOf(0), world_.PoseOf(1)};
      if (Play(1) && scene_.template_frame > 0) {
        for (int f = 0; f < 2; ++f) world_.SetPose(f, rest[f]);
        ReleaseFeet();
        Play(-1);
      }
    }
    result_.frames_simulated =
        static_cast<int>(std::count(simulated_.begin(), simulated_.end(), 1));
    ClassifySimulation(scene_, stray_, &result_);
    result_.seconds = SecondsNow() - started;
    return std::move(result_);
  }

 private:
  // One for every hold, then one for every node that is planted at some time.
  std::vector<EqualityConstraint> EqualityConstraints() {
    std::vector<EqualityConstraint> ties;
    for (const Hold& hold : scene_.holds) {
      EqualityConstraint tie{hold.from.figure, LinkOf(hold.from), -1, 0, hold.rotation};
      if (hold.to.figure != kWorld) {
        tie.to_figure = hold.to.figure;
        tie.to_link = LinkOf(hold.to);
      }
      ties.push_back(tie);
    }
    for (int f = 0; f < 2; ++f) {
      for (const Contact& contact : scene_.contacts[f]) {
        const int node = contact.node;
        const bool known = std::any_of(feet_.begin(), feet_.end(), [&](const Foot& foot) {
          return foot.figure == f && foot.node == node;
        });
        if (known) continue;
        feet_.push_back({f, node, static_cast<int>(ties.size()), false});
        ties.push_back({f, scene_.body[f].nodes[node].link, -1, 0, false});
      }
    }
    return ties;
  }

  PhysicsOptions Options() const {
    PhysicsOptions options;
    options.time_step = frame_time_ / steps_per_frame_;
    options.gravity = settings_.gravity;
    options.armature = settings_.armature;
    options.friction = settings_.friction;
    options.contact_time = settings_.contact_time;
    options.tie_time = settings_.tie_time;
    return options;
  }

  int LinkOf(const HoldPoint& point) const {
    return scene_.body[point.figure].nodes[point.node].link;
  }

  Vec3 InLink(const HoldPoint& point) const {
    if (point.figure == kWorld) return point.offset;
    return scene_.body[point.figure].nodes[point.node].offset + point.offset;
  }

  void FastenHolds() {
    for (size_t k = 0; k < scene_.holds.size(); ++k) {
      const Hold& hold = scene_.holds[k];
      world_.EnableEquality(static_cast<int>(k), InLink(hold.from), InLink(hold.to),
                            hold.relative_rotation);
    }
  }

  // Feet stand where they are from the frame in which their contact begins to that in which it
  // ends.
  void PlantFeet(int t) {
    for (Foot& foot : feet_) {
      const auto& contacts = scene_.contacts[foot.figure];
      const bool planted = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return c.node == foot.node && c.first <= t && t <= c.last;
      });
      if (planted && !foot.planted) {
        world_.EnableEquality(foot.tie, scene_.body[foot.figure].nodes[foot.node].offset,
                              posed_[foot.figure].node[foot.node]);
      } else if (!planted && foot.planted) {
        world_.DisableEquality(foot.tie);
      }
      foot.planted = planted;
    }
  }

  void ReleaseFeet() {
    for (Foot& foot : feet_) {
      world_.DisableEquality(foot.tie);
      foot.planted = false;
    }
  }

  ControlTarget TargetAt(int t, int next, double u) const {
    return control_.TargetAt(t, next, u, world_);
  }

  // One step of physics. False where the run has come apart.
  bool Step(const ControlTarget& target) {
    world_.BeginStep();
    ReadState();
    control_.Apply(target, posed_, &world_);
    tangle_force_.Apply(posed_, &world_);
    world_.EndStep();
    result_.simulated += world_.time_step();
    if (world_.IsStable()) return true;
    Stop(SimulationStatus::kDiverged, "the simulation came apart");
    return false;
  }

  void ReadState() {
    for (int f = 0; f < 2; ++f) posed_[f] = world_.Posed(f);
  }

  bool Settle() {
    const int t = scene_.template_frame;
    const auto distance = [&](const std::array<PosedBody, 2>& from) {
      double largest = 0;
      for (int f = 0; f < 2; ++f) {
        for (size_t n = 0; n < posed_[f].node.size(); ++n) {
          largest = std::max(largest, (posed_[f].node[n] - from[f].node[n]).norm());
        }
      }
      return largest;
    };
    double rest = 0;
    world_.UpdateKinematics();
    ReadState();
    while (result_.settle_s < settings_.settle_max_s && rest < kRestTime) {
      const std::array<PosedBody, 2> before = posed_;
      if (!Step(TargetAt(t, t, 0))) return false;
      result_.settle_s += world_.time_step();
      // Step looks before it moves: this is the distance covered by the step before.
      const bool slow = distance(before) < settings_.settle_speed * world_.time_step();
      rest = slow && result_.settle_s > 3 * world_.time_step() ? rest + world_.time_step() : 0;
    }
    result_.settled = rest >= kRestTime;
    world_.UpdateKinematics();
    ReadState();
    double sum = 0, count = 0;
    for (int f = 0; f < 2; ++f) {
      const PosedBody posture = PoseBody(scene_.body[f], scene_.posture.pose[f]);
      for (size_t n = 0; n < posture.node.size(); ++n, ++count) {
        sum += (posed_[f].node[n] - posture.node[n]).norm();
      }
    }
    result_.settle_distance_m = sum / count;
    Record(t);
    return true;
  }

  // Plays from the template's frame to an end of the clip. False where it broke off.
  bool Play(int direction) {
    const int end = direction > 0 ? scene_.num_frames() - 1 : 0;
    for (int t = scene_.template_frame; t != end; t += direction) {
      world_.UpdateKinematics();
      ReadState();
      PlantFeet(t);
      swinging_feet_.Apply(t, t + direction, &world_);
      for (int k = 0; k < steps_per_frame_; ++k) {
        if (!Step(TargetAt(t, t + direction, (k + 1.0) / steps_per_frame_))) {
          HoldFrom(t + direction, direction);
          return false;
        }
      }
      Record(t + direction);
      if (Fallen(t + direction)) {
        HoldFrom(t + direction, direction);
        return false;
      }
    }
    return true;
  }

  void Record(int t) {
    for (int f = 0; f < 2; ++f) result_.motion[f].frames[t] = world_.PoseOf(f);
    simulated_[t] = 1;
  }

  // Nothing is simulated from frame t on: the last posture stays.
  void HoldFrom(int t, int direction) {
    for (; t >= 0 && t < scene_.num_frames(); t += direction) {
      for (int f = 0; f < 2; ++f) {
        auto& frames = result_.motion[f].frames;
        frames[t] = frames[t - direction];
      }
    }
  }

  bool Fallen(int t) {
    for (int f = 0; f < 2; ++f) {
      const Vec3 off = world_.PoseOf(f).root_position - TargetAt(t, t, 0).pose[f].root_position;
      const double share = off.norm() / scene_.body[f].stature;
      if (share > stray_.share) stray_ = {share, off.norm(), f, t};
      if (-off.y() < kFallen * scene_.body[f].stature) continue;
      char text[100];
      std::snprintf(text, sizeof text, "%s fell at frame %d", f == 0 ? "a" : "b", t);
      Stop(SimulationStatus::kFell, text, t);
      return true;
    }
    return false;
  }

  void Stop(SimulationStatus status, const std::string& message, int frame = -1) {
    result_.status = status;
    result_.message = message;
    result_.frame = frame;
  }

  struct Foot {
    int figure, node, tie;
    bool planted;
  };

  const Scene& scene_;
  const SimulationSettings& settings_;
  double frame_time_;
  int steps_per_frame_;
  std::vector<Foot> feet_;
  Control control_;
  PhysicsWorld world_;
  TangleForce tangle_force_;
  SwingingFeet swinging_feet_;
  std::array<PosedBody, 2> posed_;
  Stray stray_;
  std::vector<char> simulated_;  // per frame
  SimulationResult result_;
};

}  // namespace

const char* NameOf(SimulationStatus status) {
  constexpr const char* kNames[] = {"completed", "diverged",       "fell",
                                    "lost_hold", "passed_through", "strayed"};
  return kNames[static_cast<int>(status)];
}

SimulationResult Simulate(const Scene& scene, const SimulationSettings& settings) {
  return Simulator(scene, settings).Run();
}

}  // namespace retarget::solver
