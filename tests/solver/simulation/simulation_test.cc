// The forward simulation: what it must do in scenes whose outcome is known beforehand.
#include "solver/simulation/simulation.h"

#include <gtest/gtest.h>

#include <map>

#include "model/body/path.h"
#include "model/geometry/polyline.h"
#include "model/geometry/so3.h"
#include "solver/retarget.h"
#include "solver/simulation/control.h"
#include "solver/simulation/swinging_feet.h"
#include "solver/simulation/tangle_force.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

// Two figures that stand on the floor, far apart, nothing between them.
Scene StandingApart(int frames) {
  Scene scene;
  scene.body = {StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.70))};
  scene.posture.body = scene.body;
  for (int f = 0; f < 2; ++f) {
    const Body& body = scene.body[f];
    Pose pose = RestPose(body);
    for (const double x : {1.0, -1.0}) {
      pose.rotation[body.FindLink(x > 0 ? "left_shoulder" : "right_shoulder")] =
          Turn(0, 0, -70 * x);
    }
    double lowest = 0;
    const PosedBody posed = PoseBody(body, pose);
    for (size_t n = 0; n < posed.node.size(); ++n) {
      lowest = std::min(lowest, posed.node[n].y() - body.nodes[n].radius);
    }
    pose.root_position = Vec3(2.0 * f, -lowest, 0);
    scene.posture.pose[f] = pose;
    scene.source[f].frames.assign(static_cast<size_t>(frames), pose);
    for (const char* node : {"left_toe", "left_ankle", "right_toe", "right_ankle"}) {
      scene.contacts[f].push_back({body.FindNode(node), 0, frames - 1});
    }
  }
  return scene;
}

double LargestMove(const Scene& scene, const SimulationResult& result, int from, int to) {
  double largest = 0;
  for (int f = 0; f < 2; ++f) {
    const PosedBody p = PoseBody(scene.body[f], result.motion[f].frames[from]);
    const PosedBody q = PoseBody(scene.body[f], result.motion[f].frames[to]);
    for (size_t n = 0; n < p.node.size(); ++n) {
      largest = std::max(largest, (p.node[n] - q.node[n]).norm());
    }
  }
  return largest;
}

TEST(Simulation, AStandingFigureComesToRestAndStays) {
  const Scene scene = StandingApart(60);
  const SimulationResult result = Simulate(scene, {});
  EXPECT_EQ(result.status, SimulationStatus::kCompleted) << result.message;
  EXPECT_TRUE(result.settled);
  EXPECT_LT(result.settle_distance_m, 0.05) << "gravity bends it a little";
  EXPECT_EQ(result.frames_simulated, 60);
  EXPECT_LT(LargestMove(scene, result, 0, 59), 0.01);
}

TEST(Simulation, StiffControlTracksASlowClipWithinThreeDegrees) {
  Scene scene = StandingApart(60);
  for (int f = 0; f < 2; ++f) {
    scene.contacts[f].clear();
    scene.source[f] = Fidget(scene.body[f], scene.posture.pose[f], 60, 30, 11 + f, 0.15);
    for (Pose& pose : scene.source[f].frames) pose.root_position.y() += 0.5;  // no floor to kick
    scene.posture.pose[f] = scene.source[f].frames[0];
  }
  SimulationSettings settings;
  settings.stiffness = 3000;
  settings.root_turn_stiffness = 6000;
  settings.root_stiffness = 30000;
  const SimulationResult result = Simulate(scene, settings);
  ASSERT_EQ(result.status, SimulationStatus::kCompleted) << result.message;
  double worst = 0, travel = 0;
  for (int t = 0; t < 60; ++t) {
    for (int f = 0; f < 2; ++f) {
      const Pose &want = scene.source[f].frames[t], &got = result.motion[f].frames[t];
      for (size_t l = 0; l < want.rotation.size(); ++l) {
        worst = std::max(worst, LogSo3(want.rotation[l].conjugate() * got.rotation[l]).norm());
        travel = std::max(
            travel,
            LogSo3(want.rotation[l].conjugate() * scene.source[f].frames[0].rotation[l]).norm());
      }
    }
  }
  EXPECT_GT(travel, 10 * kDegree) << "the clip moves";
  EXPECT_LT(worst, 3 * kDegree);
}

