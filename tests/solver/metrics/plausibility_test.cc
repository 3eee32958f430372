// Plausibility on hand-made motions whose values follow from a ruler and a protractor.
#include "solver/metrics/plausibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/geometry/so3.h"
#include "solver/metrics/requirements.h"

namespace retarget::solver {
namespace {

// Two standing bodies, far apart.
class PlausibilityTest : public testing::Test {
 protected:
  static constexpr int kFrames = 12;

  PlausibilityTest() {
    subject_.body = {StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.60))};
    for (int f = 0; f < 2; ++f) {
      const Body& body = subject_.body[f];
      Pose standing = RestPose(body);
      double lowest = 0;
      for (const Vec3& p : PoseBody(body, standing).node) lowest = std::min(lowest, p.y());
      standing.root_position =
          Vec3(5.0 * f, -lowest + body.nodes[body.FindNode("left_ankle")].radius, 0);
      subject_.length[f].push_back(0);
      for (int n = 1; n < body.num_nodes(); ++n) {
        subject_.length[f].push_back(body.SegmentLength(n));
      }
      source_[f].frames.assign(kFrames, standing);
    }
    motion_ = source_;
  }

  int Link(int f, const char* name) const { return subject_.body[f].FindLink(name); }
  std::string NodeName(int f, const WorstAt& worst) const {
    return subject_.body[f].nodes[worst.node].name;
  }
  Pose& Frame(int f, int t) { return motion_[f].frames[t]; }
  Plausibility Of(int f) const {
    return Measure(subject_, ViewOf(subject_.body, motion_), ViewOf(subject_.body, source_))
        .figure[f]
        .plausible;
  }
  RequirementCheck Check(RequirementKind kind, int f) const {
    const MotionView view = ViewOf(subject_.body, motion_);
    const Metrics metrics = Measure(subject_, view, ViewOf(subject_.body, source_));
    for (const RequirementCheck& c : CheckRequirements(subject_, metrics, {})) {
      if (c.kind == kind && c.figure == f) return c;
    }
    ADD_FAILURE() << "no such requirement";
    return {};
  }

  MetricsContext subject_;
  std::array<Clip, 2> source_, motion_;
};

TEST_F(PlausibilityTest, AMotionAgainstItselfAsksForNothing) {
  for (int f = 0; f < 2; ++f) {
    const Plausibility p = Of(f);
    EXPECT_LT(p.pose_error_m.value, 1e-12);
    EXPECT_LT(p.trunk_tilt_deg.value, 1e-6);
    EXPECT_LT(p.floating_m.value, 1e-12);
    EXPECT_EQ(p.joint_limit_deg.value, 0);
    EXPECT_LT(p.jerk_ratio.value, 1e-9);
  }
}

TEST_F(PlausibilityTest, TheTrunkTiltsByTheAngleThatItIsTurnedBy) {
  // The whole figure by 50 degrees at frame 4, and it faces elsewhere, which is no tilt.
  Frame(0, 4).rotation[0] = YawRotation(1.2) * Quat(Eigen::AngleAxisd(50 * kDegree, Vec3::UnitX()));
  const Plausibility p = Of(0);
  EXPECT_NEAR(p.trunk_tilt_deg.value, 50, 1.0);
  EXPECT_EQ(p.trunk_tilt_deg.frame, 4);
  const RequirementCheck check = Check(RequirementKind::kTrunkTilt, 0);
  EXPECT_FALSE(check.met);
  EXPECT_EQ(check.frame, 4);
  EXPECT_TRUE(Check(RequirementKind::kTrunkTilt, 1).met);
}

TEST_F(PlausibilityTest, ACarriedFigureMayLeanAndFloat) {
  subject_.carried = {true, false};
  for (int f = 0; f < 2; ++f) {
    Frame(f, 4).rotation[0] = Quat(Eigen::AngleAxisd(80 * kDegree, Vec3::UnitX()));
    Frame(f, 7).root_position.y() += 0.5;
  }
  for (const RequirementKind kind : {RequirementKind::kTrunkTilt, RequirementKind::kFloating}) {
    EXPECT_FALSE(Check(kind, 0).judged());
    EXPECT_TRUE(Check(kind, 0).met);
    EXPECT_FALSE(Check(kind, 1).met);
  }
}

