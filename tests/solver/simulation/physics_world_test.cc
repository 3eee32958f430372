// The physics against closed forms and conservation laws.
#include "solver/simulation/physics_world.h"

#include <gtest/gtest.h>

#include <random>

#include "model/geometry/so3.h"

namespace retarget::solver {
namespace {

PhysicsFigure Undamped(const Body& body) {
  return {body, std::vector<double>(body.links.size(), 0), 0};
}

// One rigid capsule: a root link with a single segment along +X.
Body Rod(double length, double radius, double mass) {
  Body body;
  body.stature = length;
  body.links.emplace_back().name = "root";
  body.nodes.emplace_back().name = "root";
  Node tip;
  tip.name = "tip";
  tip.parent = 0;
  tip.offset = Vec3(length, 0, 0);
  tip.radius = radius;
  tip.mass = mass;
  body.nodes.push_back(tip);
  return body;
}

Pose RandomPose(const Body& body, std::mt19937* random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Pose pose = RestPose(body);
  pose.root_position = Vec3(uniform(*random), uniform(*random), uniform(*random));
  for (Quat& q : pose.rotation) {
    q = ExpSo3(Vec3(uniform(*random), uniform(*random), uniform(*random)));
  }
  return pose;
}

std::vector<Vec3> RandomVelocities(const Body& body, std::mt19937* random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vec3> velocity;
  for (int l = 0; l < body.num_links(); ++l) {
    velocity.emplace_back(uniform(*random), uniform(*random), uniform(*random));
  }
  return velocity;
}

void Step(PhysicsWorld* world) {
  world->BeginStep();
  world->EndStep();
}

TEST(PhysicsWorld, ForwardKinematicsIsOurs) {
  std::mt19937 random(1);
  const std::vector<Body> bodies = {StandardBody(AverageMeasures(1.8)),
                                    StandardBody(AverageMeasures(1.5))};
  PhysicsWorld world({Undamped(bodies[0]), Undamped(bodies[1])}, {}, {});
  for (int trial = 0; trial < 20; ++trial) {
    for (int f = 0; f < 2; ++f) {
      const Pose pose = RandomPose(bodies[f], &random, 3);
      world.SetPose(f, pose);
      world.UpdateKinematics();
      const PosedBody ours = PoseBody(bodies[f], pose), theirs = world.Posed(f);
      for (size_t n = 0; n < ours.node.size(); ++n) {
        EXPECT_LT((ours.node[n] - theirs.node[n]).norm(), 1e-10);
      }
      for (size_t l = 0; l < ours.centre.size(); ++l) {
        EXPECT_LT((ours.centre[l] - theirs.centre[l]).norm(), 1e-10);
        EXPECT_LT((ours.rotation[l] - theirs.rotation[l]).norm(), 1e-10);
      }
    }
  }
}

TEST(PhysicsWorld, MassIsThatOfTheBody) {
  const Body body = StandardBody(AverageMeasures(1.75));
  double mass = 0;
  for (const Node& node : body.nodes) mass += node.mass;
  EXPECT_NEAR(PhysicsWorld({Undamped(body)}, {}, {}).Mass(), mass, 1e-9);
}

// y(t) = y0 - g t^2 / 2. The symplectic Euler step adds g h t / 2.
TEST(PhysicsWorld, AFigureFallsFreely) {
  PhysicsOptions options;
  options.floor = false;
  const Body body = StandardBody(AverageMeasures(1.8));
  PhysicsWorld world({Undamped(body)}, {}, options);
  const Pose start = RestPose(body);
  world.SetPose(0, start);
  const int steps = 250;
  for (int k = 0; k < steps; ++k) Step(&world);
  const double t = steps * world.time_step();
  const Pose end = world.PoseOf(0);
  EXPECT_NEAR(world.RootVelocity(0).y(), -9.81 * t, 1e-9);
  EXPECT_NEAR(end.root_position.y(), -9.81 * t * (t + world.time_step()) / 2, 1e-8);
  EXPECT_NEAR(end.root_position.head<1>().norm() + std::abs(end.root_position.z()), 0, 1e-9);
  for (size_t l = 0; l < end.rotation.size(); ++l) {
    EXPECT_LT(LogSo3(end.rotation[l]).norm(), 1e-6) << "nothing turns in free fall";
  }
}

// A rod that hangs by its end: T = 2 pi sqrt(I / (m g d)) for small swings, I of a solid capsule
// about its end from its cylinder and its two half balls.
TEST(PhysicsWorld, ARodSwingsAsAPendulum) {
  const double length = 0.8, r = 0.05, mass = 3, g = 9.81;
  const double cylinder = length, ball = 4.0 / 3 * r;  // volumes over pi r^2
  const double mc = mass * cylinder / (cylinder + ball), mb = mass - mc;
  const double about_centre = mc * (length * length / 12 + r * r / 4) +
                              mb * (0.4 * r * r + length * length / 4 + 3.0 / 8 * length * r);
  const double inertia = about_centre + mass * length * length / 4;
  const double period = 2 * kPi * std::sqrt(inertia / (mass * g * length / 2));

  PhysicsOptions options;
  options.floor = false;
  options.time_step = 1e-3;
  options.tie_time = 2e-3;
  PhysicsWorld world({Undamped(Rod(length, r, mass))}, {EqualityConstraint{}}, options);
  Pose pose;
  const double swing = 0.05;
  pose.rotation = {ExpSo3(Vec3(0, 0, -kPi / 2 + swing))};
  world.SetPose(0, pose);
  world.EnableEquality(0, Vec3::Zero(), Vec3::Zero());
  std::vector<double> crossings;
  double before = swing;
  for (int k = 1; crossings.size() < 9 && k < 20000; ++k) {
    Step(&world);
    const Vec3 tip = world.PoseOf(0).rotation[0] * Vec3::UnitX();
    const double angle = std::atan2(tip.x(), -tip.y());
    if (angle * before < 0) {
      crossings.push_back((k - 1 + before / (before - angle)) * world.time_step());
    }
    before = angle;
    ASSERT_LT(world.PoseOf(0).root_position.norm(), 2e-3) << "the tie holds";
  }
  ASSERT_EQ(crossings.size(), 9u);
  EXPECT_NEAR((crossings.back() - crossings.front()) / 4, period, 0.005 * period);
}

// No force from outside: joint torques, damping, contacts between the figures and ties change
// neither momentum, up to the Euler step's error.
TEST(PhysicsWorld, MomentumIsConserved) {
  const std::vector<Body> bodies = {StandardBody(AverageMeasures(1.8)),
                                    StandardBody(AverageMeasures(1.6))};
  std::array<double, 2> drift;
  for (int k = 0; k < 2; ++k) {
    PhysicsOptions options;
    options.gravity = 0;
    options.floor = false;
    options.time_step = k == 0 ? 1e-3 : 2.5e-4;
    std::vector<PhysicsFigure> figures;
    for (const Body& body : bodies) {
      figures.push_back({body, std::vector<double>(body.links.size(), 2), 0});
      figures.back().damping[0] = 0;  // the root's is against the world
    }
    const EqualityConstraint tie{0, bodies[0].FindLink("left_wrist"), 1,
                                 bodies[1].FindLink("right_wrist"), false};
    PhysicsWorld world(figures, {tie}, options);
    std::mt19937 random(3);
    for (int f = 0; f < 2; ++f) {
      Pose pose = RandomPose(bodies[f], &random, 0.3);
      pose.root_position += Vec3(0, 0, 0.3 * f);
      world.SetPose(f, pose);
      world.SetVelocity(f, Vec3(0.5 - f, 0.2, 0.1), RandomVelocities(bodies[f], &random, 1));
    }
    // Fastened where they are: two points that a tie still draws together would turn the pair.
    world.UpdateKinematics();
    const PosedBody a = world.Posed(0), b = world.Posed(1);
    world.EnableEquality(
        0, Vec3::Zero(),
        b.rotation[tie.to_link].transpose() * (a.centre[tie.link] - b.centre[tie.to_link]));
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    const int steps = static_cast<int>(std::lround(0.3 / options.time_step));
    for (int s = 0; s <= steps; ++s) {
      world.BeginStep();
      if (s == 0) {
        linear = world.LinearMomentum();
        angular = world.AngularMomentum();
      }
      for (int l = 1; l < bodies[0].num_links(); ++l) {
        world.AddJointTorque(0, l, Vec3(1, -0.5, 0.3));
      }
      if (s == steps) break;
      world.EndStep();
    }
    ASSERT_TRUE(world.IsStable());
    EXPECT_GT(linear.norm(), 1) << "there is something to conserve";
    EXPECT_LT((world.LinearMomentum() - linear).norm(), 0.01 * linear.norm());
    drift[k] = (world.AngularMomentum() - angular).norm() / angular.norm();
  }
  EXPECT_LT(drift[0], 2e-3);
  EXPECT_LT(drift[1], drift[0]);
}

TEST(PhysicsWorld, EnergyDoesNotGrowWithoutControl) {
  const Body body = StandardBody(AverageMeasures(1.8));
  PhysicsFigure figure{body, std::vector<double>(body.links.size(), 3), 0};
  figure.damping[0] = 0;
  PhysicsWorld world({figure}, {}, {});
  Pose pose = RestPose(body);
  pose.root_position = Vec3(0, 1.1, 0);
  std::mt19937 random(5);
  world.SetPose(0, pose);
  world.SetVelocity(0, Vec3(1, 0, 0), RandomVelocities(body, &random, 1));
  double highest = 0, last = 0;
  for (int k = 0; k < 750; ++k) {
    world.BeginStep();
    last = world.Energy();
    if (k == 0) highest = last;
    ASSERT_LE(last, highest + 1e-3 * std::abs(highest)) << "step " << k;
    highest = std::min(highest, last + 5);  // soft contacts lend a little and give it back
    world.EndStep();
  }
  ASSERT_TRUE(world.IsStable());
  EXPECT_LT(last, 300) << "it fell to the floor: about 75 kg at rest less than 0.4 m high";
}

// A weld keeps place and relative turn of two links that are pulled apart and twisted.
TEST(PhysicsWorld, AWeldKeepsTheRelativeTurn) {
  PhysicsOptions options;
  options.floor = false;
  options.gravity = 0;
  options.collide = false;
  const EqualityConstraint tie{0, 0, 1, 0, true};
  PhysicsWorld world({Undamped(Rod(0.5, 0.05, 2)), Undamped(Rod(0.5, 0.05, 2))}, {tie}, options);
  const Quat first = ExpSo3(Vec3(0.2, -0.4, 0.1)), second = ExpSo3(Vec3(-0.3, 0.1, 0.5));
  const Quat relative = second.conjugate() * first;
  const Vec3 point(0.1, 0, 0), to_point(0.3, 0.02, 0.01);
  const Vec3 place(0.3, 0.2, 0.1);
  world.SetPose(0, {place - first * point, {first}});
  world.SetPose(1, {place - second * to_point, {second}});
  world.EnableEquality(0, point, to_point, relative);
  for (int k = 0; k < 250; ++k) {
    world.BeginStep();
    world.AddForce(0, 0, world.PoseOf(0).root_position, Vec3(3, 1, -2));
    world.AddTorque(1, 0, Vec3(0.2, 0.3, -0.1));
    world.EndStep();
  }
  const Pose a = world.PoseOf(0), b = world.PoseOf(1);
  EXPECT_GT((a.root_position - place).norm(), 0.1) << "it moved";
  EXPECT_LT(
      ((a.root_position + a.rotation[0] * point) - (b.root_position + b.rotation[0] * to_point))
          .norm(),
      2e-3);
  EXPECT_LT(LogSo3(relative.conjugate() * b.rotation[0].conjugate() * a.rotation[0]).norm(),
            1 * kDegree);
}

}  // namespace
}  // namespace retarget::solver
