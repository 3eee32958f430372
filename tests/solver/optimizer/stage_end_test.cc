// Runs of costs and steps as solves show them.
#include "solver/optimizer/stage_end.h"

#include <gtest/gtest.h>

namespace retarget::solver {
namespace {

// Iterations until the end, at most 200, of a cost that falls by `share` in each.
int IterationsOf(double share, double step_m, bool free, bool patient = false) {
  double cost = 100;
  StageEnd end(1e-3, cost, patient);
  for (int k = 1; k < 200; ++k) {
    cost *= 1 - share;
    if (end.Add(cost, step_m, free)) return k;
  }
  return 200;
}

TEST(StageEnd, TwoFreeStepsThatGainLittleEndIt) { EXPECT_EQ(IterationsOf(5e-4, 0.05, true), 2); }

TEST(StageEnd, ProgressKeepsItGoing) {
  EXPECT_EQ(IterationsOf(5e-3, 0.05, true), 200);
  EXPECT_EQ(IterationsOf(5e-3, 0.05, false), 200);
  EXPECT_EQ(IterationsOf(3e-4, 0.05, false), 200) << "held short, but five gain what one should";
}

TEST(StageEnd, StepsThatAreHeldShortAndLeadNowhereEndIt) {
  EXPECT_EQ(IterationsOf(1e-4, 0.05, false), 5);
  EXPECT_EQ(IterationsOf(0, 0.05, false), 5);
  EXPECT_EQ(IterationsOf(1e-4, 1e-6, false), 2) << "nothing moves";
}

TEST(StageEnd, SingleFramesEndWithFreeStepsAlone) {
  EXPECT_EQ(IterationsOf(1e-4, 1e-6, false, true), 200);
  EXPECT_EQ(IterationsOf(1e-4, 1e-6, true, true), 2);
}

TEST(StageEnd, OneGoodStepInBetweenKeepsItGoing) {
  double cost = 100;
  StageEnd end(1e-3, cost, false);
  for (int k = 1; k < 60; ++k) {
    cost *= k % 3 == 0 ? 0.98 : 0.99999;
    EXPECT_FALSE(end.Add(cost, 0.05, false)) << k;
  }
}

}  // namespace
}  // namespace retarget::solver
