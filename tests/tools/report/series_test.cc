// The curves as JSON: the shape that the report page reads, rounded, without gaps.
#include "tools/report/series.h"

#include <gtest/gtest.h>

#include "tests/solver/scene_fixture.h"

namespace retarget::report {
namespace {

constexpr int kFrames = 12;

class SeriesJsonTest : public testing::Test {
 protected:
  SeriesJsonTest()
      : scene_(solver::SmallScene(kFrames, 0.3)), subject_(solver::MetricsContextOf(scene_)) {
    std::array<Clip, 2> moved;
    for (int f = 0; f < 2; ++f) {
      moved[f] = solver::Fidget(scene_.body[f], scene_.posture.pose[f], kFrames, 30, 31 + f, 0.3);
    }
    const solver::MotionView source = solver::ViewOf(scene_.body, scene_.source);
    source_ = solver::MeasureFrames(subject_, source, source);
    result_ = solver::MeasureFrames(subject_, solver::ViewOf(scene_.body, moved), source);
    result_.pass_throughs = {{3, 5, 6}};
  }

  solver::Scene scene_;
  solver::MetricsContext subject_;
  solver::FrameMetrics source_, result_;
};

TEST_F(SeriesJsonTest, HasEveryCurveInEveryFrame) {
  const Json json = SeriesJson(subject_, source_, &source_, result_);
  EXPECT_EQ(json["fps"], 30);
  EXPECT_EQ(json["frames"], kFrames);
  for (const char* motion : {"source", "baseline", "result"}) {
    const Json& s = json[motion];
    ASSERT_EQ(s["tangles"].size(), subject_.tangles.size());
    ASSERT_EQ(s["hold_cm"].size(), subject_.holds.size());
    for (const Json& curve : s["tangles"]) EXPECT_EQ(curve.size(), kFrames);
    for (const Json& curve : s["hold_cm"]) EXPECT_EQ(curve.size(), kFrames);
    for (const char* curve : {"penetration_cm", "penetration_pair"}) {
      EXPECT_EQ(s[curve].size(), kFrames) << curve;
    }
    for (const char* figure : {"a", "b"}) {
      for (const char* curve : {"self_penetration_cm", "floor_cm", "foot_speed_cm_s"}) {
        EXPECT_EQ(s[curve][figure].size(), kFrames) << curve;
      }
      const Json& tracking = s["tracking_deg"][figure];
      if (motion == std::string("source")) {
        EXPECT_TRUE(tracking.is_null());
        continue;
      }
      ASSERT_EQ(tracking["joints"].size(), 18u);
      ASSERT_EQ(tracking["values"].size(), 18u);
      for (const Json& joint : tracking["values"]) EXPECT_EQ(joint.size(), kFrames);
    }
    const Json& between = s["between"];
    ASSERT_EQ(between["tangles"].size(), subject_.tangles.size());
    ASSERT_EQ(between["hold_cm"].size(), subject_.holds.size());
    for (const Json& curve : between["tangles"]) EXPECT_EQ(curve.size(), kFrames - 1);
    for (const Json& curve : between["hold_cm"]) EXPECT_EQ(curve.size(), kFrames - 1);
    for (const char* curve : {"penetration_cm", "penetration_pair"}) {
      EXPECT_EQ(between[curve].size(), kFrames - 1) << curve;
    }
    for (const char* figure : {"a", "b"})
      EXPECT_EQ(between["floor_cm"][figure].size(), kFrames - 1);
    for (int t = 0; t < kFrames; ++t) {
      EXPECT_EQ(s["penetration_cm"][t] == 0, s["penetration_pair"][t].is_null()) << t;
    }
  }
  EXPECT_EQ(json["result"]["tracking_deg"]["a"]["joints"][0], "waist");
  EXPECT_EQ(json["result"]["pass_throughs"],
            Json::parse(R"([{"frame": 3, "a": ")" + scene_.body[0].nodes[5].name + R"(", "b": ")" +
                        scene_.body[1].nodes[6].name + "\"}]"));
  EXPECT_TRUE(SeriesJson(subject_, source_, nullptr, result_)["baseline"].is_null());
}

TEST_F(SeriesJsonTest, NumbersAreRoundedAndInCentimetres) {
  result_.at[2].penetration = {0.0123456, 1, 2};
  result_.at[2].gli[0] = 0.98765432;
  result_.at[3].gli[0] = -1e-9;
  result_.at[4].gli[0] = std::nan("");
  result_.foot_speed[1][5] = 0.1;
  result_.between[6].hold_m[0] = 0.04321;
  const Json s = SeriesJson(subject_, source_, nullptr, result_)["result"];
  EXPECT_EQ(s["penetration_cm"][2].dump(), "1.235");
  EXPECT_EQ(s["tangles"][0][2].dump(), "0.9877");
  EXPECT_EQ(s["tangles"][0][3].dump(), "0.0");
  EXPECT_EQ(s["tangles"][0][4].dump(), "null");
  EXPECT_EQ(s["foot_speed_cm_s"]["b"][5].dump(), "10.0");
  EXPECT_EQ(s["penetration_pair"][2][0], scene_.body[0].nodes[1].name);
  EXPECT_EQ(s["between"]["hold_cm"][0][6].dump(), "4.321");
}

}  // namespace
}  // namespace retarget::report
