// Closest points of two segments against an oracle of another construction: the least of the four
// distances from an end to the other segment and, where it lies inside both, the common normal.
#include "model/geometry/capsule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace retarget {
namespace {

double PointToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length2 = (b - a).squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
  return (p - (a + s * (b - a))).norm();
}

double OracleDistance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double least = std::min({PointToSegment(a, c, d), PointToSegment(b, c, d),
                           PointToSegment(c, a, b), PointToSegment(d, a, b)});
  const Vec3 normal = (b - a).cross(d - c);
  if (normal.norm() <= 1e-7 * (b - a).norm() * (d - c).norm()) return least;
  // c - a = s (b - a) - t (d - c) + g normal.
  Mat3 m;
  m << b - a, c - d, normal;
  const Vec3 x = m.fullPivLu().solve(c - a);
  if (x[0] >= 0 && x[0] <= 1 && x[1] >= 0 && x[1] <= 1) {
    least = std::min(least, std::abs(x[2]) * normal.norm());
  }
  return least;
}

// Checks distance, ranges, points and normal; returns what was found.
ClosestPoints Checked(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                      double tolerance) {
  const ClosestPoints got = ClosestPointsOfSegments(a, b, c, d);
  EXPECT_NEAR(got.distance, OracleDistance(a, b, c, d), tolerance);
  EXPECT_GE(got.s, 0);
  EXPECT_LE(got.s, 1);
  EXPECT_GE(got.t, 0);
  EXPECT_LE(got.t, 1);
  const Vec3 separation = (a + got.s * (b - a)) - (c + got.t * (d - c));
  EXPECT_NEAR(separation.norm(), got.distance, 1e-14);
  EXPECT_NEAR(got.normal.norm(), 1, 1e-12);
  if (got.distance > 1e-9) {
    EXPECT_LT((separation / got.distance - got.normal).norm(), 1e-9);
  }
  return got;
}

class Capsule : public testing::Test {
 protected:
  Vec3 Point() {
    std::uniform_real_distribution<double> uniform(-1, 1);
    return Vec3(uniform(random_), uniform(random_), uniform(random_));
  }
  std::mt19937 random_{11};
};

TEST_F(Capsule, RandomSegmentsAgreeWithTheOracleInAllRegions) {
  int regions[3][3] = {};
  const auto region = [](double x) { return x <= 0 ? 0 : x >= 1 ? 2 : 1; };
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = Point(), c = Point();
    const double size = i % 2 ? 1 : 0.3;
    const ClosestPoints got = Checked(a, a + size * Point(), c, c + size * Point(), 1e-12);
    ++regions[region(got.s)][region(got.t)];
  }
  for (int s = 0; s < 3; ++s) {
    for (int t = 0; t < 3; ++t) EXPECT_GT(regions[s][t], 200) << s << " " << t;
  }
}

TEST_F(Capsule, ExchangeAndReversal) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = Point(), b = Point(), c = Point(), d = Point();
    const ClosestPoints one = ClosestPointsOfSegments(a, b, c, d);
    const ClosestPoints exchanged = ClosestPointsOfSegments(c, d, a, b);
    const ClosestPoints reversed = ClosestPointsOfSegments(b, a, c, d);
    EXPECT_NEAR(one.distance, exchanged.distance, 1e-13);
    EXPECT_NEAR(one.s, exchanged.t, 1e-9);
    EXPECT_NEAR(one.t, exchanged.s, 1e-9);
    EXPECT_LT((one.normal + exchanged.normal).norm(), 1e-8);
    EXPECT_NEAR(one.distance, reversed.distance, 1e-13);
    EXPECT_NEAR(one.s, 1 - reversed.s, 1e-9);
  }
}

