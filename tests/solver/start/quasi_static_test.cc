// The quasi-static start and its one-frame solve keep to what solve.step_limit_m and solve.gli_jump
// allow.
#include "solver/start/quasi_static.h"

#include <gtest/gtest.h>

#include "model/body/pass_through.h"
#include "solver/optimizer/frame_solve.h"
#include "solver/start/start.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

TEST(QuasiStatic, TheStepLimitOfTheSolveReachesIt) {
  const Scene scene = SmallScene(6, 0.15);
  const Settings usual;
  Settings tight;
  tight.solve.step_limit_m = 0.002;
  const Unknowns free = TemplateStart(Problem(scene, usual));
  const Unknowns held = TemplateStart(Problem(scene, tight));
  EXPECT_GT((free.edit - held.edit).cwiseAbs().maxCoeff(), 1e-3);
  // Few iterations of short steps do not get as far.
  const double cost_free = Problem(scene, usual).Cost(free, 1, 1);
  EXPECT_GT(Problem(scene, usual).Cost(held, 1, 1), cost_free);
}

TEST(QuasiStatic, TheGliJumpOfTheSolveReachesIt) {
  const Scene scene = SmallScene(6, 0.4);
  Settings tight;
  tight.solve.gli_jump = 0.05;
  const Unknowns free = TemplateStart(Problem(scene, {}));
  const Unknowns held = TemplateStart(Problem(scene, tight));
  EXPECT_GT((free.edit - held.edit).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(FrameSolve, NoIterationGoesBeyondTheLimits) {
  const Scene scene = SmallScene(3, 0.2);
  Settings settings;
  settings.weights.tangle = 300;  // asks for large first steps
  const Problem problem(scene, settings);
  FrameSolveOptions options;
  options.max_iterations = 1;
  options.step_limit_m = 0.03;
  options.gli_jump = 0.1;
  Unknowns x = UnknownsFromPoses(scene, scene.source);
  int steps = 0;
  double cost = 0;
  for (int k = 0; k < 20; ++k) {
    Frame before;
    before.Set(scene, x, 1, false);
    const FrameSolved solved = SolveFrame(problem, {.t = 1}, options, &x);
    Frame after;
    after.Set(scene, x, 1, false);
    const NodePositions from = {before.posed[0].node, before.posed[1].node};
    const NodePositions to = {after.posed[0].node, after.posed[1].node};
    EXPECT_EQ(to, solved.node);
    EXPECT_LE(LargestDisplacement(from, to), options.step_limit_m + 1e-12);
    EXPECT_LE(LargestGliJump(scene.body, from, to, options.guard_reach).size, options.gli_jump);
    if (k > 0 && solved.iterations > 0) {
      EXPECT_LT(solved.cost, cost);
    }
    cost = solved.cost;
    steps += solved.iterations;
  }
  EXPECT_GE(steps, 5);
}

}  // namespace
}  // namespace retarget::solver
