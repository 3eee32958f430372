// Properties of the whole solve: both back ends reach the same minimum, tracking alone returns the
// source, a mirrored or exchanged scene gives the mirrored or exchanged result.
#include "solver/optimizer/spacetime.h"

#include <gtest/gtest.h>

#include "model/body/pass_through.h"
#include "solver/start/start.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

Settings Tight() {
  Settings settings;
  settings.solve.threads = 2;
  settings.solve.max_iterations = 600;
  settings.solve.relative_decrease = 1e-3;
  settings.solve.polish_decrease = 1e-7;
  return settings;
}

// From the start of the real pipeline: near enough that both back ends go down into one basin.
SolveResult SolveFromStart(const Scene& scene, const Settings& settings) {
  const Problem problem(scene, settings);
  return SolveSpacetime(problem, TemplateStart(problem), nullptr);
}

SolveResult SolveFromSource(const Scene& scene, const Settings& settings) {
  const Problem problem(scene, settings);
  return SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
}

TEST(Spacetime, BothBackEndsReachTheSameMinimum) {
  for (const bool follow : {false, true}) {
    const Scene scene = SmallScene(12, 0.1, follow);
    Settings settings = Tight();
    settings.solve.backend = Backend::kBanded;
    const SolveResult banded = SolveFromStart(scene, settings);
    settings.solve.backend = Backend::kCeres;
    const SolveResult ceres = SolveFromStart(scene, settings);
    EXPECT_GT(banded.initial_cost, banded.cost);
    EXPECT_EQ(banded.initial_cost, ceres.initial_cost);
    EXPECT_NEAR(banded.cost / ceres.cost, 1, 1e-3);
    EXPECT_LT((banded.unknowns.edit - ceres.unknowns.edit).cwiseAbs().maxCoeff(), 0.02);
  }
}

TEST(Spacetime, TrackingAloneReturnsTheSource) {
  Scene scene = SmallScene(9, 0.1);
  // Apart, so that no limb stands in a limb's way back.
  for (Pose& pose : scene.source[1].frames) pose.root_position.z() += 3;
  Settings settings = Tight();
  settings.weights.foot_lock = settings.weights.foot_swing = settings.weights.hold = 0;
  settings.weights.penetration = 0;
  settings.weights.self_penetration = settings.weights.ground = 0;
  settings.weights.tangle = settings.weights.tangle_aim = 0;
  settings.weights.joint_limit = 0;
  const Problem problem(scene, settings);
  Unknowns start = UnknownsFromPoses(scene, scene.source);
  std::mt19937 random(5);
  start.edit = 0.02 * RandomMatrix(start.edit.rows(), start.edit.cols(), &random);
  const SolveResult result = SolveSpacetime(problem, start, nullptr);
  EXPECT_LT(result.unknowns.edit.cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Spacetime, EqualRunsAreEqual) {
  const Scene scene = SmallScene(10, 0.1);
  for (const Backend backend : {Backend::kBanded, Backend::kCeres}) {
    Settings settings = Tight();
    settings.solve.backend = backend;
    settings.solve.max_iterations = 12;
    const SolveResult first = SolveFromSource(scene, settings);
    const SolveResult second = SolveFromSource(scene, settings);
    EXPECT_EQ(first.unknowns.edit, second.unknowns.edit) << NameOf(backend);
    EXPECT_EQ(first.cost, second.cost) << NameOf(backend);
  }
}

// Reflection in the plane x = 0: left and right change places.
struct Mirror {
  explicit Mirror(const Body& body) {
    const auto other = [](std::string name) {
      if (name.starts_with("left_")) return "right_" + name.substr(5);
      if (name.starts_with("right_")) return "left_" + name.substr(6);
      return name;
    };
    for (const Link& l : body.links) link.push_back(body.FindLink(other(l.name)));
    for (const Node& n : body.nodes) node.push_back(body.FindNode(other(n.name)));
  }
  std::vector<int> link, node;

  static Vec3 Point(const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); }
  static Quat Rotation(const Quat& q) { return Quat(q.w(), q.x(), -q.y(), -q.z()); }
  Pose operator()(const Pose& pose) const {
    Pose out = pose;
    out.root_position = Point(pose.root_position);
    for (size_t l = 0; l < link.size(); ++l) {
      out.rotation[link[l]] = Rotation(pose.rotation[l]);
    }
    return out;
  }
};

