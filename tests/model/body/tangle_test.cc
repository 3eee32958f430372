// Linking of polylines and tangles of bodies: topology counted in a projection, the invariances of
// Eq. 1, brute force over all paths, and derivatives by central differences.
#include "model/body/tangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "model/geometry/gli.h"
#include "model/geometry/polyline.h"
#include "model/geometry/so3.h"

namespace retarget {
namespace {

using Polyline = std::vector<Vec3>;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double Uniform(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(generator_);
  }
  Vec3 Point() { return Vec3(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1)); }
  Polyline Line(int points) {
    Polyline line;
    for (int i = 0; i < points; ++i) line.push_back(Point());
    return line;
  }

 private:
  std::mt19937 generator_;
};

// Linking number of two closed polygons, counted in the projection along z: half the sum of the
// signs of all crossings of one with the other.
int CountedLinking(const Polyline& p, const Polyline& q) {
  int sum = 0;
  for (size_t i = 0; i + 1 < p.size(); ++i) {
    for (size_t j = 0; j + 1 < q.size(); ++j) {
      const Vec3 u = p[i + 1] - p[i], v = q[j + 1] - q[j], w = q[j] - p[i];
      const double across = u.x() * v.y() - u.y() * v.x();
      const double s = (w.x() * v.y() - w.y() * v.x()) / across;
      const double t = (w.x() * u.y() - w.y() * u.x()) / across;
      if (s <= 0 || s >= 1 || t <= 0 || t >= 1) continue;
      const double above = (p[i].z() + s * u.z()) - (q[j].z() + t * v.z());
      sum += across * above > 0 ? 1 : -1;
    }
  }
  EXPECT_EQ(sum % 2, 0);
  return sum / 2;
}

Polyline Closed(Polyline line) {
  line.push_back(line.front());
  return line;
}

TEST(Linking, RandomClosedPolygonsGiveTheCountedInteger) {
  Random random(21);
  int linked = 0;
  for (int i = 0; i < 300; ++i) {
    const Polyline p = Closed(random.Line(4 + i % 9)), q = Closed(random.Line(3 + i % 7));
    const int counted = CountedLinking(p, q);
    EXPECT_NEAR(PolylineGli(p, q), counted, 1e-10);
    linked += counted != 0;
  }
  EXPECT_GT(linked, 60);
}

TEST(Linking, ARingWoundSeveralTimesRoundAnotherCountsItsTurns) {
  for (const int turns : {-3, -1, 1, 2, 5}) {
    Polyline ring, wound;
    for (int k = 0; k < 24; ++k) {
      const double a = 2 * kPi * k / 24;
      ring.emplace_back(std::cos(a), std::sin(a), 0);
    }
    for (int k = 0; k < 120; ++k) {
      const double a = 2 * kPi * k / 120, r = 1 + 0.3 * std::cos(turns * a);
      wound.emplace_back(r * std::cos(a), r * std::sin(a), 0.3 * std::sin(turns * a));
    }
    const Quat turn = ExpSo3(Vec3(0.3, 0.5, -0.2));  // no crossing at a corner in the projection
    for (Vec3& x : ring) x = turn * x;
    for (Vec3& x : wound) x = turn * x;
    const double gli = PolylineGli(Closed(ring), Closed(wound));
    EXPECT_NEAR(std::abs(gli), std::abs(turns), 1e-10);
    EXPECT_NEAR(gli, CountedLinking(Closed(ring), Closed(wound)), 1e-10);
  }
}

