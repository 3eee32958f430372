// The curves of hand-made motions whose values follow from a ruler, and their extremes, which are
// the metrics.
#include "solver/metrics/frame_metrics.h"

#include <gtest/gtest.h>

#include <set>

#include "solver/metrics/metrics.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

// Two standing bodies in the air, 5 m apart.
class SeriesTest : public testing::Test {
 protected:
  static constexpr int kFrames = 9;

  SeriesTest() {
    for (int f = 0; f < 2; ++f) {
      subject_.body[f] = StandardBody(AverageMeasures(1.8 - 0.1 * f));
      Pose pose = RestPose(subject_.body[f]);
      pose.root_position = Vec3(5.0 * f, 2, 0);
      source_[f].frames.assign(kFrames, pose);
      subject_.length[f].push_back(0);
      for (int n = 1; n < subject_.body[f].num_nodes(); ++n) {
        subject_.length[f].push_back(subject_.body[f].SegmentLength(n));
      }
    }
    motion_ = source_;
  }

  int Node(int f, const char* name) const { return subject_.body[f].FindNode(name); }
  FrameMetrics Run() const {
    return MeasureFrames(subject_, ViewOf(subject_.body, motion_), ViewOf(subject_.body, source_));
  }

  MetricsContext subject_;
  std::array<Clip, 2> source_, motion_;
};

TEST_F(SeriesTest, DepthFloorAndHoldFollowTheRuler) {
  // The hands of a and b tip to tip along X, (t - 4) mm deep.
  const int hand_a = Node(0, "left_hand"), hand_b = Node(1, "right_hand");
  const double touching =
      subject_.body[0].nodes[hand_a].radius + subject_.body[1].nodes[hand_b].radius;
  const Vec3 tips = PoseBody(subject_.body[0], source_[0].frames[0]).node[hand_a] -
                    PoseBody(subject_.body[1], source_[1].frames[0]).node[hand_b];
  for (int t = 0; t < kFrames; ++t) {
    motion_[1].frames[t].root_position += tips + Vec3(touching - 0.001 * (t - 4), 0, 0);
  }
  Hold hold;
  hold.from = {0, hand_a, Vec3::Zero()};
  hold.to = {1, hand_b, Vec3::Zero()};
  subject_.holds = {hold};
  const FrameMetrics s = Run();
  ASSERT_EQ(s.num_frames(), kFrames);
  for (int t = 0; t < kFrames; ++t) {
    EXPECT_NEAR(s.at[t].penetration.depth_m, t > 4 ? 0.001 * (t - 4) : 0, 1e-12) << t;
    if (t > 4) {
      EXPECT_EQ(s.at[t].penetration.node_1, hand_a);
      EXPECT_EQ(s.at[t].penetration.node_2, hand_b);
    }
    EXPECT_NEAR(s.at[t].hold_m[0], touching - 0.001 * (t - 4), 1e-12);
    for (int f = 0; f < 2; ++f) EXPECT_EQ(s.at[t].figure[f].floor_m, 0);
  }
  // The deepest between frames 4 and 5 is at three quarters.
  EXPECT_NEAR(s.between[4].penetration.depth_m, 0.00075, 1e-12);
  EXPECT_NEAR(s.between[7].hold_m[0], touching - 0.00325, 1e-12);
}

// Standing, on its back, head first and somehow: the capsules themselves say what is lowest.
TEST_F(SeriesTest, FloorDepthIsThatOfTheLowestCapsule) {
  const Body& body = subject_.body[1];
  std::set<int> lowest_nodes;
  for (const Quat& turn : {Turn(0, 0, 0), Turn(-90, 0, 0), Turn(0, 0, 180), Turn(40, 10, 70)}) {
    for (int t = 0; t < kFrames; ++t) {
      Pose& pose = motion_[1].frames[t];
      pose = source_[1].frames[t];
      pose.rotation[0] = turn * pose.rotation[0];
      pose.root_position.y() = 0.02 - 0.002 * t;
    }
    const FrameMetrics s = Run();
    for (int t = 0; t < kFrames; ++t) {
      const PosedBody posed = PoseBody(body, motion_[1].frames[t]);
      double deepest = 0;
      int node = -1;
      for (int n = 1; n < body.num_nodes(); ++n) {  // both ends of every segment
        for (const int end : {body.nodes[n].parent, n}) {
          const double depth = body.nodes[n].radius - posed.node[end].y();
          if (depth > deepest) deepest = depth, node = end;
        }
      }
      EXPECT_NEAR(s.at[t].figure[1].floor_m, deepest, 1e-12);
      EXPECT_EQ(s.at[t].figure[1].floor_node, node);
      EXPECT_EQ(s.at[t].figure[0].floor_m, 0);
      EXPECT_GT(deepest, 0.05);
      lowest_nodes.insert(node);
    }
  }
  EXPECT_GE(lowest_nodes.size(), 3u);
}

