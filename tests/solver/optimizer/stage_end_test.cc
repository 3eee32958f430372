// Runs of costs as solves show them.
#include "solver/optimizer/stage_end.h"

#include <gtest/gtest.h>

namespace retarget::solver {
namespace {

// Iterations until the end, at most 200, of a cost that falls by `share` in each.
int IterationsOf(double share, bool free, bool patient = false) {
  double cost = 100;
  StageEnd end(1e-3, cost, patient);
  for (int k = 1; k < 200; ++k) {
    cost *= 1 - share;
    if (end.Add(cost, free)) return k;
  }
  return 200;
}

TEST(StageEnd, TwoFreeStepsThatGainLittleEndIt) { EXPECT_EQ(IterationsOf(5e-4, true), 2); }

TEST(StageEnd, ProgressKeepsItGoing) {
  EXPECT_EQ(IterationsOf(5e-3, true), 200);
  EXPECT_EQ(IterationsOf(5e-3, false), 200);
  EXPECT_EQ(IterationsOf(3e-4, false), 200) << "held short, but eight gain what they should";
}

TEST(StageEnd, StepsThatAreHeldShortAndLeadNowhereEndIt) {
  EXPECT_EQ(IterationsOf(1e-4, false), 8);
  EXPECT_EQ(IterationsOf(0, false), 8);
}

TEST(StageEnd, SingleFramesEndWithFreeStepsAlone) {
  EXPECT_EQ(IterationsOf(1e-4, false, true), 200);
  EXPECT_EQ(IterationsOf(1e-4, true, true), 2);
}

TEST(StageEnd, OneGoodStepInBetweenKeepsItGoing) {
  double cost = 100;
  StageEnd end(1e-3, cost, false);
  for (int k = 1; k < 60; ++k) {
    cost *= k % 5 == 0 ? 0.98 : 0.99999;
    EXPECT_FALSE(end.Add(cost, false)) << k;
  }
}

}  // namespace
}  // namespace retarget::solver
