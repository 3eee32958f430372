// Costs by term: known by hand for a known edit, and shares of the cost in every iteration.
#include <gtest/gtest.h>

#include <numeric>

#include "solver/optimizer/spacetime.h"
#include "solver/start/start.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

const TermCost& Named(const std::vector<TermCost>& costs, const std::string& name) {
  for (const TermCost& c : costs) {
    if (c.name == name) return c;
  }
  throw std::runtime_error("no term " + name);
}

double SumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(TermCost, OfOneEditedCoordinateIsKnownByHand) {
  // Frame 3 of 8 alone is edited: a's left elbow by 0.2 rad about one axis, b's root by 0.05 m.
  // Its second differences are (1, -2, 1) times the edit.
  const Scene scene = SmallScene(8, 0.2);
  Settings settings;
  settings.weights.pose_tracking = 3;
  settings.weights.smoothness = 10;
  settings.weights.root_smoothness = 0;
  const Problem problem(scene, settings);
  Unknowns u = UnknownsFromPoses(scene, scene.source);
  const double share = settings.joint_weights.elbow;
  u.edit(3 + 3 * scene.body[0].FindLink("left_elbow") + 1, 3) = 0.2;
  u.edit(scene.FirstCoordinate(1), 3) = 0.05;
  const std::vector<TermCost> costs = problem.CostByTerm(u);

  const double turn = 0.5 * std::pow(share * 0.2, 2);
  EXPECT_NEAR(Named(costs, "pose_tracking").natural_cost, turn, 1e-15);
  EXPECT_NEAR(Named(costs, "pose_tracking").cost, 9 * turn, 1e-14);
  EXPECT_NEAR(Named(costs, "pose_tracking").largest, share * 0.2, 1e-15);
  EXPECT_NEAR(Named(costs, "root_tracking").natural_cost, 0.5 * 0.05 * 0.05, 1e-15);
  const double root = settings.joint_weights.root;
  const double both = turn + 0.5 * std::pow(root * 0.05, 2);
  EXPECT_NEAR(Named(costs, "smoothness").natural_cost, 6 * both, 1e-14);
  EXPECT_NEAR(Named(costs, "smoothness").cost, 100 * 6 * both, 1e-12);
  EXPECT_NEAR(Named(costs, "smoothness").largest, 2 * std::max(share * 0.2, root * 0.05), 1e-14);
  // A term that weighs nothing still says what it would see.
  EXPECT_NEAR(Named(costs, "root_smoothness").natural_cost, 6 * 0.5 * 0.05 * 0.05, 1e-14);
  EXPECT_EQ(Named(costs, "root_smoothness").cost, 0);
}

TEST(TermCost, AddsUpToTheCost) {
  const Scene scene = SmallScene(6, 0.3);
  const Problem problem(scene, {});
  Unknowns u = UnknownsFromPoses(scene, scene.source);
  std::mt19937 random(5);
  u.edit = 0.1 * RandomMatrix(u.edit.rows(), u.edit.cols(), &random);
  double sum = 0;
  for (const TermCost& c : problem.CostByTerm(u)) sum += c.cost;
  EXPECT_NEAR(sum, problem.Cost(u, 1, 1), 1e-9 * sum);
  // Half the contact weights: staged terms cost a quarter.
  const std::vector<double> whole = problem.TermCosts(u, 1, 2), half = problem.TermCosts(u, 0.5, 2);
  ASSERT_EQ(whole.size(), problem.terms().size() + 2);
  int staged = 0;
  for (size_t k = 0; k < whole.size(); ++k) {
    const bool is_staged = k < problem.terms().size() && problem.terms()[k].term->staged();
    EXPECT_NEAR(half[k], (is_staged ? 0.25 : 1) * whole[k], 1e-12 * whole[k]);
    staged += is_staged && whole[k] > 0;
  }
  EXPECT_GE(staged, 3);
}

TEST(TermCost, HistoryHasTheSharesOfEveryIteration) {
  const Scene scene = SmallScene(6, 0.2);
  for (const Backend backend : {Backend::kBanded, Backend::kCeres}) {
    Settings settings;
    settings.solve.backend = backend;
    const Problem problem(scene, settings);
    const SolveResult result = SolveSpacetime(problem, TemplateStart(problem), {});
    ASSERT_GE(result.history.size(), 3u) << NameOf(backend);
    for (const Iteration& i : result.history) {
      EXPECT_NEAR(SumOf(i.term_cost), i.cost, 1e-9 * i.cost) << NameOf(backend) << " " << i.index;
    }
    const std::vector<TermCost> costs = problem.CostByTerm(result.unknowns);
    ASSERT_EQ(result.history.back().term_cost.size(), costs.size());
    for (size_t k = 0; k < costs.size(); ++k) {
      EXPECT_NEAR(result.history.back().term_cost[k], costs[k].cost, 1e-9 * result.cost)
          << NameOf(backend) << " " << costs[k].name;
    }
  }
}

}  // namespace
}  // namespace retarget::solver