TEST_F(Capsule, ParallelAndNearlyParallelSegments) {
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a = Point(), u = Point(), c = a + Point();
    std::uniform_real_distribution<double> uniform(-2, 2);
    const double tilts[] = {0, 1e-13, 1e-8, 1e-5, 1e-3};
    const Vec3 v = uniform(random_) * u + tilts[i % 5] * Point();
    // Axes within a microradian count as parallel, which costs that share of a length.
    Checked(a, a + u, c, c + v, 2e-6);
  }
  // Side by side, one beyond the other, and in one line.
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  EXPECT_NEAR(ClosestPointsOfSegments(0 * x, 2 * x, x + y, 3 * x + y).distance, 1, 1e-15);
  EXPECT_NEAR(ClosestPointsOfSegments(0 * x, x, 3 * x + y, 2 * x + y).distance, std::sqrt(2),
              1e-15);
  EXPECT_NEAR(ClosestPointsOfSegments(0 * x, x, 3 * x, 5 * x).distance, 2, 1e-15);
  EXPECT_NEAR(ClosestPointsOfSegments(0 * x, 2 * x, x, 5 * x).distance, 0, 1e-15);
}

TEST_F(Capsule, DegenerateSegments) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = Point(), b = Point(), c = Point();
    Checked(a, a, b, c, 1e-13);
    Checked(b, c, a, a, 1e-13);
    Checked(a, a, b, b, 1e-13);
  }
  const Vec3 p(1, 2, 3);
  const ClosestPoints same = ClosestPointsOfSegments(p, p, p, p);
  EXPECT_EQ(same.distance, 0);
  EXPECT_NEAR(same.normal.norm(), 1, 1e-15);
}

TEST_F(Capsule, CrossingSegmentsHaveANormalAcrossBoth) {
  for (int i = 0; i < 200; ++i) {
    const Vec3 u = Point(), v = Point();
    const ClosestPoints got = ClosestPointsOfSegments(-u, u, -0.5 * v, v);
    EXPECT_NEAR(got.distance, 0, 1e-14);
    EXPECT_NEAR(got.s, 0.5, 1e-9);
    EXPECT_NEAR(got.t, 1.0 / 3, 1e-9);
    EXPECT_NEAR(got.normal.norm(), 1, 1e-12);
  }
  const ClosestPoints meet =
      ClosestPointsOfSegments(-Vec3::UnitX(), Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitY());
  EXPECT_NEAR(std::abs(meet.normal.z()), 1, 1e-15);
}

TEST_F(Capsule, TheNormalIsTheGradientOfTheDistance) {
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    std::array<Vec3, 4> p = {Point(), Point(), Point(), Point()};
    const auto distance = [&] { return ClosestPointsOfSegments(p[0], p[1], p[2], p[3]).distance; };
    const ClosestPoints at = ClosestPointsOfSegments(p[0], p[1], p[2], p[3]);
    if (at.distance < 0.05) continue;
    const double share[4] = {1 - at.s, at.s, at.t - 1, -at.t};
    for (int k = 0; k < 4; ++k) {
      for (int c = 0; c < 3; ++c) {
        const double h = 1e-6, keep = p[k][c];
        p[k][c] = keep + h;
        const double plus = distance();
        p[k][c] = keep - h;
        const double minus = distance();
        p[k][c] = keep;
        EXPECT_NEAR((plus - minus) / (2 * h), share[k] * at.normal[c], 1e-4);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 4000);
}

TEST_F(Capsule, DepthIsTheSumOfTheRadiiLessTheDistance) {
  const ClosestPoints closest =
      ClosestPointsOfSegments(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, -1, 0.25), Vec3(0, 1, 0.25));
  EXPECT_NEAR(CapsuleDepth(closest, 0.2, 0.1), 0.05, 1e-15);
  EXPECT_NEAR(CapsuleDepth(closest, 0.1, 0.1), -0.05, 1e-15);
  EXPECT_LT((closest.normal + Vec3::UnitZ()).norm(), 1e-15);  // from q, above, down to p
}

}  // namespace
}  // namespace retarget
