#include "solver/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "model/body/pass_through.h"
#include "model/body/path.h"
#include "model/geometry/polyline.h"
#include "model/geometry/so3.h"
#include "solver/problem/clock.h"
#include "solver/problem/root_drift.h"
#include "solver/problem/root_targets.h"
#include "solver/simulation/physics_world.h"
#include "solver/simulation/tangle_force.h"

namespace retarget::solver {
namespace {

constexpr double kFallen = 0.35;   // of the stature: the root this far below its target
constexpr double kStrayed = 0.35;  // of the stature: the root this far off its target in any way
constexpr double kLostGli = 0.25;  // turns: a tag below this ...
constexpr double kLostTime = 0.5;  // s: ... from then to the end, for at least this long
constexpr double kRestTime = 0.1;  // s at rest before the clips begin
constexpr double kPassThrough = 0.5;

// What the control aims for at one instant.
struct Target {
  std::array<Pose, 2> pose;
  std::array<Vec3, 2> root_velocity = {Vec3::Zero(), Vec3::Zero()};
  std::array<std::vector<Vec3>, 2> turn_velocity;  // per link, own axes
};

class Run {
 public:
  Run(const Scene& scene, const SimulationSettings& settings)
      : scene_(scene),
        settings_(settings),
        frame_time_(1 / scene.fps()),
        steps_per_frame_(static_cast<int>(std::ceil(frame_time_ / settings.time_step - 1e-9))),
        world_(Figures(), Ties(), Options()),
        tangle_force_(scene, settings),
        meeting_(MeetingShifts(scene)) {
    for (int f = 0; f < 2; ++f) {
      relative_[f] = RelativeRootTargets(scene, f);
      result_.motion[f].fps = scene.fps();
      result_.motion[f].frames.assign(static_cast<size_t>(scene.num_frames()),
                                      scene.posture.pose[f]);
    }
    simulated_.assign(static_cast<size_t>(scene.num_frames()), 0);
  }

  SimulationResult Go() {
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
    Judge();
    result_.seconds = SecondsNow() - started;
    return std::move(result_);
  }

 private:
  std::vector<PhysicsFigure> Figures() {
    std::vector<PhysicsFigure> figures;
    for (int f = 0; f < 2; ++f) {
      PhysicsFigure figure{scene_.body[f], {}};
      for (const Link& link : scene_.body[f].links) {
        stiffness_[f].push_back(settings_.stiffness * JointShare(settings_.gains, link.name));
        figure.damping.push_back(settings_.damping * stiffness_[f].back());
      }
      figure.damping[0] = settings_.root_damping * settings_.root_turn_stiffness;
      figure.root_damping = settings_.root_damping * settings_.root_stiffness;
      figures.push_back(figure);
    }
    return figures;
  }

  // One for every hold, then one for every node that is planted at some time.
  std::vector<Tie> Ties() {
    std::vector<Tie> ties;
    for (const Hold& hold : scene_.holds) {
      Tie tie{hold.from.figure, LinkOf(hold.from), -1, 0, hold.rotation};
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
      world_.Fasten(static_cast<int>(k), InLink(hold.from), InLink(hold.to),
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
        world_.Fasten(foot.tie, scene_.body[foot.figure].nodes[foot.node].offset,
                      posed_[foot.figure].node[foot.node]);
      } else if (!planted && foot.planted) {
        world_.Release(foot.tie);
      }
      foot.planted = planted;
    }
  }

  void ReleaseFeet() {
    for (Foot& foot : feet_) {
      world_.Release(foot.tie);
      foot.planted = false;
    }
  }

