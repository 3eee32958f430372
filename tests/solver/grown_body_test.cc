// A body with fingers and toes is a longer table and nothing else (Ho and Komura 2007,
// section 4.2): tangles, terms, both back ends, the template fit and the metrics take it as it
// comes.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/metrics/metrics.h"
#include "solver/optimizer/spacetime.h"
#include "solver/start/start.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

int AddLink(Body* body, const std::string& name, int parent, const Vec3& centre) {
  Link link;
  link.name = name;
  link.parent = parent;
  link.centre = centre;
  body->links.push_back(link);
  return body->num_links() - 1;
}

int AddNode(Body* body, const std::string& name, int parent, int link, const Vec3& offset,
            double radius) {
  body->nodes.push_back({name, parent, link, offset, radius, 0.02});
  return body->num_nodes() - 1;
}

// A knuckle fixed in the hand, and two joints behind it: three nodes, two links.
void AddFinger(Body* body, const std::string& name, const std::string& side, const Vec3& knuckle,
               const Vec3& along) {
  const int hand = body->FindLink(side + "_wrist");
  const int base =
      AddNode(body, name + "_0", body->FindNode(side + "_wrist"), hand, knuckle, 0.009);
  const int first = AddLink(body, name + "_1", hand, knuckle);
  const int middle = AddNode(body, name + "_1", base, first, along, 0.008);
  const int second = AddLink(body, name + "_2", first, along);
  AddNode(body, name + "_2", middle, second, 0.7 * along, 0.008);
}

// The standard body with a thumb and `fingers` fingers of two joints on each hand, and two toe
// joints on each foot.
Body GrownBody(double stature, int fingers) {
  Body body = StandardBody(AverageMeasures(stature));
  const double k = stature / 1.75;
  const char* names[] = {"index", "middle", "ring", "little"};
  for (const double x : {1.0, -1.0}) {
    const std::string side = x > 0 ? "left" : "right";
    AddFinger(&body, side + "_thumb", side, k * Vec3(0.03 * x, 0, 0.03),
              k * Vec3(0.03 * x, 0, 0.03));
    for (int i = 0; i < fingers; ++i) {
      AddFinger(&body, side + "_" + names[i], side, k * Vec3(0.09 * x, 0, 0.03 - 0.02 * i),
                k * Vec3(0.04 * x, 0, 0));
    }
    const int foot = body.FindLink(side + "_ankle"), toe = body.FindNode(side + "_toe");
    for (const char* which : {"big", "small"}) {
      const Vec3 aside((which[0] == 'b' ? -0.02 : 0.02) * x * k, 0, 0);
      const std::string name = side + "_" + which + "_toes";
      const int link = AddLink(&body, name, foot, body.nodes[toe].offset);
      AddNode(&body, name, toe, link, aside + k * Vec3(0, 0, 0.05), 0.02);
    }
  }
  return body;
}

// Fingers bent, the rest as in the rough hug.
TemplatePosture GrownHug(const Body& a, const Body& b) {
  TemplatePosture posture = RoughHug(a, b);
  for (int f = 0; f < 2; ++f) {
    const Body& body = posture.body[f];
    for (int l = 19; l < body.num_links(); ++l) {
      const std::string& name = body.links[l].name;
      if (name.find("toes") != std::string::npos) continue;
      posture.pose[f].rotation[l] = Turn(0, 0, name.starts_with("left") ? -35 : 35);
    }
  }
  return posture;
}