TEST(Gli, InvariancesOfEq1) {
  Random random(22);
  for (int i = 0; i < 100; ++i) {
    const Polyline p = random.Line(2 + i % 5), q = random.Line(2 + i % 4);
    const double gli = PolylineGli(p, q);
    EXPECT_NEAR(PolylineGli(q, p), gli, 1e-12);
    const Polyline back(p.rbegin(), p.rend());
    EXPECT_NEAR(PolylineGli(back, q), -gli, 1e-12);
    const Quat turn = ExpSo3(3 * random.Point());
    const Vec3 shift = 5 * random.Point();
    const double size = random.Uniform(0.01, 50);
    const auto apply = [](Polyline line, const auto& map) {
      for (Vec3& x : line) x = map(x);
      return line;
    };
    const auto rigid = [&](const Vec3& x) -> Vec3 { return turn * x + shift; };
    const auto larger = [&](const Vec3& x) -> Vec3 { return size * x; };
    const auto mirror = [&](const Vec3& x) { return Vec3(-x.x(), x.y(), x.z()); };
    EXPECT_NEAR(PolylineGli(apply(p, rigid), apply(q, rigid)), gli, 1e-11);
    EXPECT_NEAR(PolylineGli(apply(p, larger), apply(q, larger)), gli, 1e-12);
    EXPECT_NEAR(PolylineGli(apply(p, mirror), apply(q, mirror)), -gli, 1e-12);
    // A point put into the middle of a segment adds nothing.
    Polyline cut = p;
    cut.insert(cut.begin() + 1, 0.3 * p[0] + 0.7 * p[1]);
    EXPECT_NEAR(PolylineGli(cut, q), gli, 1e-11);
  }
}

// Eq. 1 by the midpoint rule.
TEST(Gli, SegmentPairsAreTheDoubleIntegral) {
  Random random(23);
  int checked = 0;
  while (checked < 30) {
    const Vec3 a = random.Point(), b = random.Point(), c = random.Point(), d = random.Point();
    const int n = 120;
    double sum = 0, nearest = 10;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Vec3 r = a + (i + 0.5) / n * (b - a) - c - (j + 0.5) / n * (d - c);
        nearest = std::min(nearest, r.norm());
        sum += (b - a).cross(d - c).dot(r) / std::pow(r.norm(), 3);
      }
    }
    if (nearest < 0.2) continue;  // the rule is too coarse there
    EXPECT_NEAR(SegmentGli(a, b, c, d), sum / (n * n) / (4 * kPi), 2e-5);
    ++checked;
  }
}

TEST(Gli, ASegmentThatPassesThroughAnotherJumpsByOne) {
  Random random(24);
  for (int i = 0; i < 50; ++i) {
    const Vec3 u = random.Point(), v = random.Point(), n = u.cross(v).normalized();
    const double s = random.Uniform(0.2, 0.8), t = random.Uniform(0.2, 0.8);
    for (const double gap : {1e-6, 1e-9}) {
      const auto at = [&](double g) {
        const Vec3 shift = g * n;
        return SegmentGli(-s * u + shift, (1 - s) * u + shift, -t * v, (1 - t) * v);
      };
      EXPECT_NEAR(at(gap), 0.5, 100 * gap);
      EXPECT_NEAR(at(-gap), -0.5, 100 * gap);
    }
    // The gradient is the same on both sides, as the far ends see no difference.
    const auto gradient = [&](double g) {
      const Vec3 shift = g * n;
      return SegmentGliWithGradient(-s * u + shift, (1 - s) * u + shift, -t * v, (1 - t) * v)
          .gradient;
    };
    const auto above = gradient(1e-7), below = gradient(-1e-7);
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT((above[k] - below[k]).norm(), 1e-4 * (1 + above[k].norm()));
      EXPECT_GT(above[k].norm(), 0);
    }
  }
}

