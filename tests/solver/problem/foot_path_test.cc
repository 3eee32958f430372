// Ways of feet between footprints, against closed forms.
#include "solver/problem/foot_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/problem/terms/foot_swing.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

constexpr int kFrames = 40;
constexpr double kStride = 0.5;  // m, captured

double LeastJerk(double tau) {
  tau = std::clamp(tau, 0.0, 1.0);
  return 10 * std::pow(tau, 3) - 15 * std::pow(tau, 4) + 6 * std::pow(tau, 5);
}

// A figure in its rest pose that glides by kStride along z between frames 13 and 17, so that its
// feet are at rest where they leave the floor and where they come to it.
class FootPathTest : public testing::Test {
 protected:
  FootPathTest() {
    for (int f = 0; f < 2; ++f) {
      scene_.body[f] = StandardBody(AverageMeasures(1.75));
      scene_.source[f].frames.assign(kFrames, RestPose(scene_.body[f]));
      scene_.posture.body[f] = scene_.body[f];
      scene_.posture.pose[f] = RestPose(scene_.body[f]);
    }
    for (int t = 0; t < kFrames; ++t) {
      scene_.source[0].frames[t].root_position.z() = kStride * LeastJerk((t - 13) / 4.0);
    }
    ankle_ = scene_.body[0].FindNode("left_ankle");
    toe_ = scene_.body[0].FindNode("left_toe");
    scene_.posture.supports[0] = {ankle_, toe_};
  }

  Vec3 Captured(int t, int node) const {
    return PoseBody(scene_.body[0], scene_.source[0].frames[t]).node[node];
  }
  // Anchors where the source stands, those of later contacts `moved` further along z.
  MatX Anchors(double moved) const {
    MatX anchor(2, static_cast<long>(scene_.contacts[0].size()));
    for (size_t k = 0; k < scene_.contacts[0].size(); ++k) {
      const Contact& c = scene_.contacts[0][k];
      const Vec3 p = Captured(c.first, c.node);
      anchor.col(static_cast<long>(k)) << p.x(), p.z() + (c.first > 15 ? moved : 0);
    }
    return anchor;
  }
  // Place of a node at frame t by the paths of these anchors, without lift and turn.
  static Vec3 Place(const FootPathPoint& p, const MatX& anchor, size_t from) {
    const long to = p.to >= 0 ? p.to : static_cast<long>(from);
    const Vec3 way = (1 - p.u) * p.way + p.u * p.way_to_next;
    const auto a = anchor.col(static_cast<long>(from)), b = anchor.col(to);
    return way + Vec3((1 - p.u) * a[0] + p.u * b[0], p.height, (1 - p.u) * a[1] + p.u * b[1]);
  }

  Scene scene_;
  int ankle_ = 0, toe_ = 0;
};

TEST_F(FootPathTest, AFootprintThatMovesIsReachedWithLeastJerk) {
  scene_.contacts[0] = {{toe_, 0, 10}, {toe_, 20, 39}};
  const auto paths = FootPaths(scene_);
  ASSERT_EQ(paths.size(), 2u);
  for (const double moved : {0.0, 0.3, -0.2}) {
    int checked = 0;
    for (const FootPathPoint& p : paths[0]) {
      if (p.node != toe_) continue;
      const Vec3 expected = Captured(p.t, toe_) + Vec3(0, 0, moved * LeastJerk((p.t - 10) / 10.0));
      EXPECT_LT((Place(p, Anchors(moved), 0) - expected).norm(), 1e-12) << p.t;
      EXPECT_EQ(p.to, 1);
      EXPECT_NEAR(p.stride.z(), kStride, 1e-12);
      ++checked;
    }
    EXPECT_EQ(checked, 9);
  }
  // Lifted by 12 cm half way, since the foot glides, where the other foot stands all the while,
  // else by 4 cm; not at all at the footprints.
  const int other = scene_.body[0].FindNode("right_ankle");
  for (const auto& [last, most] : {std::pair(39, 0.12), {14, 0.04}}) {
    scene_.contacts[0].resize(2);
    scene_.contacts[0].push_back({other, 0, last});
    const auto with_other = FootPaths(scene_);
    const auto lift = [&](int t) {
      return std::find_if(with_other[0].begin(), with_other[0].end(),
                          [&](const FootPathPoint& p) { return p.t == t && p.node == toe_; })
          ->lift;
    };
    EXPECT_NEAR(lift(15), most, 1e-12);
    EXPECT_LT(lift(11), most * 0.06);
    EXPECT_LT(lift(19), most * 0.06);
  }
}