Scene GrownScene(int frames, int fingers) {
  Scene scene;
  scene.body = {GrownBody(1.80, fingers), GrownBody(1.65, fingers)};
  scene.posture = GrownHug(scene.body[0], scene.body[1]);
  for (int f = 0; f < 2; ++f) {
    scene.source[f] = Fidget(scene.body[f], scene.posture.pose[f], frames, 30, 3 + f, 0.08);
    scene.contacts[f] = {{scene.body[f].FindNode("left_ankle"), 0, frames - 1},
                         {scene.body[f].FindNode("right_big_toes"), 1, frames - 2}};
  }
  const TemplateTangles tangles = FindTemplateTangles(scene.posture, {});
  scene.tangles = TangleTargets(tangles.tags, scene.posture, 0.05);
  const PosedBody posed = PoseBody(scene.body[0], scene.posture.pose[0]);
  Hold tips;  // a fingertip keeps its distance from a knuckle of the other hand, give or take a bit
  tips.from = {0, scene.body[0].FindNode("left_index_2"), Vec3::Zero()};
  tips.to = {0, scene.body[0].FindNode("right_index_0"), Vec3::Zero()};
  const Mat3& frame = posed.rotation[scene.body[0].nodes[tips.to.node].link];
  tips.to.offset = frame.transpose() * (posed.node[tips.from.node] - posed.node[tips.to.node]) +
                   Vec3(0.02, 0.01, 0);
  scene.holds = {tips};
  return scene;
}

