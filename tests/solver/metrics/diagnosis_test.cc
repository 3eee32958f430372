// Pulls against numerical differentiation of the cost, and conflicts that are known beforehand.
#include "solver/metrics/diagnosis.h"

#include <gtest/gtest.h>

#include <map>

#include "solver/optimizer/spacetime.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr double kStep = 1e-6;

// Gradient of every term's cost (in the order of CostByTerm) by `coordinates` of the frames
// [first, last), by central differences. [terms][frames * coordinates]
std::vector<VecX> NumericalPulls(const Problem& problem, const Unknowns& u, int first, int last,
                                 const std::vector<int>& coordinates) {
  const long n = static_cast<long>(coordinates.size());
  std::vector<VecX> out(problem.terms().size() + 2, VecX::Zero((last - first) * n));
  for (int t = first; t < last; ++t) {
    for (long c = 0; c < n; ++c) {
      Unknowns plus = u, minus = u;
      plus.edit(coordinates[c], t) += kStep;
      minus.edit(coordinates[c], t) -= kStep;
      const std::vector<double> p = problem.TermCosts(plus, 1, 1),
                                m = problem.TermCosts(minus, 1, 1);
      for (size_t k = 0; k < out.size(); ++k) {
        out[k][(t - first) * n + c] = (p[k] - m[k]) / (2 * kStep);
      }
    }
  }
  return out;
}

TEST(Pull, IsTheGradientOfEachTermsCost) {
  const Scene scene = SmallScene(7, 0.2);
  const Problem problem(scene, {});
  Unknowns u = UnknownsFromPoses(scene, scene.source);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (long i = 0; i < u.edit.size(); ++i) u.edit(i) += 0.1 * normal(random);
  const std::vector<int> coordinates = CoordinatesOf(
      scene, {{0, scene.body[0].FindNode("left_hand")}, {1, scene.body[1].FindNode("right_toe")}});
  const std::vector<VecX> numerical = NumericalPulls(problem, u, 2, 4, coordinates);
  std::map<std::string, VecX> sum;
  int holds = 0, feet = 0;
  for (const Pull& pull : PullsOn(problem, u, 2, 4, coordinates)) {
    const auto [at, is_new] = sum.try_emplace(pull.term, pull.gradient);
    if (!is_new) at->second += pull.gradient;
    holds += pull.term == "hold";
    feet += pull.term == "foot_lock";
  }
  EXPECT_EQ(holds, 2);
  EXPECT_GE(feet, 2);
  int checked = 0;
  const std::vector<TermCost> costs = problem.CostByTerm(u);
  for (size_t k = 0; k < costs.size(); ++k) {
    if (sum.count(costs[k].name) == 0) {
      EXPECT_TRUE(numerical[k].isZero(1e-6)) << costs[k].name;
      continue;
    }
    const double scale = 1 + numerical[k].norm();
    EXPECT_LT((sum[costs[k].name] - numerical[k]).norm(), 1e-4 * scale) << costs[k].name;
    checked += numerical[k].norm() > 1e-3;
  }
  EXPECT_GE(checked, 8);
}