TEST_F(PlausibilityTest, FloatingIsTheHeightOverTheFloorOrOverTheSource) {
  Frame(1, 6).root_position.y() += 0.12;
  EXPECT_NEAR(Of(1).floating_m.value, 0.12, 1e-9);
  EXPECT_EQ(Of(1).floating_m.frame, 6);
  EXPECT_FALSE(Check(RequirementKind::kFloating, 1).met);
  source_[1].frames[6].root_position.y() += 0.10;  // a jump
  EXPECT_NEAR(Of(1).floating_m.value, 0.02, 1e-9);
  EXPECT_TRUE(Check(RequirementKind::kFloating, 1).met);
}

TEST_F(PlausibilityTest, AJointBeyondItsRangeCountsFromTheRangeOrTheSource) {
  // 154 degrees are the end of an elbow's range.
  const auto bent = [](double degrees) {
    return Quat(Eigen::AngleAxisd(degrees * kDegree, -Vec3::UnitY()));
  };
  Frame(0, 5).rotation[Link(0, "left_elbow")] = bent(172);
  EXPECT_NEAR(Of(0).joint_limit_deg.value, 18, 1e-6);
  EXPECT_EQ(NodeName(0, Of(0).joint_limit_deg), "left_wrist");
  const RequirementCheck check = Check(RequirementKind::kJointLimit, 0);
  EXPECT_FALSE(check.met);
  EXPECT_EQ(check.frame, 5);
  source_[0].frames[5].rotation[Link(0, "left_elbow")] = bent(166);
  EXPECT_NEAR(Of(0).joint_limit_deg.value, 6, 1e-6);
  EXPECT_TRUE(Check(RequirementKind::kJointLimit, 0).met);
}

TEST_F(PlausibilityTest, PoseErrorIsTheMeanOverNodesOfTheWorstFrame) {
  // Both arms down: shoulders' children move by a chord of their distance from the shoulder.
  const Body& body = subject_.body[0];
  double sum = 0;
  for (const char* side : {"left", "right"}) {
    const double x = side[0] == 'l' ? 1 : -1;
    const std::string s = side;
    Frame(0, 9).rotation[Link(0, (s + "_shoulder").c_str())] =
        Quat(Eigen::AngleAxisd(-x * kPi / 2, Vec3::UnitZ()));
    const double upper = body.SegmentLength(body.FindNode(s + "_elbow"));
    const double fore = upper + body.SegmentLength(body.FindNode(s + "_wrist"));
    const double hand = fore + body.SegmentLength(body.FindNode(s + "_hand"));
    sum += std::sqrt(2.0) * (upper + fore + hand);
  }
  EXPECT_NEAR(Of(0).pose_error_m.value, sum / (body.num_nodes() - 1), 1e-9);
  EXPECT_EQ(Of(0).pose_error_m.frame, 9);
  const std::string furthest = NodeName(0, Of(0).pose_error_m);
  EXPECT_TRUE(furthest == "left_hand" || furthest == "right_hand") << furthest;
}

TEST_F(PlausibilityTest, JerkIsComparedWithTheOwnClipsAndAStillClipCountsAsAPersonWhoStands) {
  const auto shaken = [](double size, std::array<Clip, 2>* clips) {
    for (int t = 0; t < kFrames; ++t) (*clips)[0].frames[t].root_position.x() += t % 2 ? size : 0;
  };
  // Third differences of +-size are 4 size.
  shaken(0.01, &motion_);
  const double jerk = 4 * 0.01 * 30 * 30 * 30;
  EXPECT_NEAR(Of(0).jerk_ratio.value, jerk / kStillJerk, 1e-9);
  EXPECT_FALSE(Check(RequirementKind::kJerk, 0).met);
  shaken(0.005, &source_);
  EXPECT_NEAR(Of(0).jerk_ratio.value, 2, 1e-9);
  EXPECT_TRUE(Check(RequirementKind::kJerk, 0).met);
}

}  // namespace
}  // namespace retarget::solver