TEST(Gli, PolylineGradientMatchesDifferencesAndTheSumOfSegmentGradients) {
  Random random(25);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    Polyline p = random.Line(2 + i % 6), q = random.Line(2 + i % 5);
    const PathGli got = PolylineGliWithGradient(p, q);
    EXPECT_EQ(got.value, PolylineGli(p, q));
    Polyline sum_p(p.size(), Vec3::Zero()), sum_q(q.size(), Vec3::Zero());
    double largest = 0;
    for (size_t k = 0; k + 1 < p.size(); ++k) {
      for (size_t l = 0; l + 1 < q.size(); ++l) {
        const auto g = SegmentGliWithGradient(p[k], p[k + 1], q[l], q[l + 1]).gradient;
        sum_p[k] += g[0], sum_p[k + 1] += g[1], sum_q[l] += g[2], sum_q[l + 1] += g[3];
        for (const Vec3& x : g) largest = std::max(largest, x.norm());
      }
    }
    const auto check = [&](Polyline* line, const Polyline& sum, const Polyline& gradient) {
      for (size_t k = 0; k < line->size(); ++k) {
        EXPECT_LT((gradient[k] - sum[k]).norm(), 1e-11 * (1 + largest));
        for (int c = 0; c < 3; ++c) {
          const double h = 1e-6, keep = (*line)[k][c];
          (*line)[k][c] = keep + h;
          const double plus = PolylineGli(p, q);
          (*line)[k][c] = keep - h;
          const double minus = PolylineGli(p, q);
          (*line)[k][c] = keep;
          if (std::abs(plus - minus) > 0.4) continue;  // the step went through a segment
          EXPECT_NEAR(gradient[k][c], (plus - minus) / (2 * h), 1e-5 * (1 + largest));
          ++checked;
        }
      }
    };
    check(&p, sum_p, got.gradient_p);
    check(&q, sum_q, got.gradient_q);
  }
  EXPECT_GT(checked, 1000);
}

// Two bodies in wild postures close to each other.
struct Tangled {
  Tangled(const Body& body_a, const Body& body_b, Random* random, double wildness)
      : a(body_a), b(body_b), pose_a(RestPose(a)), pose_b(RestPose(b)) {
    for (Quat& q : pose_a.rotation) q = ExpSo3(wildness * random->Point());
    for (Quat& q : pose_b.rotation) q = ExpSo3(wildness * random->Point());
    pose_b.root_position = 0.25 * random->Point();
  }
  PosedBody PosedA() const { return PoseBody(a, pose_a); }
  PosedBody PosedB() const { return PoseBody(b, pose_b); }
  MatX Table() const { return SegmentGliTable(a, PosedA().node, b, PosedB().node); }
  Polyline PointsA(const Path& path) const { return Points(a, PosedA(), path); }
  Polyline PointsB(const Path& path) const { return Points(b, PosedB(), path); }
  static Polyline Points(const Body& body, const PosedBody& posed, const Path& path) {
    Polyline points;
    for (const int n : NodesOn(body, path)) points.push_back(posed.node[n]);
    return points;
  }

  const Body &a, &b;
  Pose pose_a, pose_b;
};

using Key = std::tuple<int, int, int, int>;
std::vector<std::pair<Key, double>> Sorted(const std::vector<Tangle>& tangles) {
  std::vector<std::pair<Key, double>> out;
  for (const Tangle& t : tangles) out.push_back({{t.a.from, t.a.to, t.b.from, t.b.to}, t.gli});
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Paths, NodesAndSignsWalkTheTree) {
  const Body body = StandardBody(AverageMeasures(1.75));
  const auto names = [&](const char* from, const char* to) {
    std::string out;
    for (const int n : NodesOn(body, {body.FindNode(from), body.FindNode(to)})) {
      out += (out.empty() ? "" : " ") + body.nodes[n].name;
    }
    return out;
  };
  EXPECT_EQ(names("left_hand", "right_elbow"),
            "left_hand left_wrist left_elbow left_shoulder neck right_shoulder right_elbow");
  EXPECT_EQ(names("head_top", "left_toe"),
            "head_top head neck chest root left_hip left_knee left_ankle left_toe");
  EXPECT_EQ(names("root", "chest"), "root chest");
  int paths = 0;
  for (int u = 0; u < 21; ++u) {
    for (int v = u + 1; v < 21; ++v) {
      // Signed segments of the rest pose add up to the way from end to end.
      const PosedBody rest = PoseBody(body, RestPose(body));
      const Eigen::VectorXi signs = SignsOf(body, {u, v});
      Vec3 sum = Vec3::Zero();
      for (int n = 1; n < 21; ++n) {
        sum += signs[n - 1] * (rest.node[n] - rest.node[body.nodes[n].parent]);
      }
      EXPECT_LT((sum - (rest.node[v] - rest.node[u])).norm(), 1e-14);
      EXPECT_EQ(signs.cwiseAbs().sum() + 1, static_cast<int>(NodesOn(body, {u, v}).size()));
      ++paths;
    }
  }
  EXPECT_EQ(paths, 210);
}

