// Posing by drags and pins, judged by distances and by crossings of limbs, not by residuals.
#include "solver/optimizer/pose_solve.h"

#include <gtest/gtest.h>

#include "model/body/joint_limit.h"
#include "model/body/shape.h"
#include "model/geometry/capsule.h"
#include "model/geometry/gli.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

PoseTask TaskOf(const TemplatePosture& posture) {
  PoseTask task;
  task.body = posture.body;
  task.before = posture.pose;
  task.holds = posture.holds;
  return task;
}

// Two figures that stand well apart.
TemplatePosture Apart() {
  TemplatePosture posture =
      RoughHug(StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.70)));
  posture.pose[1].root_position += Vec3(0, 0, 3);
  return posture;
}

Vec3 NodeAt(const PoseTask& task, const std::array<Pose, 2>& pose, int figure, int node) {
  return PoseBody(task.body[figure], pose[figure]).node[node];
}

void PinAnkles(PoseTask* task, int figure) {
  for (const char* name : {"left_ankle", "right_ankle"}) {
    const int node = task->body[figure].FindNode(name);
    task->pins.push_back({figure, node, NodeAt(*task, task->before, figure, node)});
  }
}

double DeepestSelf(const Body& body, const PosedBody& posed) {
  double deepest = 0;
  for (const auto& [i, j] : SelfPairs(body)) {
    const ClosestPoints closest =
        ClosestPointsOfSegments(posed.node[body.nodes[i].parent], posed.node[i],
                                posed.node[body.nodes[j].parent], posed.node[j]);
    deepest = std::max(deepest, CapsuleDepth(closest, body.nodes[i].radius, body.nodes[j].radius));
  }
  return deepest;
}

double DeepestBetween(const PoseTask& task, const std::array<Pose, 2>& pose) {
  const PosedBody a = PoseBody(task.body[0], pose[0]), b = PoseBody(task.body[1], pose[1]);
  double deepest = 0;
  for (int i = 1; i < task.body[0].num_nodes(); ++i) {
    for (int j = 1; j < task.body[1].num_nodes(); ++j) {
      const Node &m = task.body[0].nodes[i], &n = task.body[1].nodes[j];
      const ClosestPoints closest =
          ClosestPointsOfSegments(a.node[m.parent], a.node[i], b.node[n.parent], b.node[j]);
      deepest = std::max(deepest, CapsuleDepth(closest, m.radius, n.radius));
    }
  }
  return deepest;
}

double FurthestBeyondLimits(const Body& body, const Pose& pose) {
  double furthest = 0;
  for (int l = 1; l < body.num_links(); ++l) {
    furthest = std::max(furthest, FurthestBeyondLimit(body, l, pose));
  }
  return furthest;
}

// A pose of the figure with one arm turned at random, within its limits and clear of the trunk.
Pose RandomArm(const Body& body, const Pose& pose, const std::string& side, std::mt19937* random) {
  std::normal_distribution<double> normal;
  for (;;) {
    Pose p = pose;
    for (const auto& [joint, size] : {std::pair("_shoulder", 0.7), std::pair("_elbow", 0.6)}) {
      const int l = body.FindLink(side + joint);
      Vec3 v;
      for (int k = 0; k < 3; ++k) v[k] = size * normal(*random);
      p.rotation[l] = p.rotation[l] * ExpSo3(v);
    }
    if (FurthestBeyondLimits(body, p) < FurthestBeyondLimits(body, pose) + 1e-9 &&
        DeepestSelf(body, PoseBody(body, p)) < 1e-3) {
      return p;
    }
  }
}

TEST(PoseSolve, ReachesWhatAnArmCanReachAndPinsStay) {
  std::mt19937 random(11);
  int far = 0;
  for (int k = 0; k < 60; ++k) {
    const TemplatePosture posture = Apart();
    PoseTask task = TaskOf(posture);
    const int figure = k % 2;
    const std::string side = k % 4 < 2 ? "left" : "right";
    const int hand = task.body[figure].FindNode(side + "_hand");
    const Pose reached = RandomArm(task.body[figure], posture.pose[figure], side, &random);
    const Vec3 target = PoseBody(task.body[figure], reached).node[hand];
    far += (target - NodeAt(task, task.before, figure, hand)).norm() > 0.2;
    task.drags = {{figure, hand, target}};
    PinAnkles(&task, figure);
    const PoseResult result = SolvePose(task, task.before, DefaultPoseSettings());
    EXPECT_LT((NodeAt(task, result.pose, figure, hand) - target).norm(), 0.01) << k;
    EXPECT_NEAR((NodeAt(task, result.pose, figure, hand) - target).norm(), result.drag_error_m,
                1e-9);
    for (const NodeTarget& pin : task.pins) {
      EXPECT_LT((NodeAt(task, result.pose, pin.figure, pin.node) - pin.position).norm(), 0.005);
    }
    EXPECT_LT(DeepestSelf(task.body[figure], PoseBody(task.body[figure], result.pose[figure])),
              0.005)
        << k;
    EXPECT_LT(FurthestBeyondLimits(task.body[figure], result.pose[figure]), 0.05) << k;
  }
  EXPECT_GT(far, 20);
}

