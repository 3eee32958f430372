#include "solver/optimizer/pose_solve.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "model/body/pass_through.h"
#include "solver/optimizer/spacetime.h"
#include "solver/problem/clock.h"
#include "solver/problem/problem.h"
#include "solver/problem/terms/hold.h"

namespace retarget::solver {
namespace {

// A target counts as reached from here on (m).
constexpr double kReached = 0.01;
// The lead of a target (PoseSettings::max_target_step_m) is halved where a solve gains less than
// this share of it, down to the least: as short as a way that counts as reached.
constexpr double kLeastGainOfLead = 0.02;
constexpr double kLeastLead = kReached;  // m
constexpr double kLeastGain = 1e-4;      // m of all drags together: less is no progress
constexpr double kLeastSeconds = 1e-3;   // for a solve at the end of the time: one iteration
// Iterations before the poses are looked at again: few where the led target itself moves on.
constexpr int kIterationsLed = 3;
constexpr int kIterationsPerSolve = 20;

using Poses = std::array<Pose, 2>;
using Bodies = std::array<PosedBody, 2>;

// Nodes held at places in the world.
class TargetTerm : public Term {
 public:
  TargetTerm(const char* name, const std::vector<NodeTarget>& targets) : name_(name) {
    for (const NodeTarget& t : targets) {
      Hold hold;
      hold.from = {t.figure, t.node, Vec3::Zero()};
      hold.to = {kWorld, 0, t.position};
      holds_.push_back(hold);
    }
  }
  const char* name() const override { return name_; }
  const char* unit() const override { return "m"; }
  int row_slots(const Frame&) const override { return 3 * static_cast<int>(holds_.size()); }
  void EvaluatePart(const Frame& frame, int, Rows* rows) const override {
    for (const Hold& hold : holds_) AddHoldRows(frame, hold, rows);
  }

