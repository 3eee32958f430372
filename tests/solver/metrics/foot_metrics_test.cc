// Travel and acceleration of feet on paths that are written down: closed forms.
#include "solver/metrics/foot_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/body/shape.h"
#include "solver/metrics/requirements.h"

namespace retarget::solver {
namespace {

constexpr int kFrames = 20;
constexpr double kFps = 30;

class FootMetricsTest : public testing::Test {
 protected:
  FootMetricsTest() {
    for (int f = 0; f < 2; ++f) {
      subject_.body[f] = StandardBody(AverageMeasures(1.75));
      nodes_[f] = PoseBody(subject_.body[f], RestPose(subject_.body[f])).node;
      for (Vec3& p : nodes_[f]) p.y() += 3;  // all feet are high
    }
    toe_ = subject_.body[0].FindNode("left_toe");
    radius_ = NodeRadii(subject_.body[0])[toe_];
  }

  // A motion in which the left toe of a goes along `way` (its lowest point), the others stand.
  std::vector<NodePositions> Motion(const std::function<Vec3(int)>& way) const {
    std::vector<NodePositions> motion(kFrames, nodes_);
    for (int t = 0; t < kFrames; ++t) motion[t][0][toe_] = way(t) + Vec3(0, radius_, 0);
    return motion;
  }

  MetricsContext subject_;
  NodePositions nodes_;
  int toe_ = 0;
  double radius_ = 0;
};

TEST_F(FootMetricsTest, ASwingsTravelIsItsPathNearTheFloor) {
  subject_.contacts[0] = {{toe_, 0, 4}, {toe_, 12, 19}};
  // 3 cm and 4 cm per frame from frame 4 to frame 12: 8 steps of 5 cm. The source takes half.
  const auto way = [](int t) -> Vec3 { return std::clamp(t - 4, 0, 8) * Vec3(0.03, 0, 0.04); };
  const auto swings =
      MeasureSwings(subject_, 0, Motion(way), Motion([&](int t) -> Vec3 { return 0.5 * way(t); }));
  ASSERT_EQ(swings.size(), 1u);
  EXPECT_EQ(swings[0].node, toe_);
  EXPECT_EQ(swings[0].first, 5);
  EXPECT_EQ(swings[0].last, 11);
  EXPECT_NEAR(swings[0].travel_m, 8 * 0.05, 1e-12);
  EXPECT_NEAR(swings[0].source_m, 4 * 0.05, 1e-12);
}

TEST_F(FootMetricsTest, WhatIsHighIsNoTravelAndCrossingsAreCutWhereTheyAre) {
  subject_.contacts[0] = {{toe_, 0, 4}, {toe_, 12, 19}};
  // From the floor to 8 cm within one frame, along the floor by 10 cm per frame, and down again:
  // of the first and of the last step 3/4 are under 6 cm.
  const auto way = [](int t) {
    return Vec3(0.1 * std::clamp(t - 4, 0, 8), t > 4 && t < 12 ? 0.08 : 0, 0);
  };
  const auto swings = MeasureSwings(subject_, 0, Motion(way), Motion(way));
  ASSERT_EQ(swings.size(), 1u);
  EXPECT_NEAR(swings[0].travel_m, 2 * 0.75 * 0.1, 1e-12);
}

TEST_F(FootMetricsTest, FeetThatNeverComeNearTheFloorHaveNoSwing) {
  const auto motion = Motion([](int t) { return Vec3(0.1 * t, 0.061, 0); });
  EXPECT_TRUE(MeasureSwings(subject_, 0, motion, motion).empty());
  EXPECT_TRUE(MeasureEdges(subject_, 0, kFps, motion, motion).empty());
}

TEST_F(FootMetricsTest, AnEdgesAccelerationIsThatOfTheParabolaBesideIt) {
  subject_.contacts[0] = {{toe_, 0, 9}, {toe_, 16, 19}};
  // Rests until frame 9, then x = a (t - 9)^2 / (2 fps^2) until 14, where it stops: the stop is out
  // of reach of the edge at 9 (frames 5 to 13).
  const auto parabola = [](double a) {
    return [a](int t) {
      const double s = std::clamp(t - 9, 0, 5) / kFps;
      return Vec3(0.5 * a * s * s, 0, 0);
    };
  };
  const auto edges = MeasureEdges(subject_, 0, kFps, Motion(parabola(7)), Motion(parabola(2)));
  ASSERT_EQ(edges.size(), 2u) << "the clip's first and last frames are no edges";
  EXPECT_EQ(edges[0].frame, 9);
  EXPECT_NEAR(edges[0].acceleration, 7, 1e-9);
  EXPECT_NEAR(edges[0].source, 2, 1e-9);
  EXPECT_EQ(edges[1].frame, 16);
  EXPECT_GT(edges[1].acceleration, 20) << "it stops within one frame at 14";
}

TEST_F(FootMetricsTest, RequirementsTakeTheWorstAndSayWhereThereIsNothingToJudge) {
  Metrics metrics;
  Requirements limits;
  limits.foot_travel_m = 0.02;
  limits.foot_travel_ratio = 1.5;
  limits.foot_acceleration = 10;
  limits.foot_acceleration_ratio = 1.5;
  const auto check = [&](RequirementKind kind, int figure) {
    for (const RequirementCheck& c : CheckRequirements(subject_, metrics, limits)) {
      if (c.kind == kind && c.figure == figure) return c;
    }
    throw std::runtime_error("it is not listed");
  };
  using Kind = RequirementKind;
  for (const Kind kind : {Kind::kFootDrift, Kind::kFootTravel, Kind::kFootAcceleration}) {
    EXPECT_FALSE(check(kind, 0).judged());
    EXPECT_TRUE(check(kind, 0).met);
  }
  // The long swing may travel 30 cm, the short one no more than 2.
  metrics.figure[0].swings = {{toe_, 5, 9, 0.29, 0.20}, {toe_, 12, 14, 0.021, 0.001}};
  metrics.figure[0].edges = {{toe_, 4, 14, 9.5}, {toe_, 9, 10.5, 2}};
  const RequirementCheck travel = check(Kind::kFootTravel, 0);
  EXPECT_TRUE(travel.judged());
  EXPECT_FALSE(travel.met);
  EXPECT_EQ(travel.frame, 12);
  EXPECT_EQ(travel.value, 0.021);
  EXPECT_EQ(travel.limit, 0.02);
  const RequirementCheck edge = check(Kind::kFootAcceleration, 0);
  EXPECT_FALSE(edge.met);
  EXPECT_EQ(edge.frame, 9);
  EXPECT_EQ(edge.limit, 10);
  EXPECT_EQ(WorstSwing(metrics.figure[0])->travel_m, 0.29) << "its excess is the largest";
  EXPECT_EQ(WorstEdge(metrics.figure[0])->acceleration, 10.5);
  EXPECT_FALSE(check(Kind::kFootTravel, 1).judged());
}

}  // namespace
}  // namespace retarget::solver