TEST(Simulation, HoldsKeepToACentimetreAndPlantedFeetStay) {
  Scene scene = SmallScene(45, 0.15);
  scene.holds.resize(1);  // the hands; the other one begins 3 cm off
  scene.holds[0].relative_rotation = Quat::Identity();
  scene.holds[0].rotation = false;
  for (auto& contacts : scene.contacts) {
    for (Contact& c : contacts) c.first = 0, c.last = 44;
  }
  const SimulationResult result = Simulate(scene, {});
  ASSERT_EQ(result.status, SimulationStatus::kCompleted) << result.message;
  std::array<std::vector<Vec3>, 2> stood;
  for (int t = 0; t < 45; ++t) {
    std::array<PosedBody, 2> posed;
    for (int f = 0; f < 2; ++f) posed[f] = PoseBody(scene.body[f], result.motion[f].frames[t]);
    const Vec3 gap = HoldPosition(scene.holds[0].from, scene.body, posed) -
                     HoldPosition(scene.holds[0].to, scene.body, posed);
    EXPECT_LT(gap.norm(), 0.01) << "frame " << t;
    for (int f = 0; f < 2; ++f) {
      for (size_t k = 0; k < scene.contacts[f].size(); ++k) {
        const Vec3 foot = posed[f].node[scene.contacts[f][k].node];
        if (t == 0) stood[f].push_back(foot);
        EXPECT_LT((foot - stood[f][k]).norm(), 0.01) << "frame " << t;
      }
    }
  }
}

// Nothing under their feet: the root hangs by its control alone, and its weight does not pull it
// off the clip's height.
TEST(Simulation, RootsKeepTheHeightOfTheirClips) {
  Scene scene = StandingApart(30);
  for (int f = 0; f < 2; ++f) {
    scene.contacts[f].clear();
    scene.posture.pose[f].root_position.y() += 0.5;
    for (Pose& pose : scene.source[f].frames) pose.root_position.y() += 0.5;
  }
  const auto sag = [&](const SimulationSettings& settings) {
    const SimulationResult result = Simulate(scene, settings);
    double largest = 0;
    for (int f = 0; f < 2; ++f) {
      for (int t = 0; t < 30; ++t) {
        largest = std::max(largest, scene.source[f].frames[t].root_position.y() -
                                        result.motion[f].frames[t].root_position.y());
      }
    }
    return largest;
  };
  EXPECT_LT(sag({}), 0.01);
  SimulationSettings soft;
  soft.root_height_stiffness = soft.root_stiffness;
  EXPECT_GT(sag(soft), 0.04) << "the test has something to keep";
}

// A figure without control sinks, as fast as its roots' damping lets it: its feet stop it on the
// floor where the clip's stand on it, and go through where the clip's are lifted.
TEST(Simulation, SwingingFeetDoNotCatchOnTheFloor) {
  const Scene standing = StandingApart(2);
  const Body& body = standing.body[0];
  const int ankle = body.FindNode("right_ankle"), toe = body.FindNode("right_toe");
  for (const double lift : {0.0, 0.05}) {
    Scene scene = standing;
    for (Pose& pose : scene.source[0].frames) pose.root_position.y() += lift;
    SimulationSettings settings;
    PhysicsOptions options;
    const Control control(scene, settings);
    PhysicsWorld world({control.FigureOf(0), control.FigureOf(1)}, {}, options);
    for (int f = 0; f < 2; ++f) world.SetPose(f, standing.posture.pose[f]);
    SwingingFeet(scene).Apply(0, 1, &world);
    for (int step = 0; step < 100; ++step) {
      world.BeginStep();
      world.EndStep();
    }
    world.UpdateKinematics();
    const PosedBody posed = world.Posed(0);
    const double lowest = std::min(posed.node[ankle].y() - body.nodes[ankle].radius,
                                   posed.node[toe].y() - body.nodes[toe].radius);
    const bool through = lowest<-0.015, lifted = lift> 0;
    EXPECT_EQ(through, lifted) << lowest;
  }
}

TEST(Simulation, TheSameTwice) {
  const Scene scene = SmallScene(20, 0.1);
  const SimulationResult one = Simulate(scene, {}), two = Simulate(scene, {});
  for (int f = 0; f < 2; ++f) {
    for (int t = 0; t < 20; ++t) {
      EXPECT_EQ(one.motion[f].frames[t].root_position, two.motion[f].frames[t].root_position);
      for (size_t l = 0; l < scene.body[f].links.size(); ++l) {
        EXPECT_EQ(one.motion[f].frames[t].rotation[l].coeffs(),
                  two.motion[f].frames[t].rotation[l].coeffs());
      }
    }
  }
}