Scene Mirrored(const Scene& scene) {
  Scene out = scene;
  for (int f = 0; f < 2; ++f) {
    const Mirror mirror(scene.body[f]);
    for (Pose& pose : out.source[f].frames) pose = mirror(pose);
    out.posture.pose[f] = mirror(scene.posture.pose[f]);
    for (Contact& contact : out.contacts[f]) contact.node = mirror.node[contact.node];
  }
  for (TangleTarget& held : out.tangles) {
    const auto path = [](const Mirror& mirror, const Path& p) {
      const int u = mirror.node[p.from], v = mirror.node[p.to];
      return Path{std::min(u, v), std::max(u, v)};
    };
    const auto swapped = [](const Mirror& mirror, const Path& p) {
      return mirror.node[p.from] > mirror.node[p.to];
    };
    const Mirror a(scene.body[0]), b(scene.body[1]);
    // The mirror image has the opposite sign; a path written the other way round changes it again.
    held.sign *= swapped(a, held.tag.tangle.a) == swapped(b, held.tag.tangle.b) ? -1 : 1;
    held.tag.tangle.a = path(a, held.tag.tangle.a);
    held.tag.tangle.b = path(b, held.tag.tangle.b);
  }
  for (Hold& hold : out.holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      point->offset = Mirror::Point(point->offset);
      if (point->figure == kWorld) continue;
      point->node = Mirror(scene.body[point->figure]).node[point->node];
    }
    hold.relative_rotation = Mirror::Rotation(hold.relative_rotation);
  }
  return out;
}

TEST(Spacetime, AMirroredSceneGivesTheMirroredResult) {
  // Small motions: no step ends on the very edge of what the guard lets through, where rounding
  // would decide.
  const Scene scene = SmallScene(8, 0.05);
  Settings settings = Tight();
  settings.solve.max_iterations = 25;
  const Scene mirrored = Mirrored(scene);
  const SolveResult one = SolveFromSource(scene, settings);
  const SolveResult two = SolveFromSource(mirrored, settings);
  EXPECT_NEAR(one.initial_cost / two.initial_cost, 1, 1e-9);
  EXPECT_NEAR(one.cost / two.cost, 1, 1e-5);
  const std::array<Clip, 2> p = EditedClips(scene, one.unknowns);
  const std::array<Clip, 2> q = EditedClips(mirrored, two.unknowns);
  for (int f = 0; f < 2; ++f) {
    const Mirror mirror(scene.body[f]);
    for (int t = 0; t < 8; ++t) {
      const PosedBody expected = PoseBody(scene.body[f], mirror(p[f].frames[t]));
      const PosedBody got = PoseBody(scene.body[f], q[f].frames[t]);
      for (size_t n = 0; n < got.node.size(); ++n) {
        EXPECT_LT((got.node[n] - expected.node[n]).norm(), 2e-3);
      }
    }
  }
}

TEST(Spacetime, ExchangingTheFiguresExchangesTheResult) {
  const Scene scene = SmallScene(8, 0.1);
  Scene exchanged = scene;
  std::swap(exchanged.body[0], exchanged.body[1]);
  std::swap(exchanged.source[0], exchanged.source[1]);
  std::swap(exchanged.contacts[0], exchanged.contacts[1]);
  std::swap(exchanged.posture.pose[0], exchanged.posture.pose[1]);
  for (TangleTarget& held : exchanged.tangles) std::swap(held.tag.tangle.a, held.tag.tangle.b);
  for (Hold& hold : exchanged.holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      if (point->figure != kWorld) point->figure = 1 - point->figure;
    }
  }
  Settings settings = Tight();
  settings.solve.max_iterations = 25;
  const SolveResult one = SolveFromSource(scene, settings);
  const SolveResult two = SolveFromSource(exchanged, settings);
  EXPECT_NEAR(one.initial_cost / two.initial_cost, 1, 1e-9);
  EXPECT_NEAR(one.cost / two.cost, 1, 1e-5);
  const std::array<Clip, 2> p = EditedClips(scene, one.unknowns);
  const std::array<Clip, 2> q = EditedClips(exchanged, two.unknowns);
  for (int f = 0; f < 2; ++f) {
    for (int t = 0; t < 8; ++t) {
      EXPECT_LT((p[f].frames[t].root_position - q[1 - f].frames[t].root_position).norm(), 2e-3);
    }
  }
}

TEST(Spacetime, NoLimbPassesThroughALimbBetweenAcceptedIterates) {
  const Scene scene = SmallScene(10, 0.15);
  Settings settings = Tight();
  settings.weights.tangle = 300;  // asks for large first steps
  const Problem problem(scene, settings);
  std::vector<NodePositions> last;
  double worst = 0, furthest = 0;
  int steps = 0;
  SolveResult partial;
  for (int iterations = 1; iterations <= 6; ++iterations) {
    Settings some = settings;
    some.solve.max_iterations = iterations;
    const Problem again(scene, some);
    partial = SolveSpacetime(again, UnknownsFromPoses(scene, scene.source), nullptr);
    std::vector<NodePositions> now(static_cast<size_t>(scene.num_frames()));
    Frame frame;
    for (int t = 0; t < scene.num_frames(); ++t) {
      frame.Set(scene, partial.unknowns, t, false);
      now[t] = {frame.posed[0].node, frame.posed[1].node};
      if (last.empty()) continue;
      worst = std::max(worst, LargestGliJump(scene.body, last[t], now[t], 1e9).size);
      furthest = std::max(furthest, LargestDisplacement(last[t], now[t]));
      ++steps;
    }
    last = now;
  }
  EXPECT_EQ(steps, 50);
  EXPECT_LE(worst, settings.solve.gli_jump + 1e-9);
  EXPECT_LE(furthest, settings.solve.step_limit_m + 1e-9);
}

}  // namespace
}  // namespace retarget::solver