TEST_F(FootPathTest, AnkleAndToeOfAFootMoveOverTogether) {
  scene_.contacts[0] = {{ankle_, 0, 8}, {ankle_, 20, 39}, {toe_, 0, 10}, {toe_, 22, 39}};
  const auto paths = FootPaths(scene_);
  const MatX anchor = Anchors(0.4);
  int standing = 0, free = 0;
  for (size_t k = 0; k < paths.size(); ++k) {
    for (const FootPathPoint& p : paths[k]) {
      const double u = LeastJerk((p.t - 10) / 10.0);  // free from frame 10 to frame 20
      const Vec3 expected = Captured(p.t, p.node) + Vec3(0, 0, 0.4 * u);
      EXPECT_LT((Place(p, anchor, k) - expected).norm(), 1e-12) << p.t << " " << p.node;
      const bool stands = p.t <= 10 || p.t >= 20;
      EXPECT_EQ(p.to < 0, stands) << p.t;
      ++(stands ? standing : free);
    }
  }
  EXPECT_EQ(standing, 2 + 2);  // the heel lifts early, the toe comes down late
  EXPECT_EQ(free, 2 * 9);
}

TEST_F(FootPathTest, AnAnkleThatIsNeverPlantedGoesWithItsToe) {
  scene_.contacts[0] = {{toe_, 0, 10}, {toe_, 20, 39}};
  const auto paths = FootPaths(scene_);
  const MatX anchor = Anchors(0.4);
  int checked = 0;
  for (size_t k = 0; k < paths.size(); ++k) {
    for (const FootPathPoint& p : paths[k]) {
      if (p.node != ankle_) continue;
      const Vec3 expected = Captured(p.t, ankle_) + Vec3(0, 0, 0.4 * LeastJerk((p.t - 10) / 10.0));
      EXPECT_LT((Place(p, anchor, k) - expected).norm(), 1e-12) << p.t;
      ++checked;
    }
  }
  EXPECT_EQ(checked, kFrames);
}

TEST_F(FootPathTest, WhatIsFreeForVeryLongIsLeftOut) {
  scene_.source[0].fps = scene_.source[1].fps = 2;  // 10 frames are 5 s
  scene_.contacts[0] = {{toe_, 0, 10}, {toe_, 20, 39}};
  for (const auto& path : FootPaths(scene_)) {
    for (const FootPathPoint& p : path) EXPECT_EQ(p.node, ankle_);  // while its toe stands
  }
}

TEST_F(FootPathTest, TheTermIsZeroOnTheCaptureAndMeasuresWhatIsOff) {
  scene_.contacts[0] = {{toe_, 0, 10}, {toe_, 20, 39}};
  const FootSwing term(scene_);
  Unknowns u = UnknownsFromPoses(scene_, scene_.source);
  const auto rows = [&](int t) {
    Frame frame;
    frame.Set(scene_, u, t, false);
    Rows out;
    out.Reset(frame, false);
    term.Evaluate(frame, &out);
    return out.residual();
  };
  for (int t = 0; t < kFrames; ++t) {
    for (const double r : rows(t)) EXPECT_NEAR(r, 0, 1e-12) << t;
  }
  u.edit(2, 11) += 0.05;  // the root of a, 5 cm along z, just after the toe has left the floor
  const std::vector<double> off = rows(11);
  ASSERT_EQ(off.size(), 6u);  // x, z and height of the ankle and of the toe
  for (size_t k = 0; k < off.size(); ++k) {
    EXPECT_NEAR(off[k], k % 3 == 1 ? 0.05 : 0, 0.001) << k;
  }
}

}  // namespace
}  // namespace retarget::solver
