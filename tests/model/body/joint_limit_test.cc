// Limits of joints: rotations made from known angles, published ranges by hand, mirrored sides, and
// derivatives by differences.
#include "model/body/joint_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/geometry/so3.h"

namespace retarget {
namespace {

Quat Turn(double degrees, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(degrees * kDegree, axis.normalized()));
}

// Of the standard body in the rest pose but for these rotations (deg).
double Beyond(const std::string& joint, const Quat& rotation, const Quat& parent) {
  const Body body = StandardBody(AverageMeasures(1.75));
  Pose pose = RestPose(body);
  const int link = body.FindLink(joint);
  pose.rotation[link] = rotation;
  pose.rotation[body.links[link].parent] = parent;
  return FurthestBeyondLimit(body, link, pose) / kDegree;
}
double Beyond(const std::string& joint, const Quat& rotation) {
  return Beyond(joint, rotation, Quat::Identity());
}

const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

// In the rest pose the left arm points to +x, palms down: the wrist bends to the palm about -z and
// to the little finger about +y; the forearm turns its palm back (thumb down) about +x.
TEST(JointLimit, AWristBendsAsFarAsPublishedInEachDirection) {
  EXPECT_NEAR(Beyond("left_wrist", Turn(100, -kZ)), 100 - 89, 1e-9);
  EXPECT_NEAR(Beyond("left_wrist", Turn(100, kZ)), 100 - 88, 1e-9);
  EXPECT_NEAR(Beyond("left_wrist", Turn(50, kY)), 50 - 44, 1e-9);
  EXPECT_NEAR(Beyond("left_wrist", Turn(50, -kY)), 50 - 30, 1e-9);
  EXPECT_NEAR(Beyond("right_wrist", Turn(50, -kY)), 50 - 44, 1e-9);
  EXPECT_NEAR(Beyond("right_wrist", Turn(50, kY)), 50 - 30, 1e-9);
  // Of 60 to the little finger and 60 to the palm at once, |w| - |w| / rho by hand.
  const double w = std::hypot(60.0, 60.0), rho = std::hypot(60 / 89.0, 60 / 44.0);
  EXPECT_NEAR(Beyond("left_wrist", ExpSo3(60 * kDegree * Vec3(0, 1, -1))), w - w / rho, 1e-6);
}

TEST(JointLimit, TheTurnOfTheForearmDoesNotTurnTheAxesOfTheWrist) {
  // A hand whose rig leaves all of the forearm's turn to the wrist.
  for (const double turn : {-15.0, 0.0, 18.0}) {
    EXPECT_NEAR(Beyond("left_wrist", Turn(turn, kX) * Turn(60, kY)), 60 - 44, 1e-6) << turn;
    EXPECT_LT(Beyond("left_wrist", Turn(turn, kX) * Turn(60, kZ)), 0) << turn;
  }
}

TEST(JointLimit, ForearmAndWristTwistTogether) {
  // Of 86 inward the forearm takes 80, the wrist 15: 9 too many.
  EXPECT_NEAR(Beyond("left_wrist", Turn(15, kX), Turn(80, kX)), 9, 1e-9);
  EXPECT_NEAR(Beyond("right_wrist", Turn(15, kX), Turn(80, kX)), 9, 1e-9);
  EXPECT_LT(Beyond("left_wrist", Turn(15, kX), Turn(-80, kX)), 0);
  EXPECT_NEAR(Beyond("left_wrist", Turn(-15, kX), Turn(-80, kX)), 5, 1e-9);
}

TEST(JointLimit, ElbowsAndKneesBendOneWay) {
  for (const std::string side : {"left", "right"}) {
    const double x = side == "left" ? 1 : -1;
    EXPECT_LT(Beyond(side + "_elbow", Turn(150, -x * kY)), 0);
    EXPECT_NEAR(Beyond(side + "_elbow", Turn(40, x * kY)), 40 - 7, 1e-9);
    EXPECT_NEAR(Beyond(side + "_elbow", Turn(40, kZ)), 40 - 10, 1e-9);
    EXPECT_LT(Beyond(side + "_knee", Turn(150, kX)), 0);
    EXPECT_NEAR(Beyond(side + "_knee", Turn(40, -kX)), 40 - 8, 1e-9);
    EXPECT_NEAR(Beyond(side + "_knee", Turn(40, kZ)), 40 - 10, 1e-9);
  }
}

// Mean ranges of Boone and Azen 1979 and of the AAOS 1965, of arms and legs that start where they
// hang or stand; none may lie beyond a limit, and half as much again must.
TEST(JointLimit, PublishedRangesLieWithin) {
  const Quat hanging = Turn(-90, kZ);  // the left arm down
  struct Range {
    const char* joint;
    double degrees;
    Vec3 axis;
    Quat from;
  };
  const std::vector<Range> ranges = {
      {"left_shoulder", 62, kX, hanging},  // backwards
      {"left_shoulder", 90, kZ, hanging},  // sideways up to the horizontal, from where the blade
      {"left_shoulder", 135, -kY, Quat::Identity()},  // goes along; then across the body
      {"left_hip", 122, -kX, Quat::Identity()},
      {"left_hip", 10, kX, Quat::Identity()},
      {"left_hip", 46, kZ, Quat::Identity()},
      {"left_hip", 27, -kZ, Quat::Identity()},
      {"left_elbow", 143, -kY, Quat::Identity()},
      {"left_knee", 143, kX, Quat::Identity()},
      {"neck", 35, kZ, Quat::Identity()},
      {"neck", 50, kY, Quat::Identity()},
      {"waist", 60, kX, Quat::Identity()},
      {"waist", 35, -kX, Quat::Identity()}};
  for (const Range& r : ranges) {
    EXPECT_LE(Beyond(r.joint, Turn(r.degrees, r.axis) * r.from), 1e-6) << r.joint << r.degrees;
    if (std::string(r.joint) == "left_shoulder") continue;  // the blade carries it on
    const double more =
        std::string(r.joint) == "left_hip" && r.degrees == 10 ? 70 : 1.5 * r.degrees;
    EXPECT_GT(Beyond(r.joint, Turn(more, r.axis) * r.from), 0) << r.joint << r.degrees;
  }
  EXPECT_GT(Beyond("left_shoulder", Turn(180, kY)), 10);  // the arm through the trunk
}

TEST(JointLimit, TheRightSideIsTheMirrorImageOfTheLeft) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int beyond = 0;
  for (const std::string joint :
       {"clavicle", "shoulder", "elbow", "wrist", "hip", "knee", "ankle"}) {
    for (int k = 0; k < 200; ++k) {
      const Vec3 v(normal(random), normal(random), normal(random));
      const Vec3 u(normal(random), normal(random), normal(random));
      const auto mirrored = [](const Vec3& w) { return ExpSo3(Vec3(w.x(), -w.y(), -w.z())); };
      const double left = Beyond("left_" + joint, ExpSo3(v), ExpSo3(u));
      EXPECT_NEAR(Beyond("right_" + joint, mirrored(v), mirrored(u)), left, 1e-6) << joint;
      beyond += left > 0;
    }
  }
  EXPECT_GT(beyond, 300);
}