TEST(Pull, CoordinatesAreTheRootsAndTheJointsUpToTheNode) {
  const Scene scene = SmallScene(2, 0.1);
  const Body& body = scene.body[1];
  const int first = scene.FirstCoordinate(1);
  std::vector<int> expected;
  for (int k = 0; k < 6; ++k) expected.push_back(first + k);
  for (const char* link : {"left_hip", "left_knee", "left_ankle"}) {
    for (int k = 0; k < 3; ++k) expected.push_back(first + 3 + 3 * body.FindLink(link) + k);
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(CoordinatesOf(scene, {{1, body.FindNode("left_toe")}}), expected);
  // A locked joint cannot move anything.
  Scene locked = scene;
  locked.body[1].links[body.FindLink("left_knee")].locked = true;
  EXPECT_EQ(CoordinatesOf(locked, {{1, body.FindNode("left_toe")}}).size(), expected.size() - 3);
}

// A scene that is solved and measured.
struct Solved {
  Scene scene;
  Settings settings;
  std::unique_ptr<Problem> problem;
  Unknowns unknowns;
  MeasureSubject subject;
  Metrics metrics;
  std::vector<RequirementCheck> checks;
  std::vector<Conflict> conflicts;

  Solved(const Scene& s, const Settings& with) : scene(s), settings(with) {
    problem = std::make_unique<Problem>(scene, settings);
    unknowns = SolveSpacetime(*problem, UnknownsFromPoses(scene, scene.source), {}).unknowns;
    subject = SubjectOf(scene);
    const std::array<Clip, 2> solved = EditedClips(scene, unknowns);
    metrics = Measure(subject, ViewOf(scene.body, solved), ViewOf(scene.body, scene.source));
    checks = CheckRequirements(subject, metrics, settings.requirements);
    conflicts = FindConflicts(*problem, unknowns, subject, metrics, checks);
  }
  const Conflict& Of(const std::string& requirement) const {
    for (const Conflict& c : conflicts) {
      if (c.requirement == requirement) return c;
    }
    throw std::runtime_error("no conflict about " + requirement);
  }
  const RequirementCheck& Check(const std::string& name) const {
    for (const RequirementCheck& c : checks) {
      if (c.name == name) return c;
    }
    throw std::runtime_error("no check " + name);
  }
  size_t IndexOf(const std::string& term) const {
    const std::vector<TermCost> costs = problem->CostByTerm(unknowns);
    for (size_t k = 0; k < costs.size(); ++k) {
      if (costs[k].name == term) return k;
    }
    throw std::runtime_error("no term " + term);
  }
};

// A still scene in which a's left hand is to be at points of the world, `away` from where it is.
// b stands apart, and both so high that no foot reaches into the floor.
Scene HandTo(const std::vector<Vec3>& away) {
  Scene scene = SmallScene(9, 0);
  for (Pose& pose : scene.source[0].frames) pose.root_position.y() += 0.1;
  for (Pose& pose : scene.source[1].frames) pose.root_position += Vec3(0, 0.1, 8);
  const PosedBody posed = PoseBody(scene.body[0], scene.source[0].frames[0]);
  scene.holds.clear();
  scene.tangles.clear();
  for (const Vec3& d : away) {
    Hold hold;
    hold.from = {0, scene.body[0].FindNode("left_hand"), Vec3::Zero()};
    hold.to = {kWorld, 0, posed.node[hold.from.node] + d};
    scene.holds.push_back(hold);
  }
  return scene;
}

bool Says(const Conflict& conflict, const std::string& words) {
  return conflict.sentence.find(words) != std::string::npos;
}

TEST(Conflict, TwoHoldsThatPullOneHandApart) {
  const Solved s(HandTo({Vec3(0, 0.2, -0.1), Vec3(0, -0.2, 0.1)}), {});
  for (const int k : {1, 2}) {
    const Conflict& c = s.Of("hold " + std::to_string(k));
    ASSERT_EQ(c.terms, (std::vector<std::string>{"hold", "hold"})) << c.sentence;
    EXPECT_LT(c.cosine, -0.95);
    EXPECT_TRUE(Says(c, "hold " + std::to_string(3 - k))) << c.sentence;
    EXPECT_TRUE(Says(c, "no weight settles that")) << c.sentence;
    EXPECT_EQ(c.limbs, std::vector<std::string>{"a left_hand"});
    EXPECT_EQ(c.frame, s.metrics.hold_frame[static_cast<size_t>(k - 1)]);
  }
}

TEST(Conflict, AHoldFarAwayAgainstPlantedFeet) {
  // The hand is to be 3 m higher; the feet are planted, the rest is nearly free. (To the side, the
  // footprints could go along.)
  Settings settings;
  settings.weights.root_tracking = 0.1;
  settings.weights.pose_tracking = 0.1;
  settings.weights.joint_limit = 0.1;
  settings.weights.penetration = settings.weights.self_penetration = 0;
  settings.weights.foot_lock = 1000;
  const Solved s(HandTo({Vec3(0, 3, 0)}), settings);
  const Conflict& c = s.Of("hold 1");
  ASSERT_EQ(c.terms.size(), 2u) << c.sentence;
  EXPECT_EQ(c.terms[0], "hold");
  EXPECT_EQ(c.terms[1], "foot_lock") << c.sentence;
  EXPECT_TRUE(Says(c, "`hold` and `foot_lock` (a ")) << c.sentence;
  EXPECT_TRUE(Says(c, "contradict each other")) << c.sentence;

  // The cosine by numerical differentiation of the two costs.
  const RequirementCheck& check = s.Check("hold 1");
  const int first = std::max(0, check.frame - kConflictReach);
  const int last = std::min(9, check.frame + kConflictReach + 1);
  const std::vector<VecX> numerical =
      NumericalPulls(*s.problem, s.unknowns, first, last, CoordinatesOf(s.scene, check.limbs));
  const VecX &hold = numerical[s.IndexOf("hold")], &feet = numerical[s.IndexOf("foot_lock")];
  EXPECT_NEAR(c.cosine, hold.dot(feet) / (hold.norm() * feet.norm()), 1e-4);
  EXPECT_LT(c.cosine, -0.3);
}

TEST(Conflict, AFeebleWeightIsNamedWithItsDefault) {
  Settings settings;
  settings.weights.hold = 0.1;
  const Solved s(HandTo({Vec3(0, 0.15, 0)}), settings);
  const Conflict& c = s.Of("hold 1");
  EXPECT_TRUE(Says(c, "a left_hand misses its place in the world by 1")) << c.sentence;
  EXPECT_TRUE(Says(c, "far below its default: --set weights.hold=60")) << c.sentence;
  Settings none = settings;
  none.weights.hold = 0;
  EXPECT_TRUE(Says(Solved(HandTo({Vec3(0, 0.15, 0)}), none).Of("hold 1"), "weights.hold is 0"));
}

TEST(Conflict, TheSuggestedWeightHelps) {
  // Stiff poses keep the hand away; both weights are usual ones.
  Settings settings;
  settings.weights.pose_tracking = 2;
  settings.weights.root_tracking = 12;
  settings.weights.hold = 30;
  settings.weights.foot_lock = 300;
  settings.requirements.hold_m = 1e-3;
  const Scene scene = HandTo({Vec3(0.1, 0.3, 0)});
  const Solved before(scene, settings);
  const std::string& sentence = before.Of("hold 1").sentence;
  const size_t at = sentence.find("--set weights.hold=");
  ASSERT_NE(at, std::string::npos) << sentence;
  settings.weights.hold = std::stod(sentence.substr(at + 19));
  EXPECT_GE(settings.weights.hold, 60);
  const Solved after(scene, settings);
  EXPECT_LT(after.metrics.hold_m[0], 0.5 * before.metrics.hold_m[0]) << sentence;
}

TEST(Conflict, NoneWhereEverythingIsMet) {
  const Solved s(HandTo({Vec3::Zero()}), {});
  EXPECT_TRUE(s.conflicts.empty()) << s.conflicts[0].sentence;
}

// Checks that say what is missed without a solve.
class Words : public testing::Test {
 protected:
  Words() : scene_(SmallScene(9, 0)) {
    subject_ = SubjectOf(scene_);
    unknowns_ = UnknownsFromPoses(scene_, scene_.source);
    metrics_ =
        Measure(subject_, ViewOf(scene_.body, scene_.source), ViewOf(scene_.body, scene_.source));
  }
  std::string Sentence(const RequirementCheck& check, const Settings& settings = {}) const {
    const Problem problem(scene_, settings);
    return FindConflicts(problem, unknowns_, subject_, metrics_, {check}).at(0).sentence;
  }
  int Node(int f, const char* name) const { return scene_.body[f].FindNode(name); }

  Scene scene_;
  MeasureSubject subject_;
  Unknowns unknowns_;
  Metrics metrics_;
};

TEST_F(Words, TwoPlantedFeetInOnePlace) {
  // The right toes of both are planted in frame 5; b's is laid onto a's.
  const std::array<PosedBody, 2> posed = {PoseBody(scene_.body[0], scene_.source[0].frames[5]),
                                          PoseBody(scene_.body[1], scene_.source[1].frames[5])};
  const Vec3 d = posed[0].node[Node(0, "right_toe")] - posed[1].node[Node(1, "right_toe")];
  for (Pose& pose : scene_.source[1].frames) pose.root_position += d;
  unknowns_ = UnknownsFromPoses(scene_, scene_.source);
  const std::string sentence = Sentence({"penetration",
                                         0.06,
                                         0.02,
                                         "m",
                                         false,
                                         "",
                                         "penetration",
                                         -1,
                                         5,
                                         {{0, Node(0, "right_toe")}, {1, Node(1, "right_toe")}}});
  EXPECT_NE(sentence.find("penetration: a right_toe is 6.0 cm inside b right_toe at frame 5"),
            std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("plant both feet in one place (a right_toe, planted in frames 3 to 8; b "
                          "right_toe, planted in frames 3 to 8)"),
            std::string::npos)
      << sentence;
}

TEST_F(Words, RequirementsThatNoTermServes) {
  metrics_.pass_throughs = {{3, Node(0, "left_wrist"), Node(1, "head")}, {4, 1, 1}};
  const std::string pass = Sentence({"pass-throughs",
                                     2,
                                     0,
                                     "",
                                     false,
                                     "",
                                     "",
                                     -1,
                                     3,
                                     {{0, Node(0, "left_wrist")}, {1, Node(1, "head")}}});
  EXPECT_NE(pass.find("a left_wrist goes through b head between frames 3 and 4 (the first of 2)"),
            std::string::npos)
      << pass;
  const RequirementCheck write_back{"write-back a", 0.007, 0.005, "m", false, ""};
  EXPECT_NE(Sentence(write_back).find("write-back a: 0.007 m, 0.005 m is allowed"),
            std::string::npos);
  const Problem problem(scene_, {});
  const Conflict c = FindConflicts(problem, unknowns_, subject_, metrics_, {write_back}).at(0);
  EXPECT_TRUE(c.terms.empty() && c.limbs.empty());
  EXPECT_EQ(c.frame, -1);
}

TEST_F(Words, ATagThatAimsTooLowOrHasComeApart) {
  ASSERT_FALSE(scene_.tangles.empty());
  const Tangle& t = scene_.tangles[0].tag.tangle;
  RequirementCheck check{
      "tangle 1", 0.02,     0.5, "turns", false,
      "",         "tangle", 0,   4,       {{0, t.a.from}, {0, t.a.to}, {1, t.b.from}, {1, t.b.to}}};
  // b walks 20 m away: no move of a limb changes the GLI by much.
  for (Pose& pose : scene_.source[1].frames) pose.root_position.z() += 20;
  unknowns_ = UnknownsFromPoses(scene_, scene_.source);
  EXPECT_NE(Sentence(check).find("hardly changes"), std::string::npos) << Sentence(check);
  subject_.tangles[0].target = 0.45;
  subject_.tangles[0].tag.tangle.gli = 0.45;
  EXPECT_NE(Sentence(check).find("the template itself shows no more than 0.45"), std::string::npos)
      << Sentence(check);
  subject_.tangles[0].tag.tangle.gli = -0.97;
  check.limit = 0.6;
  EXPECT_NE(Sentence(check).find("--set tangle.margin=0.16"), std::string::npos) << Sentence(check);
}

}  // namespace
}  // namespace retarget::solver
