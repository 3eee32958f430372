#include "solver/proof/gli_bound.h"

#include <gtest/gtest.h>

#include "tests/solver/proof/proof_fixture.h"

namespace retarget::solver {
namespace {

// A pair of random paths and a velocity for every point.
struct MovingPaths {
  std::array<std::vector<Vec3>, 2> point, velocity;

  std::array<std::vector<Vec3>, 2> At(double u) const {
    std::array<std::vector<Vec3>, 2> out = point;
    for (size_t f = 0; f < 2; ++f) {
      for (size_t i = 0; i < out[f].size(); ++i) out[f][i] += u * velocity[f][i];
    }
    return out;
  }
  double Gli(double u) const {
    const auto p = At(u);
    return PolylineGli(p[0], p[1]);
  }
  double Distance() const {
    double least = 1e9;
    for (size_t i = 0; i + 1 < point[0].size(); ++i) {
      for (size_t j = 0; j + 1 < point[1].size(); ++j) {
        least = std::min(least, ClosestPointsOfSegments(point[0][i], point[0][i + 1], point[1][j],
                                                        point[1][j + 1])
                                    .distance);
      }
    }
    return least;
  }
};

MovingPaths RandomPaths(SceneMaker* make) {
  MovingPaths paths;
  for (size_t f = 0; f < 2; ++f) {
    const int points = 2 + static_cast<int>(make->Uniform(0, 7.999));
    for (int i = 0; i < points; ++i) {
      paths.point[f].push_back(make->Within(0.5));
      paths.velocity[f].push_back(make->Within(0.3));
    }
  }
  return paths;
}

double Derivative(const MovingPaths& paths) {
  const double h = 1e-5;
  return (paths.Gli(h) - paths.Gli(-h)) / (2 * h);
}

// The change that the four ends make, each against the other path: the triple product integrated
// along the segments by midpoints. Independent of the gradient in use.
double ChangeOfEnds(const MovingPaths& paths) {
  double sum = 0;
  for (size_t f = 0; f < 2; ++f) {
    const std::vector<Vec3>&line = paths.point[1 - f], &speed = paths.velocity[1 - f];
    for (const bool last : {false, true}) {
      const Vec3 e = last ? paths.point[f].back() : paths.point[f].front();
      const Vec3 v = last ? paths.velocity[f].back() : paths.velocity[f].front();
      for (size_t i = 0; i + 1 < line.size(); ++i) {
        constexpr int kParts = 2000;
        const Vec3 along = (line[i + 1] - line[i]) / kParts;
        for (int k = 0; k < kParts; ++k) {
          const double u = (k + 0.5) / kParts;
          const Vec3 r = line[i] + u * (line[i + 1] - line[i]) - e;
          const Vec3 relative = speed[i] + u * (speed[i + 1] - speed[i]) - v;
          sum += (last ? 1 : -1) * relative.cross(along).dot(r) / std::pow(r.norm(), 3);
        }
      }
    }
  }
  return sum / (4 * kPi);
}

TEST(TagLemma, TheEndsAloneMakeTheDerivative) {
  SceneMaker make(12);
  int checked = 0;
  for (int trial = 0; trial < 400 && checked < 60; ++trial) {
    const MovingPaths paths = RandomPaths(&make);
    if (paths.Distance() < 0.05) continue;
    EXPECT_NEAR(Derivative(paths), ChangeOfEnds(paths), 2e-6);
    ++checked;
  }
  EXPECT_EQ(checked, 60);
}

TEST(TagLemma, NoChangeIsLargerThanItsBound) {
  SceneMaker make(13);
  int checked = 0;
  double nearest = 0, nearest_bend = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const MovingPaths paths = RandomPaths(&make);
    if (paths.Distance() < 0.01) continue;
    const double h = std::pow(10.0, make.Uniform(-4, -1));  // length of the stretch
    const auto p1 = paths.At(h);
    std::array<std::vector<MovingPoint>, 2> moving;
    std::array<std::vector<const MovingPoint*>, 2> pointers;
    for (size_t f = 0; f < 2; ++f) {
      for (size_t i = 0; i < paths.point[f].size(); ++i) {
        moving[f].push_back({paths.point[f][i], p1[f][i], h * paths.velocity[f][i].norm(), 0});
      }
      for (const MovingPoint& m : moving[f]) pointers[f].push_back(&m);
    }
    // The lemma is about paths that do not meet.
    MovingPaths end = paths;
    end.point = p1;
    if (0.5 * (paths.Distance() + end.Distance()) < 1.1 * h) continue;
    const GliChange change = BoundGliChange(pointers[0], pointers[1], 0);
    const double g0 = paths.Gli(0), g1 = paths.Gli(h);
    for (int k = 0; k <= 8; ++k) {
      const double g = paths.Gli(h * k / 8);
      EXPECT_GE(g, GliBound(g0, g1, change));
      EXPECT_GE(-g, GliBound(-g0, -g1, change));
    }
    ++checked;
    if (!std::isfinite(change.slope)) continue;
    nearest = std::max(nearest, std::abs(g1 - g0) / change.slope);
    const double second = g0 - 2 * paths.Gli(h / 2) + g1;
    EXPECT_LE(4 * std::abs(second), change.bend + 1e-12);
    nearest_bend = std::max(nearest_bend, 4 * std::abs(second) / change.bend);
  }
  EXPECT_GT(checked, 1000);
  EXPECT_GT(nearest, 0.3);  // a bound that is far away would say nothing
  EXPECT_GT(nearest_bend, 0.1);
}

}  // namespace
}  // namespace retarget::solver