TEST(Tangles, PathPairsAreThePolylinesOfTheirNodes) {
  const Body body = StandardBody(AverageMeasures(1.75));
  Random random(26);
  int checked = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const Tangled scene(body, body, &random, 1.2);
    const MatX table = scene.Table();
    for (const Tangle& t : FindTangles(body, body, table)) {
      EXPECT_LT(t.a.from, t.a.to);
      EXPECT_LT(t.b.from, t.b.to);
      EXPECT_GT(std::abs(t.gli), 0.5);
      EXPECT_NEAR(t.gli, PolylineGli(scene.PointsA(t.a), scene.PointsB(t.b)), 1e-11);
      const double by_signs =
          SignsOf(body, t.a).cast<double>().dot(table * SignsOf(body, t.b).cast<double>());
      EXPECT_NEAR(t.gli, by_signs, 1e-11);
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(Tangles, FastSearchFindsWhatTheDefinitionDoes) {
  const Body a = StandardBody(AverageMeasures(1.75)), b = StandardBody(AverageMeasures(1.5));
  Random random(27);
  size_t found = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Tangled scene(a, b, &random, 0.4 + 0.1 * trial);
    const MatX table = scene.Table();
    const auto fast = Sorted(FindTangles(a, b, table));
    EXPECT_EQ(fast, Sorted(FindTanglesByDefinition(a, b, table)));
    found += fast.size();
  }
  EXPECT_GT(found, 1000u);
}

// The definition once more, without tables or prefix sums: every pair of paths and of sub-paths as
// polylines. On the upper bodies only, 13 nodes each.
TEST(Tangles, FastSearchFindsWhatBruteForceOverPolylinesDoes) {
  Body upper = StandardBody(AverageMeasures(1.75));
  upper.nodes.resize(13);
  Random random(28);
  size_t found = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const Tangled scene(upper, upper, &random, 1.5);
    std::map<Key, double> gli;
    for (int u = 0; u < 13; ++u) {
      for (int v = u + 1; v < 13; ++v) {
        for (int x = 0; x < 13; ++x) {
          for (int y = x + 1; y < 13; ++y) {
            gli[{u, v, x, y}] = std::abs(PolylineGli(scene.PointsA({u, v}), scene.PointsB({x, y})));
          }
        }
      }
    }
    const auto largest_below = [&](const Path& p, const Path& q) {
      const std::vector<int> on_p = NodesOn(upper, p), on_q = NodesOn(upper, q);
      double largest = 0;
      for (size_t i = 0; i < on_p.size(); ++i) {
        for (size_t k = i + 1; k < on_p.size(); ++k) {
          for (size_t j = 0; j < on_q.size(); ++j) {
            for (size_t l = j + 1; l < on_q.size(); ++l) {
              if (k - i + 1 == on_p.size() && l - j + 1 == on_q.size()) continue;
              const auto [u, v] = std::minmax(on_p[i], on_p[k]);
              const auto [x, y] = std::minmax(on_q[j], on_q[l]);
              largest = std::max(largest, gli[{u, v, x, y}]);
            }
          }
        }
      }
      return largest;
    };
    std::map<Key, double> got;
    for (const Tangle& t : FindTangles(upper, upper, scene.Table())) {
      got[{t.a.from, t.a.to, t.b.from, t.b.to}] = t.gli;
    }
    for (const auto& [key, value] : gli) {
      const auto [u, v, x, y] = key;
      const bool tangled = value > 0.5 && value > largest_below({u, v}, {x, y}) + 1e-10;
      EXPECT_EQ(got.count(key), tangled ? 1u : 0u) << u << " " << v << " " << x << " " << y;
    }
    found += got.size();
  }
  EXPECT_GT(found, 20u);
}