TEST(JointLimit, DerivativesMatchCentralDifferences) {
  constexpr double kStep = 1e-6;
  const Body body = StandardBody(AverageMeasures(1.75));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int checked = 0;
  for (int round = 0; round < 40; ++round) {
    Pose pose = RestPose(body);
    for (Quat& q : pose.rotation) {
      q = ExpSo3(0.8 * Vec3(normal(random), normal(random), normal(random)));
    }
    for (int l = 1; l < body.num_links(); ++l) {
      Body own = body;
      own.links[l].limit.reach = 0.3;
      const std::vector<LimitExcess> at = LimitExcesses(own, l, pose);
      for (const int turned : {l, body.links[l].parent}) {
        for (int c = 0; c < 3; ++c) {
          const auto moved = [&](double step) {
            Pose p = pose;
            p.rotation[turned] = p.rotation[turned] * ExpSo3(step * Vec3::Unit(c));
            return LimitExcesses(own, l, p);
          };
          const std::vector<LimitExcess> plus = moved(kStep), minus = moved(-kStep);
          for (size_t k = 0; k < at.size(); ++k) {
            const double slope = (plus[k].beyond - minus[k].beyond) / (2 * kStep);
            const Vec3& g = turned == l ? at[k].gradient : at[k].by_parent;
            EXPECT_NEAR(g[c], slope, 1e-6 * (1 + std::abs(slope))) << body.links[l].name << k;
            ++checked;
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 15000);
}

}  // namespace
}  // namespace retarget