std::vector<std::array<double, 5>> Sorted(const std::vector<Tangle>& tangles) {
  std::vector<std::array<double, 5>> out;
  for (const Tangle& t : tangles) {
    out.push_back({double(t.a.from), double(t.a.to), double(t.b.from), double(t.b.to), t.gli});
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(GrownBody, HasTheLongerTable) {
  const Body body = GrownBody(1.75, 4);
  EXPECT_EQ(body.num_nodes(), 21 + 2 * (5 * 3 + 2));
  EXPECT_EQ(body.num_links(), 19 + 2 * (5 * 2 + 2));
  EXPECT_EQ(body.num_coordinates(), 3 + 3 * 43);
  const PosedBody rest = PoseBody(body, RestPose(body));
  const Body small = ScaledTo(body, 0.875);
  for (int n = 1; n < body.num_nodes(); ++n) {
    EXPECT_LT(body.nodes[n].parent, n);
    EXPECT_NEAR((rest.node[n] - rest.node[body.nodes[n].parent]).norm(), body.SegmentLength(n),
                1e-14);
    EXPECT_NEAR(small.SegmentLength(n), 0.5 * body.SegmentLength(n), 1e-14);
  }
  EXPECT_NEAR(rest.node[body.FindNode("left_index_2")].x(),
              rest.node[body.FindNode("left_wrist")].x() + 0.09 + 0.04 + 0.028, 1e-12);
}

TEST(GrownBody, TanglesAreThoseOfTheDefinition) {
  size_t found = 0, with_fingers = 0;
  for (const int fingers : {1, 4}) {
    const Body a = GrownBody(1.80, fingers), b = GrownBody(1.65, fingers);
    const TemplatePosture posture = GrownHug(a, b);
    const MatX table =
        SegmentGliTable(a, PoseBody(a, posture.pose[0]).node, b, PoseBody(b, posture.pose[1]).node);
    ASSERT_EQ(table.rows(), a.num_nodes() - 1);
    const auto fast = Sorted(FindTangles(a, b, table));
    EXPECT_EQ(fast, Sorted(FindTanglesByDefinition(a, b, table)));
    found += fast.size();
    for (const auto& t : fast) with_fingers += std::max(t[0], t[1]) > 20;
  }
  EXPECT_GT(found, 100u);
  EXPECT_GT(with_fingers, 50u);
}

// The standard body's own tangles do not change when it gets fingers that are not on their paths.
TEST(GrownBody, KeepsTheTanglesOfTheStandardBody) {
  const auto literal = [](const TemplatePosture& p) {
    return FindTangles(p.body[0], p.body[1],
                       SegmentGliTable(p.body[0], PoseBody(p.body[0], p.pose[0]).node, p.body[1],
                                       PoseBody(p.body[1], p.pose[1]).node));
  };
  const Body a = StandardBody(AverageMeasures(1.80)), b = StandardBody(AverageMeasures(1.65));
  const std::vector<Tangle> expected = literal(RoughHug(a, b));
  std::vector<Tangle> got = literal(GrownHug(GrownBody(1.80, 4), GrownBody(1.65, 4)));
  std::erase_if(got, [](const Tangle& t) { return t.a.to > 20 || t.b.to > 20; });
  ASSERT_EQ(expected.size(), got.size());
  ASSERT_FALSE(expected.empty());
  const auto one = Sorted(expected), two = Sorted(got);
  for (size_t k = 0; k < one.size(); ++k) {
    for (int c = 0; c < 4; ++c) EXPECT_EQ(one[k][c], two[k][c]);
    EXPECT_NEAR(one[k][4], two[k][4], 1e-12);
  }
}

TEST(GrownBody, BothBackEndsSolveIt) {
  const Scene scene = GrownScene(6, 4);
  ASSERT_FALSE(scene.tangles.empty());
  EXPECT_EQ(scene.num_coordinates(), 264);
  Settings settings;
  settings.solve.threads = 1;
  settings.solve.max_iterations = 300;
  settings.solve.relative_decrease = 3e-3;
  settings.solve.polish_decrease = 1e-4;
  double cost[2] = {};
  for (const Backend backend : {Backend::kBanded, Backend::kCeres}) {
    settings.solve.backend = backend;
    const Problem problem(scene, settings);
    const SolveResult result =
        SolveSpacetime(problem, UnknownsFromPoses(scene, scene.source), nullptr);
    EXPECT_LT(result.cost, 0.5 * result.initial_cost) << NameOf(backend);
    EXPECT_GT(result.iterations, 0) << NameOf(backend);
    cost[backend == Backend::kCeres] = result.cost;
    const std::array<Clip, 2> solved = EditedClips(scene, result.unknowns);
    const Metrics m = Measure(MetricsContextOf(scene), ViewOf(scene.body, solved),
                              ViewOf(scene.body, scene.source));
    EXPECT_GT(m.smallest_gli_between, 0.5) << NameOf(backend);
    EXPECT_EQ(m.tangle_kept_percent, 100) << NameOf(backend);
    EXPECT_TRUE(m.pass_throughs.empty()) << NameOf(backend);
    EXPECT_LT(m.hold_m[0], 5e-3) << NameOf(backend);
    EXPECT_LT(m.penetration_m, 0.01) << NameOf(backend);
    EXPECT_LT(m.figure[0].foot_drift_m, 5e-3) << NameOf(backend);
    EXPECT_LT(m.figure[0].length_error_percent, 1e-9) << NameOf(backend);
    // The fingers take their part: the held fingertip's joint is turned.
    const int l = scene.body[0].FindLink("left_index_2");
    EXPECT_GT(result.unknowns.edit.middleRows(3 + 3 * l, 3).cwiseAbs().maxCoeff(), 1e-4)
        << NameOf(backend);
  }
  EXPECT_NEAR(cost[0] / cost[1], 1, 1e-2);
}

TEST(GrownBody, TheTemplateFitsAndAStartIsFound) {
  Scene scene = GrownScene(3, 1);
  std::array<Body, 2> body = scene.body;
  body[1] = ScaledTo(body[1], 0.9 * body[1].stature);
  const TemplateTangles tangles = FindTemplateTangles(scene.posture, {});
  const TemplatePosture fitted = FitTemplate(scene.posture, body, tangles.tags, {});
  const MatX table = SegmentGliTable(body[0], PoseBody(body[0], fitted.pose[0]).node, body[1],
                                     PoseBody(body[1], fitted.pose[1]).node);
  for (const Tag& tag : tangles.tags) {
    const double gli = SignsOf(body[0], tag.tangle.a)
                           .cast<double>()
                           .dot(table * SignsOf(body[1], tag.tangle.b).cast<double>());
    EXPECT_GT(tag.tangle.gli < 0 ? -gli : gli, 0.5);
  }
  const Problem problem(scene, {});
  const Unknowns start = TemplateStart(problem);
  EXPECT_EQ(start.edit.rows(), scene.num_coordinates());
  EXPECT_EQ(start.edit.cols(), 3);
  EXPECT_LT(problem.Cost(start, 1, 1), problem.Cost(UnknownsFromPoses(scene, scene.source), 1, 1));
}

}  // namespace
}  // namespace retarget::solver