TEST_F(SeriesTest, FloorDepthIsTheWidestCapsulesAtTheLowestNode) {
  // b sinks by 2 mm per frame from where its toes' capsules touch the floor. The ankles are as low:
  // there the wider of shank and foot counts.
  const std::array<int, 2> toe = {Node(1, "left_toe"), Node(1, "right_toe")};
  const std::array<int, 2> ankle = {Node(1, "left_ankle"), Node(1, "right_ankle")};
  Body& body = subject_.body[1];
  const std::vector<Vec3> node = PoseBody(body, source_[1].frames[0]).node;
  for (int side = 0; side < 2; ++side) {
    ASSERT_NEAR(node[ankle[side]].y(), node[toe[0]].y(), 1e-12);
    body.nodes[toe[side]].radius = 0.04;
  }
  for (int t = 0; t < kFrames; ++t) {
    motion_[1].frames[t].root_position.y() -= node[toe[0]].y() - 0.04 + 0.002 * t;
  }
  for (const double shank : {0.02, 0.04, 0.055}) {
    body.nodes[ankle[0]].radius = shank;
    body.nodes[ankle[1]].radius = 0.03;
    const FrameMetrics s = Run();
    const double deeper = std::max(shank, 0.04) - 0.04;
    for (int t = 0; t < kFrames; ++t) {
      EXPECT_NEAR(s.at[t].figure[1].floor_m, deeper + 0.002 * t, 1e-12) << shank << " " << t;
      EXPECT_EQ(s.at[t].figure[0].floor_m, 0);
      if (deeper > 0) {
        EXPECT_EQ(s.at[t].figure[1].floor_node, ankle[0]);
      }
    }
  }
}

TEST_F(SeriesTest, FootSpeedIsTheFastestPlantedNodeAndZeroElsewhere) {
  // a moves 2 mm per frame: 6 cm/s at 30 fps. Planted from frame 2 to 5.
  for (int t = 0; t < kFrames; ++t) motion_[0].frames[t].root_position.x() += 0.002 * t;
  subject_.contacts[0] = {{Node(0, "left_toe"), 2, 5}};
  const FrameMetrics s = Run();
  for (int t = 0; t < kFrames; ++t) {
    EXPECT_NEAR(s.foot_speed[0][t], t > 2 && t <= 5 ? 0.06 : 0, 1e-12) << t;
    EXPECT_EQ(s.foot_speed[1][t], 0);
  }
}

TEST_F(SeriesTest, TrackingIsTheTurnOfEachJoint) {
  // The left elbow of a turns by 5 degrees per frame, everything else rigidly with the root.
  const int elbow = subject_.body[0].FindLink("left_elbow");
  for (int t = 0; t < kFrames; ++t) {
    motion_[0].frames[t].rotation[elbow] = Turn(0, 5.0 * t, 0);
    motion_[0].frames[t].rotation[0] = Turn(10, 20, 30);
  }
  const FrameMetrics s = Run();
  const std::vector<int> joints = TrackedJoints(subject_.body[0]);
  ASSERT_EQ(joints.size(), 18u);
  ASSERT_EQ(s.tracking_deg[0].size(), 18u);
  for (size_t j = 0; j < joints.size(); ++j) {
    const bool is_elbow = subject_.body[0].nodes[joints[j]].link == elbow;
    for (int t = 0; t < kFrames; ++t) {
      EXPECT_NEAR(s.tracking_deg[0][j][t], is_elbow ? 5 * t : 0, 1e-6);
      EXPECT_NEAR(s.tracking_deg[1][j][t], 0, 1e-6);
    }
  }
}