  // The capture at `u` of the way from frame t to frame `next`.
  Target TargetAt(int t, int next, double u) const {
    Target target;
    for (int f = 0; f < 2; ++f) {
      const Pose from = ShiftedRoot(scene_.source[f].frames[t], meeting_[f][t]);
      const Pose to = ShiftedRoot(scene_.source[f].frames[next], meeting_[f][next]);
      target.pose[f] = Interpolate(from, to, u);
      target.root_velocity[f] = (to.root_position - from.root_position) / frame_time_;
      for (size_t l = 0; l < from.rotation.size(); ++l) {
        target.turn_velocity[f].push_back(LogSo3(from.rotation[l].conjugate() * to.rotation[l]) /
                                          frame_time_);
      }
      if (relative_[f].empty()) continue;
      // A follower goes where it belongs on its partner, as that is now.
      const Pose partner = world_.PoseOf(1 - f);
      const RelativeRoot &a = relative_[f][t], &b = relative_[f][next];
      target.pose[f].rotation[0] = partner.rotation[0] * a.rotation.slerp(u, b.rotation);
      target.pose[f].root_position =
          partner.root_position + partner.rotation[0] * ((1 - u) * a.position + u * b.position);
      target.root_velocity[f] = world_.RootVelocity(1 - f);
      target.turn_velocity[f][0] = target.pose[f].rotation[0].conjugate() *
                                   (partner.rotation[0] * world_.JointVelocity(1 - f, 0));
    }
    return target;
  }

  // Springs towards the target, and the target's own speed against the damping, which the engine
  // takes off implicitly.
  void Control(const Target& target) {
    for (int f = 0; f < 2; ++f) {
      const Pose pose = world_.PoseOf(f);
      const Pose& aim = target.pose[f];
      world_.AddForce(
          f, 0, posed_[f].centre[0],
          settings_.root_stiffness * (aim.root_position - pose.root_position +
                                      settings_.root_damping * target.root_velocity[f]));
      for (int l = 0; l < scene_.body[f].num_links(); ++l) {
        const Vec3 error = LogSo3(pose.rotation[l].conjugate() * aim.rotation[l]);
        const double stiffness = l == 0 ? settings_.root_turn_stiffness : stiffness_[f][l];
        const double damping = l == 0 ? settings_.root_damping : settings_.damping;
        world_.AddJointTorque(f, l, stiffness * (error + damping * target.turn_velocity[f][l]));
      }
    }
  }

  // One step of physics. False where the run has come apart.
  bool Step(const Target& target) {
    world_.BeginStep();
    Look();
    Control(target);
    tangle_force_.Apply(posed_, &world_);
    world_.EndStep();
    result_.simulated += world_.time_step();
    if (world_.Sound()) return true;
    Stop(SimulationStatus::kDiverged, "the simulation came apart");
    return false;
  }

  void Look() {
    for (int f = 0; f < 2; ++f) posed_[f] = world_.Posed(f);
  }