TEST(Tangles, ExchangingTheBodiesExchangesThePaths) {
  const Body a = StandardBody(AverageMeasures(1.8)), b = StandardBody(AverageMeasures(1.6));
  Random random(29);
  size_t found = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const Tangled scene(a, b, &random, 1.2);
    const MatX table = scene.Table();
    const MatX exchanged = SegmentGliTable(b, scene.PosedB().node, a, scene.PosedA().node);
    EXPECT_LT((exchanged - table.transpose()).cwiseAbs().maxCoeff(), 1e-13);
    std::vector<Tangle> other = FindTangles(b, a, table.transpose());
    for (Tangle& t : other) std::swap(t.a, t.b);
    const auto one = Sorted(FindTangles(a, b, table)), two = Sorted(other);
    ASSERT_EQ(one.size(), two.size());
    for (size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].first, two[k].first);
      EXPECT_NEAR(one[k].second, two[k].second, 1e-12);
    }
    found += one.size();
  }
  EXPECT_GT(found, 50u);
}

TEST(Tangles, ATightRingRoundATrunkIsFoundAndDistantBodiesHaveNone) {
  const Body body = StandardBody(AverageMeasures(1.75));
  const PosedBody rest = PoseBody(body, RestPose(body));
  Pose far = RestPose(body);
  far.root_position = Vec3(0, 0, 3);
  const MatX none = SegmentGliTable(body, rest.node, body, PoseBody(body, far).node);
  EXPECT_TRUE(FindTangles(body, body, none).empty());
  // a's node positions by hand: its arms go round b's spine at the height of b's chest, once.
  Polyline a = rest.node;
  for (Vec3& x : a) x.z() -= 0.6;
  const double y = 0.5 * (rest.node[1].y() + rest.node[2].y());
  const auto node = [&](const char* name) -> Vec3& { return a[body.FindNode(name)]; };
  node("neck") = Vec3(0, y, -0.3);
  node("left_shoulder") = Vec3(0.2, y, -0.3), node("right_shoulder") = Vec3(-0.2, y, -0.3);
  node("left_elbow") = Vec3(0.3, y, 0), node("right_elbow") = Vec3(-0.3, y, 0);
  node("left_wrist") = Vec3(0.2, y, 0.3), node("right_wrist") = Vec3(-0.2, y, 0.3);
  node("left_hand") = Vec3(0.05, y, 0.3), node("right_hand") = Vec3(-0.05, y, 0.3);
  const MatX table = SegmentGliTable(body, a, body, rest.node);
  const std::vector<Tangle> literal = FindTangles(body, body, table);
  // A circle of radius r round a straight line that ends h below and g above it has
  // (h / sqrt(h^2 + r^2) + g / sqrt(g^2 + r^2)) / 2; from the left hand over the back to the right
  // hand, against a line that goes up, the sign of Eq. 1 is positive.
  const double r = 0.3, h = y, g = rest.node[4].y() - y;
  const double circle = (h / std::hypot(h, r) + g / std::hypot(g, r)) / 2;
  const Path arms{body.FindNode("left_hand"), body.FindNode("right_hand")}, spine{0, 4};
  Polyline ring, line;
  for (const int n : NodesOn(body, arms)) ring.push_back(a[n]);
  for (const int n : NodesOn(body, spine)) line.push_back(rest.node[n]);
  EXPECT_NEAR(PolylineGli(ring, line), circle, 0.1);
  double largest = 0;
  for (const Tangle& t : literal) {
    if (std::abs(t.gli) < circle) continue;
    const double rise = rest.node[t.b.to].y() - rest.node[t.b.from].y();
    EXPECT_GT(t.gli * rise, 0);
    EXPECT_GE(NodesOn(body, t.a).size(), 7u);  // from elbow to hand at least
    largest = std::max(largest, std::abs(t.gli));
  }
  EXPECT_GT(largest, circle);
  EXPECT_LT(largest, 1);
}