TEST_F(SeriesTest, AForearmThroughAForearmIsNamedInItsFrame) {
  // b's arms lie across a's; it sinks by 1 cm per frame and passes between frames 5 and 6.
  const auto middle = [&](int f, const Pose& pose) -> Vec3 {
    const PosedBody posed = PoseBody(subject_.body[f], pose);
    return 0.5 * (posed.node[Node(f, "left_elbow")] + posed.node[Node(f, "left_wrist")]);
  };
  for (int t = 0; t < kFrames; ++t) {
    Pose& pose = motion_[1].frames[t];
    pose.rotation[0] = Turn(0, 90, 0);
    pose.root_position +=
        middle(0, source_[0].frames[0]) + Vec3(0, 0.056 - 0.01 * t, 0) - middle(1, pose);
  }
  const FrameMetrics s = Run();
  ASSERT_EQ(s.pass_throughs.size(), 1u);
  EXPECT_EQ(s.pass_throughs[0].frame, 5);
  EXPECT_EQ(s.pass_throughs[0].node_a, Node(0, "left_wrist"));
  EXPECT_EQ(s.pass_throughs[0].node_b, Node(1, "left_wrist"));
}

TEST(Series, ExtremesAreTheMetrics) {
  // A scene with everything in it, moved about: no frame is perfect.
  const Scene scene = SmallScene(25, 0.3);
  const MetricsContext subject = MetricsContextOf(scene);
  std::array<Clip, 2> moved = scene.source;
  for (int f = 0; f < 2; ++f) {
    moved[f] = Fidget(scene.body[f], scene.posture.pose[f], 25, 30, 31 + f, 0.3);
    for (Pose& pose : moved[f].frames) pose.root_position.y() -= 0.05;
  }
  const MotionView source = ViewOf(scene.body, scene.source), motion = ViewOf(scene.body, moved);
  const FrameMetrics s = MeasureFrames(subject, motion, source);
  const Metrics m = Measure(subject, motion, source);

  const auto largest = [&](auto value) {
    double out = 0;
    for (const InstantMetrics& at : s.at) out = std::max(out, value(at));
    return out;
  };
  const auto largest_of_all = [&](auto value) {
    double out = largest(value);
    for (const InstantMetrics& between : s.between) out = std::max(out, value(between));
    return out;
  };
  const auto depth = [](const InstantMetrics& v) { return v.penetration.depth_m; };
  EXPECT_EQ(m.penetration_m, largest(depth));
  EXPECT_EQ(m.penetration_between_m, largest_of_all(depth));
  EXPECT_GT(m.penetration_m, 0);
  ASSERT_FALSE(subject.tangles.empty());
  for (size_t k = 0; k < subject.tangles.size(); ++k) {
    double least = 1e9;
    for (const InstantMetrics& at : s.at) least = std::min(least, at.gli[k]);
    EXPECT_EQ(m.tangles[k].min_signed_gli, least);
    EXPECT_EQ(s.at[m.tangles[k].worst_frame].gli[k], least);
  }
  for (size_t k = 0; k < subject.holds.size(); ++k) {
    EXPECT_EQ(m.hold_m[k], largest_of_all([k](const InstantMetrics& v) { return v.hold_m[k]; }));
  }
  for (int f = 0; f < 2; ++f) {
    const auto floor = [f](const InstantMetrics& v) { return v.figure[f].floor_m; };
    EXPECT_EQ(m.figure[f].floor_m, largest_of_all(floor));
    EXPECT_GT(m.figure[f].floor_m, 0.01);
    EXPECT_EQ(m.figure[f].self_penetration_m, largest([f](const InstantMetrics& v) {
                return v.figure[f].self_penetration.depth_m;
              }));
    EXPECT_EQ(m.figure[f].foot_speed_max,
              *std::max_element(s.foot_speed[f].begin(), s.foot_speed[f].end()));
    EXPECT_GT(m.figure[f].foot_speed_max, 0);
    double sum = 0;
    for (const auto& joint : s.tracking_deg[f]) {
      for (const double turn : joint) sum += turn;
    }
    EXPECT_NEAR(m.figure[f].joint_edit_deg, sum / (18 * 25), 1e-9);
  }
}

}  // namespace
}  // namespace retarget::solver