// The template may lie anywhere in the clip: played backwards from there, a standing clip stands.
TEST(Simulation, PlaysBothWaysFromTheTemplate) {
  Scene scene = StandingApart(40);
  scene.template_frame = 25;
  for (int t = 0; t < 40; ++t) {
    const int chest = scene.body[0].FindLink("chest");
    scene.source[0].frames[t].rotation[chest] = Turn(0, t - 25, 0);
  }
  const SimulationResult result = Simulate(scene, {});
  ASSERT_EQ(result.status, SimulationStatus::kCompleted) << result.message;
  EXPECT_EQ(result.frames_simulated, 40);
  const int chest = scene.body[0].FindLink("chest");
  for (const int t : {0, 10, 25, 39}) {
    EXPECT_NEAR(YawOf(result.motion[0].frames[t].rotation[chest]) / kDegree, t - 25, 4);
  }
}

TEST(Simulation, DivergenceIsAResultAndNotAFault) {
  const Scene scene = SmallScene(20, 0.1);
  SimulationSettings settings;
  settings.stiffness = 1e6;
  settings.damping = 0;
  settings.armature = 0;
  settings.time_step = 0.02;
  const SimulationResult result = Simulate(scene, settings);
  EXPECT_EQ(result.status, SimulationStatus::kDiverged);
  EXPECT_FALSE(result.message.empty());
  for (int f = 0; f < 2; ++f) {
    ASSERT_EQ(result.motion[f].num_frames(), 20);
    for (const Pose& pose : result.motion[f].frames) {
      EXPECT_TRUE(pose.root_position.allFinite());
      for (const Quat& q : pose.rotation) EXPECT_NEAR(q.norm(), 1, 1e-9);
    }
  }
}

TEST(Simulation, WithoutControlTheFiguresFall) {
  Scene scene = StandingApart(60);
  for (auto& contacts : scene.contacts) contacts.clear();
  SimulationSettings settings;
  settings.stiffness = settings.root_stiffness = settings.root_turn_stiffness = 0;
  settings.root_height_stiffness = 0;
  settings.settle_max_s = 0;
  const SimulationResult result = Simulate(scene, settings);
  EXPECT_EQ(result.status, SimulationStatus::kFell);
  EXPECT_LT(result.frames_simulated, 60);
  EXPECT_NE(result.message.find("fell at frame"), std::string::npos) << result.message;
}

// The control pulls a standing figure along its clip, but its feet are nailed to the floor for
// good.
TEST(Simulation, AFigureThatCannotFollowItsMotionHasStrayed) {
  Scene scene = StandingApart(60);
  for (int t = 0; t < 60; ++t) scene.source[1].frames[t].root_position.z() += 0.04 * t;
  const SimulationResult result = Simulate(scene, {});
  EXPECT_EQ(result.status, SimulationStatus::kTrackingLost) << result.message;
  EXPECT_EQ(result.frames_simulated, 60);
  EXPECT_NE(result.message.find("b strayed"), std::string::npos) << result.message;
  scene.contacts[1].clear();
  EXPECT_EQ(Simulate(scene, {}).status, SimulationStatus::kCompleted);
}

TEST(Simulation, ALostTangleIsSaid) {
  Scene scene = SmallScene(45, 0.05);
  ASSERT_FALSE(scene.tangles.empty());
  scene.holds.clear();
  for (auto& contacts : scene.contacts) contacts.clear();
  // b rises out of a's arms.
  for (int t = 0; t < 45; ++t) scene.source[1].frames[t].root_position.y() += 0.06 * t;
  SimulationSettings settings;
  settings.tangle_stiffness = 0;
  const SimulationResult result = Simulate(scene, settings);
  EXPECT_EQ(result.status, SimulationStatus::kLostTangle) << result.message;
  EXPECT_NE(result.message.find("it lost the tag a ("), std::string::npos) << result.message;
}

// a's left arm sweeps back to where b's right arm hangs. Hard contacts stop it; soft ones do not.
TEST(Simulation, ALimbThatGoesThroughAnotherIsSaid) {
  Scene scene = StandingApart(45);
  for (int f = 0; f < 2; ++f) {
    scene.posture.pose[f].root_position.x() = 0.9 * f;
    scene.source[f].frames.assign(45, scene.posture.pose[f]);
  }
  const int shoulder = scene.body[0].FindLink("left_shoulder");
  for (int t = 0; t < 45; ++t) {
    const double swept = std::clamp((t - 10) / 20.0, 0.0, 1.0);
    scene.source[0].frames[t].rotation[shoulder] = Turn(0, -50 + 110 * swept, 0) * Turn(0, 0, -30);
  }
  scene.posture.pose[0] = scene.source[0].frames[0];
  SimulationSettings settings;
  EXPECT_EQ(Simulate(scene, settings).status, SimulationStatus::kCompleted);
  settings.contact_time = 0.2;
  const SimulationResult result = Simulate(scene, settings);
  EXPECT_EQ(result.status, SimulationStatus::kPassedThrough) << result.message;
  EXPECT_NE(result.message.find("of a went through right_"), std::string::npos) << result.message;
}