TEST(PoseSolve, AnUnreachableTargetIsApproachedAsFarAsTheArmAllows) {
  for (const Vec3& away : {Vec3(3, 0, 0), Vec3(0, 2, 1), Vec3(1, 0, 2), Vec3(500, 0, 500)}) {
    PoseTask task = TaskOf(Apart());
    task.before[0].root_position.y() += 0.3;  // clear of the floor
    Body& body = task.body[0];
    // The arm alone may move.
    for (Link& link : body.links) {
      link.locked =
          link.name != "left_shoulder" && link.name != "left_elbow" && link.name != "left_wrist";
    }
    const int hand = body.FindNode("left_hand"), shoulder = body.FindNode("left_shoulder");
    task.pins = {{0, 0, task.before[0].root_position}};
    const Vec3 centre = NodeAt(task, task.before, 0, shoulder);
    const double length = body.SegmentLength(body.FindNode("left_elbow")) +
                          body.SegmentLength(body.FindNode("left_wrist")) +
                          body.SegmentLength(hand);
    task.drags = {{0, hand, centre + away}};
    const PoseResult result = SolvePose(task, task.before, DefaultPoseSettings());
    for (const Quat& q : result.pose[0].rotation) ASSERT_TRUE(q.coeffs().allFinite());
    const Vec3 at = NodeAt(task, result.pose, 0, hand);
    EXPECT_LT((at - centre - length * away.normalized()).norm(), 0.15);
    EXPECT_LT((at - centre - away).norm(), away.norm() - length + 0.01);
    EXPECT_LT((NodeAt(task, result.pose, 0, 0) - task.before[0].root_position).norm(), 0.005);
    EXPECT_LT(FurthestBeyondLimits(body, result.pose[0]), 0.05);
  }
}

TEST(PoseSolve, ARayIsMetSomewhereOnItsLine) {
  PoseTask task = TaskOf(Apart());
  const int wrist = task.body[0].FindNode("right_wrist");
  const Vec3 at = NodeAt(task, task.before, 0, wrist) + Vec3(-0.1, 0.2, 0.05);
  NodeRay ray{0, wrist, at + 7 * Vec3(0.3, -0.2, 1), Vec3(0.3, -0.2, 1)};
  task.drag_rays = {ray};
  PinAnkles(&task, 0);
  const PoseResult result = SolvePose(task, task.before, DefaultPoseSettings());
  const Vec3 from = NodeAt(task, result.pose, 0, wrist) - at;
  EXPECT_LT(from.cross(Vec3(0.3, -0.2, 1).normalized()).norm(), 0.01);
  EXPECT_LT(result.drag_error_m, 0.01);
  EXPECT_TRUE(result.converged);
}

TEST(PoseSolve, WithinAHugHoldsStayAndNothingOverlaps) {
  TemplatePosture posture =
      RoughHug(StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.70)));
  PoseTask task = TaskOf(posture);
  task.holds.push_back({{0, task.body[0].FindNode("left_hand"), Vec3::Zero()},
                        {0, task.body[0].FindNode("right_wrist"), Vec3(0, 0, 0.07)}});
  for (const int f : {0, 1}) PinAnkles(&task, f);
  const PoseSettings settings = DefaultPoseSettings();
  const PoseResult settled = SolvePose(task, task.before, settings);
  task.before = settled.pose;
  const int head = task.body[1].FindNode("head_top");
  task.drags = {{1, head, NodeAt(task, task.before, 1, head) + Vec3(0.15, -0.08, 0.05)}};
  const PoseResult result = SolvePose(task, task.before, settings);
  EXPECT_LT(result.drag_error_m, 0.01);
  EXPECT_LT(result.pin_error_m, 0.005);
  EXPECT_LT(DeepestBetween(task, result.pose), 0.005);
  const std::array<PosedBody, 2> posed = {PoseBody(task.body[0], result.pose[0]),
                                          PoseBody(task.body[1], result.pose[1])};
  const Hold& hold = task.holds[0];
  EXPECT_LT(
      (HoldPosition(hold.from, task.body, posed) - HoldPosition(hold.to, task.body, posed)).norm(),
      0.005);
}

