// The exact answers of tests/data/golden: direct quadrature of Eq. 1 in 220-bit arithmetic.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "model/body/body.h"
#include "model/body/path.h"
#include "model/body/tangle.h"
#include "model/geometry/gli.h"
#include "model/geometry/polyline.h"
#include "tests/test_data.h"

namespace retarget {
namespace {

using Json = nlohmann::json;

Json Golden(const std::string& name) {
  return Json::parse(ReadWholeFile(TestDataPath("golden/" + name)));
}

Vec3 ToVec3(const Json& j) { return Vec3(j[0], j[1], j[2]); }

double ToNumber(const Json& j) {
  return j.is_string() ? std::stod(j.get<std::string>()) : j.get<double>();
}

// Largest gradient error relative to the largest gradient component.
double GradientError(const SegmentGliGradient& got, const Json& expected) {
  double error = 0, largest = 0;
  for (int i = 0; i < 12; ++i) {
    const double e = ToNumber(expected[i]);
    largest = std::max(largest, std::abs(e));
    error = std::max(error, std::abs(got.gradient[i / 3][i % 3] - e));
  }
  return largest > 0 ? error / largest : error;
}

TEST(Golden, SegmentPairs) {
  int checked = 0;
  const Json file = Golden("segment_pairs.json");
  for (const Json& p : file.is_array() ? file : file["pairs"]) {
    const auto got =
        SegmentGliWithGradient(ToVec3(p["a"]), ToVec3(p["b"]), ToVec3(p["c"]), ToVec3(p["d"]));
    EXPECT_NEAR(got.value, ToNumber(p["gli"]), 1e-12) << p["id"];
    EXPECT_LT(GradientError(got, p["grad"]), 1e-10) << p["id"];
    EXPECT_EQ(got.value,
              SegmentGli(ToVec3(p["a"]), ToVec3(p["b"]), ToVec3(p["c"]), ToVec3(p["d"])));
    ++checked;
  }
  EXPECT_EQ(checked, 100);
}

TEST(Golden, DegeneratePairs) {
  int checked = 0, gradients = 0;
  const Json file = Golden("degenerate_pairs.json");
  for (const Json& p : file.is_array() ? file : file["pairs"]) {
    const auto got =
        SegmentGliWithGradient(ToVec3(p["a"]), ToVec3(p["b"]), ToVec3(p["c"]), ToVec3(p["d"]));
    EXPECT_NEAR(got.value, ToNumber(p["gli"]), p["tol_abs"].get<double>()) << p["id"];
    for (const Vec3& g : got.gradient) EXPECT_TRUE(g.allFinite()) << p["id"];
    ++checked;
    if (p["touching"].get<bool>()) {
      EXPECT_EQ(got.value, 0) << p["id"];
      continue;
    }
    EXPECT_LT(GradientError(got, p["grad"]), p["grad_tol_rel_to_max"].get<double>()) << p["id"];
    ++gradients;
  }
  EXPECT_EQ(checked, 20);
  EXPECT_GE(gradients, 14);
}

TEST(Golden, ClosedCurvesHaveIntegerLinkingNumbers) {
  int checked = 0;
  const Json file = Golden("curves.json");
  for (const Json& c : file.is_array() ? file : file["curves"]) {
    std::vector<Vec3> p, q;
    for (const Json& x : c["curve1"]) p.push_back(ToVec3(x));
    for (const Json& x : c["curve2"]) q.push_back(ToVec3(x));
    p.push_back(p.front());
    q.push_back(q.front());
    EXPECT_NEAR(PolylineGli(p, q), c["lk"].get<double>(), 1e-10) << c["name"];
    ++checked;
  }
  EXPECT_GE(checked, 5);
}

std::string Key(const std::string& a0, const std::string& a1, const std::string& b0,
                const std::string& b1) {
  return a0 + ">" + a1 + "|" + b0 + ">" + b1;
}

TEST(Golden, PosturesGiveTheLiteralAlgorithm1ListExactly) {
  const Body body = StandardBody(AverageMeasures(1.75));
  const Json file = Golden("postures.json");
  ASSERT_EQ(file.size(), 3u);
  for (const Json& posture : file) {
    const std::vector<std::string> names = posture["nodes"];
    ASSERT_EQ(names.size(), body.nodes.size());
    std::vector<Vec3> a, b;
    for (const Json& x : posture["A"]) a.push_back(ToVec3(x));
    for (const Json& x : posture["B"]) b.push_back(ToVec3(x));
    for (int n = 0; n < body.num_nodes(); ++n) {
      EXPECT_EQ(body.nodes[n].parent, posture["parent_of_node"][n].get<int>());
    }
    const MatX table = SegmentGliTable(body, a, body, b);
    for (int i = 0; i < 20; ++i) {
      for (int j = 0; j < 20; ++j) {
        EXPECT_NEAR(table(i, j), ToNumber(posture["gli_segments"][i][j]), 1e-12);
      }
    }
    std::map<std::string, double> expected, got;
    for (const Json& t : posture["tangles"]) {
      expected[Key(t["a"][0], t["a"][1], t["b"][0], t["b"][1])] = ToNumber(t["gli"]);
    }
    for (const Tangle& t : FindTangles(body, body, table)) {
      got[Key(names[t.a.from], names[t.a.to], names[t.b.from], names[t.b.to])] = t.gli;
    }
    EXPECT_EQ(got.size(), posture["n_tangles"].get<size_t>()) << posture["name"];
    ASSERT_EQ(got.size(), expected.size());
    for (const auto& [key, gli] : expected) {
      ASSERT_TRUE(got.count(key)) << key;
      EXPECT_NEAR(got[key], gli, 1e-11) << key;
    }
    EXPECT_EQ(FindTanglesByDefinition(body, body, table).size(), expected.size());
    const PosedBody pa = PosedFromNodes(body, a), pb = PosedFromNodes(body, b);
    for (const Tag& tag :
         ReduceTangles(body, pa, body, pb, FindTangles(body, body, table), table)) {
      std::printf("%s: (%s,%s) x (%s,%s) %.3f rho %.3f group %d\n",
                  posture["name"].get<std::string>().c_str(), names[tag.tangle.a.from].c_str(),
                  names[tag.tangle.a.to].c_str(), names[tag.tangle.b.from].c_str(),
                  names[tag.tangle.b.to].c_str(), tag.tangle.gli, tag.rho, tag.group_size);
    }
  }
}

}  // namespace
}  // namespace retarget