// Both kinds of force act between the figures alone, and the second one points where the tag grows.
TEST(TangleForce, PullsEquallyAndOppositely) {
  Scene scene = SmallScene(2, 0.1);
  ASSERT_FALSE(scene.tangles.empty());
  for (const TangleForceKind kind : {TangleForceKind::kElastic, TangleForceKind::kGli}) {
    SimulationSettings settings;
    settings.tangle_force = kind;
    for (TangleTarget& held : scene.tangles) held.target = 2;  // never reached
    PhysicsOptions options;
    options.gravity = 0;
    options.time_step = 2.5e-4;
    options.floor = options.collide = false;
    std::vector<PhysicsFigure> figures;
    for (const Body& body : scene.body) {
      figures.push_back({body, std::vector<double>(body.links.size(), 0), 0});
    }
    PhysicsWorld world(figures, {}, options);
    std::array<PosedBody, 2> posed;
    for (int f = 0; f < 2; ++f) world.SetPose(f, scene.posture.pose[f]);
    const TangleForce force(scene, settings);
    const auto gli = [&] {
      double sum = 0;
      for (const TangleTarget& held : scene.tangles) {
        sum += held.sign *
               PolylineGli(PointsOn(posed[0].node, NodesOn(scene.body[0], held.tag.tangle.a)),
                           PointsOn(posed[1].node, NodesOn(scene.body[1], held.tag.tangle.b)));
      }
      return sum;
    };
    double before = 0;
    for (int k = 0; k < 40; ++k) {
      world.BeginStep();
      for (int f = 0; f < 2; ++f) posed[f] = world.Posed(f);
      if (k == 0) before = gli();
      force.Apply(posed, &world);
      world.EndStep();
    }
    world.BeginStep();
    for (int f = 0; f < 2; ++f) posed[f] = world.Posed(f);
    EXPECT_GT(world.RootVelocity(0).norm() + world.RootVelocity(1).norm(), 1e-3) << NameOf(kind);
    EXPECT_LT(world.LinearMomentum().norm(), 0.05)
        << NameOf(kind) << ", kg m/s, after 10 ms of 100 N";
    if (kind == TangleForceKind::kGli) {
      EXPECT_GT(gli(), before);
    }
  }
}

RetargetInput SmallJob(int frames) {
  const Scene scene = SmallScene(frames, 0.1);
  return {scene.body, scene.source, scene.posture, 0};
}

TEST(Start, ASimulationThatFailsIsReplacedByTheTemplateAndSaidSo) {
  Settings settings;
  settings.simulation.stiffness = 1e6;
  settings.simulation.damping = settings.simulation.armature = 0;
  settings.simulation.time_step = 0.02;
  const RetargetResult result = Retarget(SmallJob(20), settings, nullptr);
  EXPECT_EQ(result.simulation.status, SimulationStatus::kDiverged);
  EXPECT_EQ(result.start.used, Start::kTemplate);
  EXPECT_NE(result.start.reason.find(result.simulation.message), std::string::npos);
  EXPECT_EQ(result.solve.status, SolveStatus::kConverged);
  EXPECT_FALSE(result.start.simulated_cost.has_value());
}

TEST(Start, BestTakesTheCheaperOfBoth) {
  Settings settings;
  std::map<Start, RetargetResult> result;
  for (const Start start : {Start::kSimulated, Start::kTemplate, Start::kBest}) {
    settings.solve.start = start;
    result[start] = Retarget(SmallJob(20), settings, nullptr);
    EXPECT_EQ(result[start].start.requested, start);
  }
  EXPECT_EQ(result[Start::kSimulated].start.used, Start::kSimulated);
  EXPECT_EQ(result[Start::kTemplate].start.used, Start::kTemplate);
  EXPECT_EQ(result[Start::kBest].start.simulated_cost, result[Start::kSimulated].solve.cost);
  EXPECT_EQ(result[Start::kBest].start.template_cost, result[Start::kTemplate].solve.cost);
  EXPECT_EQ(result[Start::kBest].solve.cost,
            std::min(result[Start::kSimulated].solve.cost, result[Start::kTemplate].solve.cost));
}

}  // namespace
}  // namespace retarget::solver