// Whether segments p->q and r->s cross on the way from one posture to another a short step away:
// the volume of their four ends changes its sign while they lie across each other.
bool Crosses(const std::array<Vec3, 4>& before, const std::array<Vec3, 4>& after) {
  const auto volume = [](const std::array<Vec3, 4>& x) {
    return (x[1] - x[0]).cross(x[3] - x[2]).dot(x[2] - x[0]);
  };
  if (volume(before) * volume(after) >= 0) return false;
  const ClosestPoints closest = ClosestPointsOfSegments(after[0], after[1], after[2], after[3]);
  return closest.s > 0.02 && closest.s < 0.98 && closest.t > 0.02 && closest.t < 0.98 &&
         closest.distance < 0.05;
}

int Crossings(const PoseTask& task, const std::array<Pose, 2>& before,
              const std::array<Pose, 2>& after, int f, int g) {
  const Body &p = task.body[f], &q = task.body[g];
  const PosedBody p0 = PoseBody(p, before[f]), q0 = PoseBody(q, before[g]);
  const PosedBody p1 = PoseBody(p, after[f]), q1 = PoseBody(q, after[g]);
  int crossings = 0;
  for (int i = 1; i < p.num_nodes(); ++i) {
    for (int j = 1; j < q.num_nodes(); ++j) {
      const int pi = p.nodes[i].parent, qj = q.nodes[j].parent;
      if (f == g && (i <= j || i == qj || j == pi || pi == qj)) continue;
      crossings += Crosses({p0.node[pi], p0.node[i], q0.node[qj], q0.node[j]},
                           {p1.node[pi], p1.node[i], q1.node[qj], q1.node[j]});
    }
  }
  return crossings;
}

TEST(PoseSolve, NoDragTakesALimbThroughALimb) {
  // With and without the penetration terms: the guard alone must do.
  for (const bool contacts : {true, false}) {
    PoseSettings settings = DefaultPoseSettings();
    settings.max_iterations = 12;
    if (!contacts) {
      settings.settings.weights.penetration = settings.settings.weights.self_penetration = 0;
    }
    TemplatePosture posture = Apart();
    posture.pose[1].root_position -= Vec3(0, 0, 2.45);  // a's hands before b's back
    struct Path {
      int node;
      Vec3 way;
      bool own;  // through its own body
    };
    const Body& a = posture.body[0];
    const Path paths[] = {{a.FindNode("left_hand"), Vec3(0, 0, 0.9), false},
                          {a.FindNode("right_hand"), Vec3(0.1, 0.1, 0.8), false},
                          {a.FindNode("left_hand"), Vec3(-0.5, -0.2, -0.7), true},
                          {a.FindNode("right_wrist"), Vec3(0.9, 0, -0.2), true}};
    for (const Path& path : paths) {
      PoseTask task = TaskOf(posture);
      for (const int f : {0, 1}) PinAnkles(&task, f);
      for (const int f : {0, 1}) {
        task.pins.push_back({f, 0, task.before[f].root_position});
      }
      const Vec3 first = NodeAt(task, task.before, 0, path.node);
      std::array<Pose, 2> pose = task.before;
      int crossings = 0;
      for (int k = 1; k <= 50; ++k) {
        task.drags = {{0, path.node, first + k / 50.0 * path.way}};
        const std::array<Pose, 2> next = SolvePose(task, pose, settings).pose;
        crossings += Crossings(task, pose, next, 0, 1) + Crossings(task, pose, next, 0, 0);
        pose = next;
      }
      EXPECT_EQ(crossings, 0) << contacts << " " << path.way.transpose();
      EXPECT_GT((NodeAt(task, pose, 0, path.node) - first).norm(), 0.02);
    }
  }
}

TEST(PoseSolve, WithoutAnythingToDoNothingMoves) {
  TemplatePosture posture = Apart();
  for (Pose& pose : posture.pose) pose.root_position.y() += 0.3;  // clear of the floor
  const PoseTask task = TaskOf(posture);
  const PoseResult result = SolvePose(task, task.before, DefaultPoseSettings());
  for (int f = 0; f < 2; ++f) {
    EXPECT_LT((result.pose[f].root_position - task.before[f].root_position).norm(), 1e-9);
    for (size_t l = 0; l < task.before[f].rotation.size(); ++l) {
      EXPECT_LT(result.pose[f].rotation[l].angularDistance(task.before[f].rotation[l]), 1e-7);
    }
  }
}

}  // namespace
}  // namespace retarget::solver
