// The rotation group against oracles that share nothing with it: the power series of the matrix
// exponential, central differences, and searches by brute force.
#include "model/geometry/so3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace retarget {
namespace {

// exp([v]x) by scaling, 24 terms of the power series, and squaring.
Mat3 SeriesExp(const Vec3& v) {
  const Mat3 k = Skew(v) / 64;
  Mat3 sum = Mat3::Identity(), power = Mat3::Identity();
  for (int i = 1; i <= 24; ++i) {
    power = power * k / i;
    sum += power;
  }
  for (int i = 0; i < 6; ++i) sum = (sum * sum).eval();
  return sum;
}

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double Uniform(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(generator_);
  }
  Vec3 Unit() {
    std::normal_distribution<double> normal;
    return Vec3(normal(generator_), normal(generator_), normal(generator_)).normalized();
  }
  Quat Rotation() {
    std::normal_distribution<double> n;
    return Quat(n(generator_), n(generator_), n(generator_), n(generator_)).normalized();
  }

 private:
  std::mt19937 generator_;
};

// Angles (rad) at which a formula may change its form, and what lies between.
const std::vector<double> kAngles = {0,      1e-12, 1e-9, 0.9e-8, 1.1e-8,     1e-6,      0.9e-4,
                                     1.1e-4, 1e-2,  0.5,  1.5,    kPi - 1e-3, kPi - 1e-6};

TEST(So3, ExpIsTheSeriesOfTheMatrixExponential) {
  Random random(1);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Vec3 v = angle * random.Unit();
      const Quat q = ExpSo3(v);
      EXPECT_NEAR(q.norm(), 1, 1e-15);
      EXPECT_LT((q.toRotationMatrix() - SeriesExp(v)).cwiseAbs().maxCoeff(), 2e-14) << angle;
    }
  }
  // Whole and half turns and more.
  for (const double angle : {kPi, 1.5 * kPi, 2 * kPi, 9.0}) {
    const Vec3 v = angle * random.Unit();
    EXPECT_LT((ExpSo3(v).toRotationMatrix() - SeriesExp(v)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(So3, LogUndoesExpUpToHalfATurnWithEitherSignOfTheQuaternion) {
  Random random(2);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Vec3 v = angle * random.Unit();
      const Quat q = ExpSo3(v);
      const Quat minus(-q.w(), -q.x(), -q.y(), -q.z());
      EXPECT_LT((LogSo3(q) - v).norm(), 1e-14 + 1e-13 * angle) << angle;
      EXPECT_LT((LogSo3(minus) - v).norm(), 1e-14 + 1e-13 * angle) << angle;
    }
  }
}

TEST(So3, LogIsNeverLongerThanHalfATurn) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Quat q = random.Rotation();
    const Vec3 v = LogSo3(q);
    EXPECT_LE(v.norm(), kPi + 1e-15);
    EXPECT_LT((SeriesExp(v) - q.toRotationMatrix()).cwiseAbs().maxCoeff(), 1e-13);
    // cos of the angle from the trace.
    EXPECT_NEAR(std::cos(v.norm()), (q.toRotationMatrix().trace() - 1) / 2, 1e-14);
  }
  EXPECT_EQ(LogSo3(Quat::Identity()), Vec3::Zero());
  EXPECT_NEAR(LogSo3(Quat(0, 0, 1, 0)).norm(), kPi, 1e-15);
}

TEST(So3, NearLogarithmFollowsATurnBeyondPi) {
  for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(0.6, 0, -0.8), Vec3(2, -1, 2).normalized().eval()}) {
    Vec3 last = Vec3::Zero();
    for (int k = 0; k <= 100; ++k) {
      const double angle = 1.7 * kPi * k / 100;
      const Quat q = ExpSo3(angle * axis);
      const Quat minus(-q.w(), -q.x(), -q.y(), -q.z());
      for (const Quat& same : {q, minus}) {
        EXPECT_LT((LogSo3Near(same, last) - angle * axis).norm(), 1e-12) << angle;
      }
      EXPECT_LT((LogSo3Near(q, Vec3::Zero()) - LogSo3(q)).norm(), 1e-12) << "the shortest";
      last = angle * axis;
    }
    // Further round it starts again, before the exponential map becomes singular.
    EXPECT_NEAR(LogSo3Near(ExpSo3(1.8 * kPi * axis), last).norm(), 0.2 * kPi, 1e-12);
  }
}

TEST(So3, RightJacobianInverseBeyondPi) {
  for (const double angle : {kPi - 1e-9, kPi, kPi + 1e-9, 1.3 * kPi, 1.7 * kPi}) {
    const Vec3 v = angle * Vec3(2, -1, 2).normalized();
    EXPECT_LT((RightJacobianInverse(v) * RightJacobian(v) - Mat3::Identity()).norm(), 1e-12);
  }
}

