// Pulls against numerical differentiation of the cost, and diagnoses that are known beforehand.
#include "solver/metrics/diagnosis.h"

#include <map>

#include "tests/solver/metrics/diagnosis_fixture.h"

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

TEST(TermGradient, IsTheGradientOfEachTermsCost) {
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
  for (const TermGradient& part : TermGradients(problem, u, 2, 4, coordinates)) {
    const auto [at, is_new] = sum.try_emplace(part.term, part.gradient);
    if (!is_new) at->second += part.gradient;
    holds += part.term == "hold";
    feet += part.term == "foot_lock";
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

TEST(TermGradient, CoordinatesAreTheRootsAndTheJointsUpToTheNode) {
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

TEST(Diagnosis, TwoHoldsThatPullOneHandApart) {
  const Solved s(HandTo({Vec3(0, 0.2, -0.1), Vec3(0, -0.2, 0.1)}), {});
  for (const int k : {0, 1}) {
    const Diagnosis& c = s.OfHold(k);
    EXPECT_EQ(c.cause, Cause::kSameTerm);
    ASSERT_EQ(c.terms(), (std::vector<std::string>{"hold", "hold"}));
    EXPECT_LT(c.opposition.shares[0].cosine, -0.95);
    EXPECT_EQ(c.opposition.item, 1 - k);
    EXPECT_FALSE(c.suggestion);
    ASSERT_EQ(c.check.limbs.size(), 1u);
    EXPECT_EQ(c.check.limbs[0].figure, 0);
    EXPECT_EQ(c.check.limbs[0].node, s.scene.body[0].FindNode("left_hand"));
    EXPECT_EQ(c.check.frame, s.metrics.hold_frame[static_cast<size_t>(k)]);
  }
}

TEST(Diagnosis, AHoldFarAwayAgainstPlantedFeet) {
  // The hand is to be 3 m higher; the feet are planted, the rest is nearly free. (To the side, the
  // footprints could go along.)
  const Solved s(HandTo({Vec3(0, 3, 0)}), PlantedSettings());
  const Diagnosis& c = s.OfHold(0);
  ASSERT_EQ(c.terms(), (std::vector<std::string>{"hold", "foot_lock"}));
  EXPECT_EQ(c.cause, Cause::kHoldOutOfReach);
  ASSERT_TRUE(c.opposing_foot);
  EXPECT_EQ(c.opposing_foot->figure, 0);
  ASSERT_TRUE(c.reach.ground[0]);
  EXPECT_EQ(c.reach.ground[0]->figure, 0);
  EXPECT_FALSE(c.reach.ground[1]);  // the world
  EXPECT_GT(c.reach.apart_m, c.reach.reach_m);

  // The cosine by numerical differentiation of the two costs.
  const int first = std::max(0, c.check.frame - kConflictReach);
  const int last = std::min(9, c.check.frame + kConflictReach + 1);
  const std::vector<VecX> numerical =
      NumericalPulls(*s.problem, s.unknowns, first, last, CoordinatesOf(s.scene, c.check.limbs));
  const VecX &hold = numerical[s.IndexOf("hold")], &feet = numerical[s.IndexOf("foot_lock")];
  const double cosine = c.opposition.shares[0].cosine;
  EXPECT_NEAR(cosine, hold.dot(feet) / (hold.norm() * feet.norm()), 1e-4);
  EXPECT_LT(cosine, -0.3);
}

TEST(Diagnosis, AFeebleWeightIsNamedWithItsDefault) {
  Settings settings;
  settings.weights.hold = 0.1;
  const Solved feeble(HandTo({Vec3(0, 0.15, 0)}), settings);
  settings.weights.hold = 0;
  const Solved none(HandTo({Vec3(0, 0.15, 0)}), settings);
  EXPECT_EQ(feeble.OfHold(0).cause, Cause::kLowWeight);
  EXPECT_EQ(none.OfHold(0).cause, Cause::kNoWeight);
  for (const Solved* s : {&feeble, &none}) {
    const std::optional<Suggestion>& suggestion = s->OfHold(0).suggestion;
    ASSERT_TRUE(suggestion);
    EXPECT_EQ(suggestion->setting, "weights.hold");
    EXPECT_EQ(suggestion->value, 60);
    EXPECT_EQ(suggestion->now, s->settings.weights.hold);
    EXPECT_TRUE(suggestion->is_default);
  }
}

TEST(Diagnosis, TheSuggestedWeightHelps) {
  Settings settings = StiffSettings();
  const Scene scene = HandTo({Vec3(0.1, 0.3, 0)});
  const Solved before(scene, settings);
  const std::optional<Suggestion>& suggestion = before.OfHold(0).suggestion;
  ASSERT_TRUE(suggestion);
  ASSERT_EQ(suggestion->setting, "weights.hold");
  settings.weights.hold = suggestion->value;
  EXPECT_GE(settings.weights.hold, 60);
  const Solved after(scene, settings);
  EXPECT_LT(after.metrics.hold_m[0], 0.5 * before.metrics.hold_m[0]);
}

TEST(Diagnosis, NoneWhereEverythingIsMet) {
  const Solved s(HandTo({Vec3::Zero()}), {});
  EXPECT_TRUE(s.diagnoses.empty());
}

TEST_F(MissTest, TwoPlantedFeetInOnePlace) {
  const Diagnosis c = ConflictAbout(FeetInOnePlace());
  EXPECT_EQ(c.cause, Cause::kFeetInOnePlace);
  ASSERT_EQ(c.feet.size(), 2u);
  for (int f = 0; f < 2; ++f) {
    EXPECT_EQ(c.feet[f].figure, f);
    EXPECT_EQ(c.feet[f].contact.node, Node(f, "right_toe"));
    EXPECT_EQ(c.feet[f].contact.first, 3);
    EXPECT_EQ(c.feet[f].contact.last, 8);
  }
}

TEST_F(MissTest, RequirementsThatNoTermServes) {
  const Diagnosis pass = ConflictAbout(PassThroughs());
  EXPECT_EQ(pass.cause, Cause::kPassThrough);
  EXPECT_EQ(pass.pass_throughs, 2);
  const Diagnosis written = ConflictAbout(WriteBack());
  EXPECT_EQ(written.cause, Cause::kNoTerm);
  EXPECT_TRUE(written.terms().empty() && written.check.limbs.empty());
  EXPECT_EQ(written.check.frame, -1);
}

TEST_F(MissTest, ATagThatAimsTooLowOrHasComeApart) {
  RequirementCheck check = TagFarAway();
  const Diagnosis flat = ConflictAbout(check);
  EXPECT_EQ(flat.cause, Cause::kFlatTangle);
  EXPECT_LT(flat.gli_slope, 0.05);
  subject_.tangles[0].target = 0.45;
  subject_.tangles[0].tag.tangle.gli = 0.45;
  EXPECT_EQ(ConflictAbout(check).cause, Cause::kLooseTemplate);
  subject_.tangles[0].tag.tangle.gli = -0.97;
  check.limit = 0.6;
  const Diagnosis low = ConflictAbout(check);
  EXPECT_EQ(low.cause, Cause::kLowTarget);
  ASSERT_TRUE(low.suggestion);
  EXPECT_EQ(low.suggestion->setting, "tangle.margin");
  EXPECT_NEAR(low.suggestion->value, 0.16, 1e-12);
}

}  // namespace
}  // namespace retarget::solver
