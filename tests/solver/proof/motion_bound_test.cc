#include "solver/proof/motion_bound.h"

#include <gtest/gtest.h>

#include "solver/proof/gap_bound.h"
#include "tests/solver/proof/proof_fixture.h"

namespace retarget::solver {
namespace {

TEST(MotionBound, NoPointIsFasterOrMoreCrookedThanItsBound) {
  SceneMaker make(1);
  int checked = 0;
  double nearest_speed = 0, nearest_bend = 0;
  for (int trial = 0; trial < 200; ++trial) {
    RandomScene s = make.Make(2, make.Uniform(0.01, 2.5), 0.3, 0.3);
    // Some nodes slide too.
    for (const size_t n : {size_t{2}, size_t{8}}) {
      KeyedNode& node = s.motion.nodes[n];
      node.translation_track = static_cast<int>(s.motion.translation_tracks.size());
      s.motion.translation_tracks.push_back(
          {node.translation, node.translation + make.Within(0.1)});
    }
    std::vector<int> all(s.motion.nodes.size());
    for (size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
    MotionBounds bounds;
    BoundMotion(s.motion, all, 0, &bounds);
    const double h = 1e-4;
    for (double u = h; u < 1 - h; u += 0.04) {
      const PostureSample before = PlacesAt(s, 0, u - h), now = PlacesAt(s, 0, u),
                          after = PlacesAt(s, 0, u + h);
      for (size_t f = 0; f < 2; ++f) {
        for (size_t n = 0; n < 5; ++n) {
          const size_t id = static_cast<size_t>(s.node[f][n]);
          const Vec3 v = (after.node[f][n] - before.node[f][n]) / (2 * h) - bounds.carried[id];
          const Vec3 a = (after.node[f][n] - 2 * now.node[f][n] + before.node[f][n]) / (h * h);
          EXPECT_LE(v.norm(), bounds.speed[id] + 1e-6);
          EXPECT_LE(a.norm(), bounds.bend[id] + 1e-5);
          if (n == 0) continue;
          nearest_speed = std::max(nearest_speed, v.norm() / bounds.speed[id]);
          nearest_bend = std::max(nearest_bend, a.norm() / bounds.bend[id]);
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 30000);
  EXPECT_GT(nearest_speed, 0.95);  // a bound that is far away would say nothing
  EXPECT_GT(nearest_bend, 0.8);
}

TEST(MotionBound, SlerpAnglesAreExact) {
  SceneMaker make(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Quat q = ExpSo3(make.Uniform(0, 3) * make.Direction());
    const double angle = std::pow(10.0, make.Uniform(-9, 0.49));
    const Quat p = q * ExpSo3(angle * make.Direction());
    EXPECT_NEAR(ArcBetween(q, p), angle, 1e-14 + 1e-12 * angle);
    EXPECT_NEAR(ArcBetween(q, Quat(-p.coeffs())), angle, 1e-14 + 1e-12 * angle);
  }
}

// Two segments that move by rigid joints come no nearer than the bound, and hardly ever much
// farther: the bound errs by the square of the stretch.
TEST(GapBound, IsNeverAboveTheDistanceAndNearIt) {
  SceneMaker make(3);
  int useful = 0, near = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const RandomScene s = make.Make(2, make.Uniform(0.02, 0.5), 0.05, 0.3);
    std::vector<int> all(s.motion.nodes.size());
    for (size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
    MotionBounds bounds;
    BoundMotion(s.motion, all, 0, &bounds);
    const PostureSample p0 = PlacesAt(s, 0, 0), p1 = PlacesAt(s, 0, 1);
    std::array<std::array<MovingPoint, 2>, 2> ends;
    for (size_t f = 0; f < 2; ++f) {
      for (size_t e = 0; e < 2; ++e) {
        const size_t n = e + 1, id = static_cast<size_t>(s.node[f][n]);
        ends[f][e] = {p0.node[f][n], p1.node[f][n], bounds.speed[id], bounds.bend[id]};
      }
    }
    const auto gap = [&](const PostureSample& at) -> Gap {
      const ClosestPoints c =
          ClosestPointsOfSegments(at.node[0][1], at.node[0][2], at.node[1][1], at.node[1][2]);
      return {c.distance, c.normal};
    };
    const double carried = (bounds.carried[0] - bounds.carried[5]).norm();
    const double bound =
        GapBound({&ends[0][0], &ends[0][1]}, {&ends[1][0], &ends[1][1]}, gap(p0), gap(p1), carried);
    double least = 1e9;
    for (int k = 0; k <= 256; ++k) least = std::min(least, gap(PlacesAt(s, 0, k / 256.0)).distance);
    EXPECT_LE(bound, least);
    useful += bound > 0;
    near += bound > 0.8 * least;
  }
  EXPECT_GT(useful, 2000);
  EXPECT_GT(near, 1000);
}

TEST(GapBound, DistancesOfPointsAreBounded) {
  SceneMaker make(4);
  for (int trial = 0; trial < 2000; ++trial) {
    // p moves on a parabola, whose second derivative is its bend.
    const Vec3 p = make.Within(0.2), v = make.Within(0.2), a = make.Within(0.2);
    const auto at = [&](double u) -> Vec3 { return p + u * v + 0.5 * u * u * a; };
    const MovingPoint moving{at(0), at(1), 1, a.norm()};
    const MovingPoint still;
    for (int k = 0; k <= 64; ++k) {
      const double d = at(k / 64.0).norm();
      EXPECT_LE(d, LargestDistance(moving, still));
      EXPECT_GE(d, LeastDistance(moving, still));
      EXPECT_LE((v + k / 64.0 * a).norm(), RelativeSpeed(moving, still, 9) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace retarget::solver