// Norm of the GLI's derivative over all 120 coordinates, by central differences: root translations
// and a turn of every link.
double NumericNorm(Tangled scene, const Tangle& tangle) {
  const double h = 1e-6;
  const auto gli = [&] { return PolylineGli(scene.PointsA(tangle.a), scene.PointsB(tangle.b)); };
  double sum = 0;
  for (Pose* pose : {&scene.pose_a, &scene.pose_b}) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 keep = pose->root_position;
      pose->root_position = keep + h * Vec3::Unit(c);
      const double plus = gli();
      pose->root_position = keep - h * Vec3::Unit(c);
      sum += std::pow((plus - gli()) / (2 * h), 2);
      pose->root_position = keep;
    }
    for (Quat& q : pose->rotation) {
      for (int c = 0; c < 3; ++c) {
        const Quat keep = q;
        q = keep * ExpSo3(h * Vec3::Unit(c));
        const double plus = gli();
        q = keep * ExpSo3(-h * Vec3::Unit(c));
        sum += std::pow((plus - gli()) / (2 * h), 2);
        q = keep;
      }
    }
  }
  return std::sqrt(sum);
}

TEST(Tags, RobustnessRadiusIsTheMarginOverTheSlopeByDifferences) {
  const Body body = StandardBody(AverageMeasures(1.75));
  Random random(30);
  int checked = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Tangled scene(body, body, &random, 0.8);
    const MatX table = scene.Table();
    const std::vector<Tangle> literal = FindTangles(body, body, table);
    if (literal.empty()) continue;
    const ReductionOptions options;
    const std::vector<Tag> tags =
        ReduceTangles(body, scene.PosedA(), body, scene.PosedB(), literal, table, options);
    ASSERT_FALSE(tags.empty());
    ASSERT_LE(tags.size(), static_cast<size_t>(options.max_tags));
    size_t spoken_for = 0;
    for (size_t k = 0; k < tags.size(); ++k) {
      const double numeric = NumericNorm(scene, tags[k].tangle);
      EXPECT_NEAR(tags[k].rho * numeric / (std::abs(tags[k].tangle.gli) - 0.5), 1, 1e-4);
      if (k > 0) {
        EXPECT_GE(tags[k].rho, options.keep_rho * options.min_rho);
      }
      const auto is_tag = [&](const Tangle& t) {
        return t.a == tags[k].tangle.a && t.b == tags[k].tangle.b;
      };
      EXPECT_EQ(std::count_if(literal.begin(), literal.end(), is_tag), 1);
      EXPECT_GE(tags[k].group_size, 1);
      spoken_for += static_cast<size_t>(tags[k].group_size);
      ++checked;
    }
    EXPECT_LE(spoken_for, literal.size());
  }
  EXPECT_GT(checked, 8);
}

TEST(Tags, ANodeOnlyPostureHasTheSlopesOfThePose) {
  // Clavicles apart, whose centres are no nodes: they take no part in a path of the trunk and legs.
  const Body body = StandardBody(AverageMeasures(1.75));
  Random random(31);
  const Tangled scene(body, body, &random, 1.0);
  const Path legs{body.FindNode("left_toe"), body.FindNode("right_toe")};
  const Path trunk{body.FindNode("head_top"), body.FindNode("left_toe")};
  const PosedBody a = scene.PosedA(), b = scene.PosedB();
  const Tangle tangle{legs, trunk, 0};
  const double full = TangleGradientNorm(body, a, body, b, tangle);
  const double by_nodes = TangleGradientNorm(body, PosedFromNodes(body, a.node), body,
                                             PosedFromNodes(body, b.node), tangle);
  EXPECT_GT(full, 0);
  EXPECT_NEAR(by_nodes / full, 1, 1e-12);
}

}  // namespace
}  // namespace retarget