 private:
  const char* name_;
  std::vector<Hold> holds_;
};

Bodies Posed(const PoseTask& task, const Poses& pose) {
  return {PoseBody(task.body[0], pose[0]), PoseBody(task.body[1], pose[1])};
}

struct Errors {
  double largest = 0, sum = 0;  // m
  void Add(double error) {
    largest = std::max(largest, error);
    sum += error;
  }
};

Errors ErrorsOf(const Bodies& posed, const std::vector<NodeTarget>& targets,
                const std::vector<NodeRay>& rays) {
  Errors errors;
  for (const NodeTarget& t : targets) {
    errors.Add((posed[t.figure].node[t.node] - t.position).norm());
  }
  for (const NodeRay& r : rays) errors.Add(FromRay(r, posed[r.figure].node[r.node]).norm());
  return errors;
}

// Targets no further than `lead` from where their nodes are.
PoseTask ClampedTarget(const PoseTask& task, const Bodies& posed, double lead) {
  PoseTask led = task;
  const auto shortened = [&](const Vec3& v) -> Vec3 {
    return v * std::min(1.0, lead / std::max(v.norm(), 1e-12));
  };
  for (NodeTarget& t : led.drags) {
    const Vec3& from = posed[t.figure].node[t.node];
    t.position = from + shortened(t.position - from);
  }
  for (NodeRay& r : led.drag_rays) {
    const Vec3 away = FromRay(r, posed[r.figure].node[r.node]);
    r.origin += away - shortened(away);
  }
  return led;
}

std::optional<LimbPair> PassedThrough(const PoseTask& task, const Bodies& before,
                                      const Bodies& after) {
  const double all = std::numeric_limits<double>::infinity();
  for (const auto& [f, g] : {std::pair(0, 1), std::pair(0, 0), std::pair(1, 1)}) {
    const GliJump jump =
        LargestGliJump({task.body[f], task.body[g]}, {before[f].node, before[g].node},
                       {after[f].node, after[g].node}, f == g ? kGuardReach : all);
    if (jump.size > kPassThroughGli) return LimbPair{{f, g}, {jump.node_a, jump.node_b}};
  }
  return std::nullopt;
}

Scene SceneOf(const PoseTask& task) {
  Scene scene;
  scene.body = task.body;
  scene.holds = task.holds;
  scene.tangles = task.tangles;
  for (int f = 0; f < 2; ++f) scene.source[f].frames = {task.before[f]};
  scene.source_widens_limits = false;
  return scene;
}

SolveResult SolveOnce(const PoseTask& task, const Poses& start, int iterations, double max_seconds,
                      const PoseSettings& settings, Poses* pose) {
  const Scene scene = SceneOf(task);
  Settings one_frame = settings.settings;
  one_frame.solve.max_iterations = iterations;
  one_frame.solve.max_seconds = max_seconds;
  Problem problem(scene, one_frame);
  problem.Add(std::make_unique<TargetTerm>("drag", task.drags), settings.drag);
  problem.Add(std::make_unique<TargetTerm>("pin", task.pins), settings.pin);
  problem.Add(std::make_unique<RayTerm>(task.drag_rays), settings.drag);
  problem.Add(std::make_unique<RayTerm>(task.pin_rays), settings.pin);
  std::array<Clip, 2> from;
  for (int f = 0; f < 2; ++f) from[f].frames = {start[f]};
  SolveResult solved = SolveSpacetime(problem, UnknownsFromPoses(scene, from), nullptr);
  const std::array<Clip, 2> edited = EditedClips(scene, solved.unknowns);
  for (int f = 0; f < 2; ++f) {
    (*pose)[f] = edited[f].frames[0];
    for (Quat& q : (*pose)[f].rotation) q.normalize();
  }
  return solved;
}

}  // namespace

PoseSettings DefaultPoseSettings() {
  PoseSettings pose;
  Weights& w = pose.settings.weights;
  w.pose_tracking = 0.5;
  // Hands and feet go where the limb takes them: in a capture their joints are cheap to change, but
  // a dragged wrist should not bend before the elbow does.
  JointWeights& joint = pose.settings.joint_weights;
  joint.wrist = joint.clavicle = 1.5;
  joint.ankle = 1;
  w.root_tracking = 3;
  w.hold = w.penetration = w.self_penetration = w.ground = 300;
  w.joint_limit = 100;
  w.tangle = w.tangle_aim = w.hand_contact = 0;
  SolveSettings& solve = pose.settings.solve;
  solve.backend = Backend::kBanded;
  solve.threads = 1;
  solve.stages = {1};
  solve.max_seconds = 0;
  solve.polish_decrease = 1e-3;
  return pose;
}

PoseResult SolvePose(const PoseTask& task, const Poses& start, const PoseSettings& settings) {
  const double started = SecondsNow();
  PoseResult result;
  result.pose = start;
  Bodies posed = Posed(task, start);
  Errors errors = ErrorsOf(posed, task.drags, task.drag_rays);
  double lead = settings.max_target_step_m;
  const bool timed = settings.max_seconds > 0;
  while (result.iterations < settings.max_iterations && !result.converged) {
    const double left = settings.max_seconds - (SecondsNow() - started);
    if (timed && left <= 0 && result.iterations > 0) break;
    const bool led = errors.largest > lead;
    const int iterations = std::min(settings.max_iterations - result.iterations,
                                    led ? kIterationsLed : kIterationsPerSolve);
    Poses next;
    const SolveResult solved =
        SolveOnce(ClampedTarget(task, posed, lead), result.pose, iterations,
                  timed ? std::max(left, kLeastSeconds) : 0, settings, &next);
    result.iterations += std::max(solved.iterations, 1);
    const Bodies next_posed = Posed(task, next);
    const std::optional<LimbPair> passed = PassedThrough(task, posed, next_posed);
    if (passed) {
      result.blocked = passed;
      result.converged = lead <= kLeastLead;
      lead /= 2;
      continue;
    }
    const Errors next_errors = ErrorsOf(next_posed, task.drags, task.drag_rays);
    const double gain = errors.sum - next_errors.sum;
    errors = next_errors;
    result.pose = next;
    posed = next_posed;
    result.stalled = solved.stalled;
    const bool settled = solved.status == SolveStatus::kConverged;
    result.converged = led ? gain < kLeastGain && lead <= kLeastLead : settled;
    // Where little was gained the target is out of reach, or the way bends: a shorter lead bends
    // with it, and its linear model holds for short limbs too.
    if (led && gain < kLeastGainOfLead * lead) lead = std::max(lead / 2, kLeastLead);
  }
  if (errors.largest < kReached) result.blocked.reset();  // another way was found
  result.drag_error_m = errors.largest;
  result.pin_error_m = ErrorsOf(posed, task.pins, task.pin_rays).largest;
  result.seconds = SecondsNow() - started;
  return result;
}

}  // namespace retarget::solver