  bool Settle() {
    const int t = scene_.template_frame;
    const Target target = TargetAt(t, t, 0);
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
    world_.Locate();
    Look();
    while (result_.settle_s < settings_.settle_max_s && rest < kRestTime) {
      const std::array<PosedBody, 2> before = posed_;
      if (!Step(relative_[0].empty() && relative_[1].empty() ? target : TargetAt(t, t, 0))) {
        return false;
      }
      result_.settle_s += world_.time_step();
      // Step looks before it moves: this is the distance covered by the step before.
      const bool slow = distance(before) < settings_.settle_speed * world_.time_step();
      rest = slow && result_.settle_s > 3 * world_.time_step() ? rest + world_.time_step() : 0;
    }
    result_.settled = rest >= kRestTime;
    world_.Locate();
    Look();
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
      world_.Locate();
      Look();
      PlantFeet(t);
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

  // What became of the tags in the frames that were simulated.
  void Judge() {
    result_.frames_simulated =
        static_cast<int>(std::count(simulated_.begin(), simulated_.end(), 1));
    if (result_.status != SimulationStatus::kCompleted) {
      result_.message += "; " + std::to_string(result_.frames_simulated) + " of " +
                         std::to_string(scene_.num_frames()) + " frames were simulated";
      return;
    }
    JudgeTags();
    if (result_.status == SimulationStatus::kCompleted) JudgePassThroughs();
    if (result_.status == SimulationStatus::kCompleted) JudgeStray();
    if (result_.status == SimulationStatus::kCompleted) result_.message = "it ran to the end";
  }

  std::array<PosedBody, 2> PosedAt(int t) const {
    return {PoseBody(scene_.body[0], result_.motion[0].frames[t]),
            PoseBody(scene_.body[1], result_.motion[1].frames[t])};
  }

  // Lost for good: gone from some frame to either end of the clip.
  void JudgeTags() {
    const int least = static_cast<int>(std::ceil(kLostTime * scene_.fps()));
    for (const HeldTangle& held : scene_.tangles) {
      const auto lost_at = [&](int t) {
        const std::array<PosedBody, 2> posed = PosedAt(t);
        return held.sign *
                   PolylineGli(
                       PointsOn(posed[0].node, NodesOn(scene_.body[0], held.tag.tangle.a)),
                       PointsOn(posed[1].node, NodesOn(scene_.body[1], held.tag.tangle.b))) <
               kLostGli;
      };
      int first = scene_.num_frames(), last = -1;
      while (first > 0 && lost_at(first - 1)) --first;
      while (last + 1 < first && lost_at(last + 1)) ++last;
      const bool at_end = scene_.num_frames() - first >= std::min(least, scene_.num_frames());
      if (!at_end && last + 1 < least) continue;
      const auto name = [&](int f, int n) { return scene_.body[f].nodes[n].name; };
      const Tangle& t = held.tag.tangle;
      Stop(SimulationStatus::kLostHold,
           "it lost the tag a (" + name(0, t.a.from) + ", " + name(0, t.a.to) + ") x b (" +
               name(1, t.b.from) + ", " + name(1, t.b.to) + ") for good " +
               (at_end ? "at frame " + std::to_string(first)
                       : "before frame " + std::to_string(last + 1)),
           at_end ? first : last + 1);
      return;
    }
  }

  void JudgePassThroughs() {
    std::array<PosedBody, 2> before = PosedAt(0);
    for (int t = 1; t < scene_.num_frames(); ++t) {
      const std::array<PosedBody, 2> now = PosedAt(t);
      const GliJump jump = LargestGliJump(scene_.body, {before[0].node, before[1].node},
                                          {now[0].node, now[1].node}, kGuardReach);
      if (jump.size > kPassThrough) {
        Stop(SimulationStatus::kPassedThrough,
             scene_.body[0].nodes[jump.node_a].name + " of a went through " +
                 scene_.body[1].nodes[jump.node_b].name + " of b at frame " + std::to_string(t),
             t);
        return;
      }
      before = now;
    }
  }

  // A figure that stumbled and is dragged along shows nothing of its motion: no start for a solve.
  void JudgeStray() {
    if (stray_.share < kStrayed) return;
    char text[100];
    std::snprintf(text, sizeof text, "%s strayed %.2f m from its way at frame %d",
                  stray_.figure == 0 ? "a" : "b", stray_.distance_m, stray_.frame);
    Stop(SimulationStatus::kStrayed, text, stray_.frame);
  }

  // Where a root was furthest from where the control wanted it.
  struct Stray {
    double share = 0, distance_m = 0;  // share of the stature
    int figure = 0, frame = 0;
  };
  struct Foot {
    int figure, node, tie;
    bool planted;
  };

  const Scene& scene_;
  const SimulationSettings& settings_;
  double frame_time_;
  int steps_per_frame_;
  std::array<std::vector<double>, 2> stiffness_;  // per link (N m/rad)
  std::vector<Foot> feet_;
  PhysicsWorld world_;
  TangleForce tangle_force_;
  std::array<std::vector<RelativeRoot>, 2> relative_;
  std::array<std::vector<RootShift>, 2> meeting_;
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
  return Run(scene, settings).Go();
}

}  // namespace retarget::solver