TEST(So3, RightJacobianIsTheDerivativeOfTheExponential) {
  Random random(4);
  const double h = 1e-5;
  for (const double angle : kAngles) {
    for (int i = 0; i < 10; ++i) {
      const Vec3 v = angle * random.Unit();
      const Mat3 r = SeriesExp(v), j = RightJacobian(v);
      for (int c = 0; c < 3; ++c) {
        const Vec3 d = h * Vec3::Unit(c);
        const Mat3 w = r.transpose() * (SeriesExp(v + d) - SeriesExp(v - d)) / (2 * h);
        const Vec3 column(w(2, 1), w(0, 2), w(1, 0));
        EXPECT_LT((column - j.col(c)).norm(), 1e-9) << angle;
      }
    }
  }
}

TEST(So3, RightJacobianInverseIsTheDerivativeOfTheLogarithmAndTheInverse) {
  Random random(5);
  const double h = 1e-5;
  for (const double angle : kAngles) {
    if (angle > kPi - 1e-4) continue;  // the logarithm jumps within the step
    for (int i = 0; i < 10; ++i) {
      const Vec3 v = angle * random.Unit();
      const Mat3 inverse = RightJacobianInverse(v);
      EXPECT_LT((inverse * RightJacobian(v) - Mat3::Identity()).norm(), 1e-12) << angle;
      for (int c = 0; c < 3; ++c) {
        const Vec3 d = h * Vec3::Unit(c);
        const Vec3 column = (LogSo3(Quat(Mat3(SeriesExp(v) * SeriesExp(d)))) -
                             LogSo3(Quat(Mat3(SeriesExp(v) * SeriesExp(-d))))) /
                            (2 * h);
        EXPECT_LT((column - inverse.col(c)).norm(), 1e-8) << angle;
      }
    }
  }
  EXPECT_TRUE(RightJacobianInverse(Vec3(kPi, 0, 0)).allFinite());
}

TEST(So3, SkewIsTheCrossProduct) {
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    const Vec3 v = random.Unit(), w = random.Unit();
    EXPECT_LT((Skew(v) * w - v.cross(w)).norm(), 1e-15);
  }
}

TEST(So3, RotationBetweenArrivesByTheSmallestTurn) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = random.Unit();
    Vec3 to = random.Unit();
    if (i % 4 == 1) to = (from + 1e-7 * random.Unit()).normalized();
    if (i % 4 == 2) to = (-from + 1e-3 * random.Unit()).normalized();
    const Quat q = RotationBetween(from, to);
    EXPECT_LT((q * from - to).norm(), 1e-11);
    const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
    EXPECT_NEAR(LogSo3(q).norm(), angle, 1e-11);
  }
  for (const Vec3& from : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0, -0.8)}) {
    const Quat q = RotationBetween(from, -from);
    EXPECT_LT((q * from + from).norm(), 1e-14);
    EXPECT_NEAR(LogSo3(q).norm(), kPi, 1e-14);
    EXPECT_LT((RotationBetween(from, from).toRotationMatrix() - Mat3::Identity()).norm(), 1e-15);
  }
}

TEST(So3, TwistLeavesASwingWithoutTurnAboutTheAxis) {
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const Quat q = random.Rotation();
    const Vec3 axis = random.Unit();
    const Quat twist = TwistAbout(q, axis);
    EXPECT_NEAR(twist.norm(), 1, 1e-14);
    EXPECT_LT((twist * axis - axis).norm(), 1e-14);
    const Quat swing = q * twist.conjugate();
    EXPECT_LT((swing * axis - q * axis).norm(), 1e-13);
    EXPECT_NEAR(LogSo3(swing).dot(axis), 0, 1e-12);  // its own turn has no part about the axis
  }
  // What was put together comes apart.
  for (const double turn : {-2.5, -0.3, 0.0, 1.0, 3.0}) {
    const Vec3 axis = random.Unit();
    const Vec3 across = axis.cross(random.Unit()).normalized();
    const Quat q = ExpSo3(1.2 * across) * ExpSo3(turn * axis);
    EXPECT_LT((LogSo3(TwistAbout(q, axis)) - turn * axis).norm(), 1e-13);
  }
  // Half a turn of the axis leaves the twist undefined.
  EXPECT_EQ(TwistAbout(Quat(0, 1, 0, 0), Vec3::UnitY()).w(), 1);
}

TEST(So3, YawIsTheTurnAboutTheVerticalThatAgreesBest) {
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const Quat q = random.Rotation();
    const Mat3 r = q.toRotationMatrix();
    const auto agreement = [&](double yaw) {
      return (r.transpose() * SeriesExp(Vec3(0, yaw, 0))).trace();
    };
    double best = -10;
    for (int k = 0; k < 720; ++k) best = std::max(best, agreement(k * kPi / 360));
    EXPECT_GE(agreement(YawOf(q)), best - 1e-12);
  }
  for (const double yaw : {-3.0, -0.5, 0.0, 0.1, 2.0, 3.1}) {
    EXPECT_NEAR(YawOf(YawRotation(yaw)), yaw, 1e-14);
    EXPECT_LT((YawRotation(yaw).toRotationMatrix() - SeriesExp(Vec3(0, yaw, 0))).norm(), 1e-14);
    const Vec3 ahead = YawRotation(yaw) * Vec3::UnitZ();  // +Z turns towards +X
    EXPECT_NEAR(std::atan2(ahead.x(), ahead.z()), yaw, 1e-14);
  }
}

}  // namespace
}  // namespace retarget
