// The metrics on hand-made motions whose values follow from a ruler.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/geometry/so3.h"
#include "solver/metrics/requirements.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

// Two standing bodies, far apart unless a test brings them together.
class MeasureTest : public testing::Test {
 protected:
  static constexpr int kFrames = 11;

  MeasureTest() {
    subject_.body = {StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.60))};
    for (int f = 0; f < 2; ++f) {
      standing_[f] = RestPose(subject_.body[f]);
      standing_[f].root_position = Vec3(5.0 * f, 2, 0);
      subject_.length[f].push_back(0);
      for (int n = 1; n < subject_.body[f].num_nodes(); ++n) {
        subject_.length[f].push_back(subject_.body[f].SegmentLength(n));
      }
      source_[f].frames.assign(kFrames, standing_[f]);
    }
    motion_ = source_;
  }

  int Node(int f, const char* name) const { return subject_.body[f].FindNode(name); }
  int Link(int f, const char* name) const { return subject_.body[f].FindLink(name); }
  double Radius(int f, const char* name) const {
    return subject_.body[f].nodes[Node(f, name)].radius;
  }
  void Each(int f, const std::function<void(int, Pose*)>& change) {
    for (int t = 0; t < motion_[f].num_frames(); ++t) change(t, &motion_[f].frames[t]);
  }
  Metrics Run() const {
    return Measure(subject_, ViewOf(subject_.body, motion_), ViewOf(subject_.body, source_));
  }

  MetricsContext subject_;
  std::array<Pose, 2> standing_;
  std::array<Clip, 2> source_, motion_;
};

TEST_F(MeasureTest, TheSourceAgainstItselfIsPerfect) {
  const Metrics m = Run();
  EXPECT_EQ(m.penetration_m, 0);
  EXPECT_EQ(m.penetration_between_m, 0);
  EXPECT_EQ(m.penetration_over_1cm_percent, 0);
  EXPECT_TRUE(m.pass_throughs.empty());
  EXPECT_TRUE(std::isnan(m.tangle_kept_percent)) << "there is no tag";
  EXPECT_TRUE(std::isnan(m.smallest_gli));
  EXPECT_TRUE(std::isnan(m.smallest_gli_between));
  for (const FigureMetrics& f : m.figure) {
    EXPECT_EQ(f.self_penetration_m, 0);
    EXPECT_EQ(f.floor_m, 0);
    EXPECT_TRUE(std::isnan(f.foot_drift_m)) << "there is no contact";
    EXPECT_TRUE(std::isnan(f.foot_speed_max));
    EXPECT_TRUE(std::isnan(f.foot_speed_over_1cm_percent));
    EXPECT_TRUE(f.edges.empty());
    EXPECT_LT(f.pose_error_cm, 1e-12);
    EXPECT_LT(f.joint_edit_deg, 1e-9);
    EXPECT_LT(f.jerk, 1e-9);
    EXPECT_LT(f.length_error_percent, 1e-10);
  }
}

TEST_F(MeasureTest, PenetrationOfTwoHandsIsTheRadiiLessTheirDistance) {
  // The left hand of a reaches the right hand of b, tip to tip along X. At frame 6 they come within
  // a depth of 3 cm, at frames 5 and 7 of 1.5 cm, else they are apart.
  const double touching = Radius(0, "left_hand") + Radius(1, "right_hand");
  const PosedBody a = PoseBody(subject_.body[0], standing_[0]);
  const PosedBody b = PoseBody(subject_.body[1], standing_[1]);
  const Vec3 tips = a.node[Node(0, "left_hand")] - b.node[Node(1, "right_hand")];
  const auto distance = [&](int t) {
    if (t == 6) return touching - 0.03;
    return t == 5 || t == 7 ? touching - 0.015 : touching + 0.3;
  };
  Each(1, [&](int t, Pose* pose) { pose->root_position += tips + Vec3(distance(t), 0, 0); });
  const Metrics m = Run();
  EXPECT_NEAR(m.penetration_m, 0.03, 1e-12);
  EXPECT_NEAR(m.penetration_between_m, 0.03, 1e-12);
  EXPECT_EQ(m.penetration_frame, 6);
  EXPECT_EQ(m.penetration_node_a, Node(0, "left_hand"));
  EXPECT_EQ(m.penetration_node_b, Node(1, "right_hand"));
  EXPECT_NEAR(m.penetration_over_1cm_percent, 100.0 * 3 / kFrames, 1e-12);
  EXPECT_EQ(m.figure[0].self_penetration_m, 0);
}

TEST_F(MeasureTest, PenetrationBetweenFramesIsSeenAtTheSubSamples) {
  // The hands cross and come apart again within one frame: from frame 3 to frame 4 body b goes from
  // 20 cm before touching in Z to 20 cm beyond; half way the axes are as close as in X.
  const double touching = Radius(0, "left_hand") + Radius(1, "right_hand");
  const Vec3 tips = PoseBody(subject_.body[0], standing_[0]).node[Node(0, "left_hand")] -
                    PoseBody(subject_.body[1], standing_[1]).node[Node(1, "right_hand")];
  Each(1, [&](int t, Pose* pose) {
    pose->root_position += tips + Vec3(touching - 0.02, 0, t <= 3 ? -0.2 : 0.2);
  });
  const Metrics m = Run();
  EXPECT_EQ(m.penetration_m, 0);
  EXPECT_NEAR(m.penetration_between_m, 0.02, 1e-12);
  EXPECT_EQ(m.penetration_frame, 3);
  EXPECT_EQ(m.penetration_over_1cm_percent, 0);
}

TEST_F(MeasureTest, SelfPenetrationOfTwoForearms) {
  // Shoulders put so near to each other that the two arms, stretched ahead in parallel, overlap by
  // 1 cm from elbow to wrist; the upper arms are made thin, so that the forearms are the deepest.
  Body& body = subject_.body[0];
  const double overlap = 0.01;
  const double gap = Radius(0, "left_wrist") + Radius(0, "right_wrist") - overlap;
  for (const double x : {1.0, -1.0}) {
    const std::string side = x > 0 ? "left" : "right";
    const double centre = body.links[body.FindLink(side + "_clavicle")].centre.x();
    const double shoulder = 0.5 * x * gap - centre;
    body.links[body.FindLink(side + "_shoulder")].centre.x() = shoulder;
    body.nodes[body.FindNode(side + "_shoulder")].offset.x() = shoulder;
    body.nodes[body.FindNode(side + "_elbow")].radius = 1e-3;
    Each(0, [&](int, Pose* pose) {
      pose->rotation[body.FindLink(side + "_shoulder")] = Turn(0, -90 * x, 0);
    });
  }
  const Metrics m = Run();
  EXPECT_NEAR(m.figure[0].self_penetration_m, overlap, 1e-12);
  EXPECT_EQ(m.figure[1].self_penetration_m, 0);
  EXPECT_EQ(m.penetration_m, 0);
}

TEST_F(MeasureTest, FootDriftAndSpeedOfASlidingBody) {
  // 4 mm along X and 3 mm along Z per frame: 5 mm per frame, 0.15 m/s at 30 fps.
  Each(0, [](int t, Pose* pose) { pose->root_position += t * Vec3(0.004, 0, 0.003); });
  subject_.contacts[0] = {{Node(0, "left_toe"), 2, 8}};
  const Metrics m = Run();
  EXPECT_NEAR(m.figure[0].foot_drift_m, 6 * 0.005, 1e-12);
  EXPECT_EQ(m.figure[0].foot_drift_frame, 8);
  EXPECT_NEAR(m.figure[0].foot_speed_max, 0.15, 1e-10);
  EXPECT_EQ(m.figure[0].foot_speed_over_1cm_percent, 100);
  EXPECT_TRUE(std::isnan(m.figure[1].foot_drift_m));
}

TEST_F(MeasureTest, DriftIsHorizontalAndCountsFromTheContactsBeginning) {
  // Up by 1 cm per frame: no drift, but 0.3 m/s. Then there and back along X: the drift is 4 cm.
  Each(0, [](int t, Pose* pose) { pose->root_position.y() += 0.01 * t; });
  Each(1, [](int t, Pose* pose) { pose->root_position.x() += t < 5 ? 0.01 * t : 0.01 * (8 - t); });
  subject_.contacts[0] = {{Node(0, "left_ankle"), 0, 10}};
  subject_.contacts[1] = {{Node(1, "left_ankle"), 0, 8}};
  const Metrics m = Run();
  EXPECT_NEAR(m.figure[0].foot_drift_m, 0, 1e-12);
  EXPECT_NEAR(m.figure[0].foot_speed_max, 0.3, 1e-10);
  EXPECT_NEAR(m.figure[1].foot_drift_m, 0.04, 1e-12);
  EXPECT_EQ(m.figure[1].foot_drift_frame, 4);
}

TEST_F(MeasureTest, SlidingShareCountsStanceFramesOverOneCentimetrePerSecond) {
  // Contact of frames 0 to 10: 10 steps, of which those into frames 1, 2 and 3 slide.
  Each(0, [](int t, Pose* pose) { pose->root_position.x() += 0.001 * std::min(t, 3); });
  subject_.contacts[0] = {{Node(0, "left_ankle"), 0, 10}};
  EXPECT_NEAR(Run().figure[0].foot_speed_over_1cm_percent, 30, 1e-10);
}

TEST_F(MeasureTest, FloorDepthIsOfTheLowestCapsulePoint) {
  // The ankle's widest capsule is the shank's; let it reach 7 mm below the floor in frame 4.
  const Body& body = subject_.body[0];
  const double ankle = PoseBody(body, RestPose(body)).node[Node(0, "left_ankle")].y();
  const double shank = std::max(Radius(0, "left_ankle"), Radius(0, "left_toe"));
  Each(0, [&](int t, Pose* pose) {
    pose->root_position.y() = shank - ankle + (t == 4 ? -0.007 : 0.01);
  });
  const Metrics m = Run();
  EXPECT_NEAR(m.figure[0].floor_m, 0.007, 1e-12);
  EXPECT_EQ(m.figure[1].floor_m, 0);
}

TEST_F(MeasureTest, JerkOfACubicRootIsSixTimesItsCoefficient) {
  // x = c t^3 gives a third derivative of 6 c, and third differences of a cubic are exact.
  const Vec3 c(0.3, -0.2, 0.6);  // |c| = 0.7
  for (int t = 0; t < kFrames; ++t) {
    const double s = t / 30.0;
    motion_[0].frames[t].root_position += s * s * s * c;
    source_[0].frames[t].root_position += 0.5 * s * s * s * c;
    source_[1].frames[t].root_position += 2 * s * s * s * c;
    motion_[1].frames[t].root_position += s * s * Vec3(1, 2, 3);  // a parabola has none
  }
  const Metrics m = Run();
  EXPECT_NEAR(m.figure[0].jerk, 6 * 0.7, 1e-8);
  EXPECT_NEAR(m.figure[0].jerk_ratio_own, 2, 1e-8);
  EXPECT_NEAR(m.figure[0].jerk_ratio_larger, 0.5, 1e-8);
  EXPECT_NEAR(m.figure[1].jerk, 0, 1e-8);
  EXPECT_NEAR(m.figure[1].jerk_ratio_larger, 0, 1e-8);
}

TEST_F(MeasureTest, JerkIsPerSecondWhateverTheRate) {
  for (const double fps : {25.0, 60.0, 120.0}) {
    for (int f = 0; f < 2; ++f) motion_[f].fps = source_[f].fps = fps;
    for (int t = 0; t < kFrames; ++t) {
      motion_[0].frames[t].root_position =
          standing_[0].root_position + Vec3(std::pow(t / fps, 3), 0, 0);
    }
    EXPECT_NEAR(Run().figure[0].jerk, 6, 1e-5) << fps;
  }
}

TEST_F(MeasureTest, PoseErrorIgnoresPlaceAndHeading) {
  Each(0, [](int t, Pose* pose) {
    *pose = Moved(*pose, YawRotation(0.3 + 0.1 * t), Vec3(1, 0.5, -2));
  });
  const Metrics m = Run();
  EXPECT_LT(m.figure[0].pose_error_cm, 1e-10);
  EXPECT_LT(m.figure[0].joint_edit_deg, 1e-5);
}

TEST_F(MeasureTest, JointEditIsTheMeanTurnOfTheJoints) {
  // One joint of 18 by 36 degrees: 2 degrees in the mean. A leg bent ahead also moves its nodes.
  Each(0, [&](int, Pose* pose) { pose->rotation[Link(0, "left_knee")] = Turn(36, 0, 0); });
  const Metrics m = Run();
  EXPECT_NEAR(m.figure[0].joint_edit_deg, 2, 1e-9);
  EXPECT_EQ(m.figure[1].joint_edit_deg, 0);
  // Ankle and toe move; by symmetry of the rest the best yaw is not quite zero, so only bounds: the
  // ankle goes 2 l sin(18 deg), of 20 nodes.
  const double shank = subject_.length[0][Node(0, "left_ankle")];
  EXPECT_GT(m.figure[0].pose_error_cm, 100 * 2 * shank * std::sin(18 * kDegree) / 20);
  EXPECT_LT(m.figure[0].pose_error_cm, 100 * 6 * shank * std::sin(18 * kDegree) / 20);
}

TEST_F(MeasureTest, PathLengthIsRelativeToTheRoot) {
  Each(0, [&](int t, Pose* pose) {
    pose->root_position += Vec3(0.1 * t, 0, 0);
    pose->rotation[Link(0, "left_elbow")] = Turn(0, -3.0 * t, 0);
  });
  const Metrics m = Run();
  const double forearm = subject_.length[0][Node(0, "left_wrist")];
  // Ten chords of 3 degrees.
  EXPECT_NEAR(m.figure[0].path_m[Node(0, "left_wrist")], 10 * 2 * forearm * std::sin(1.5 * kDegree),
              1e-12);
  EXPECT_NEAR(m.figure[0].path_m[Node(0, "left_elbow")], 0, 1e-12);
}

TEST_F(MeasureTest, SegmentLengthErrorIsTheLargestButOfNeckShoulder) {
  subject_.length[0][Node(0, "left_wrist")] /= 1.01;
  subject_.length[0][Node(0, "right_ankle")] /= 0.98;
  subject_.length[0][Node(0, "left_shoulder")] /= 1.5;
  EXPECT_NEAR(Run().figure[0].length_error_percent, 2, 1e-9);
}

TEST_F(MeasureTest, HoldErrorIsTheLargestDistanceOfTheHeldPoints) {
  const PosedBody a = PoseBody(subject_.body[0], standing_[0]);
  const PosedBody b = PoseBody(subject_.body[1], standing_[1]);
  Hold to_world, together;
  to_world.from = {0, Node(0, "left_hand"), Vec3(0.01, 0.02, 0.03)};
  to_world.to = {kWorld, 0, a.node[Node(0, "left_hand")] + Vec3(0.01, 0.02, 0.03)};
  together.from = {0, Node(0, "head_top"), Vec3::Zero()};
  together.to = {1, Node(1, "root"), a.node[Node(0, "head_top")] - b.node[0]};
  subject_.holds = {to_world, together};
  EXPECT_LT(Run().hold_m[0] + Run().hold_m[1], 1e-12);
  // a hops sideways by 5 cm at frame 7; b turns by 90 degrees about its own root at frame 2.
  motion_[0].frames[7].root_position += Vec3(0.03, 0, 0.04);
  motion_[1].frames[2].rotation[0] = Turn(0, 90, 0);
  const Metrics m = Run();
  EXPECT_NEAR(m.hold_m[0], 0.05, 1e-12);
  EXPECT_EQ(m.hold_frame[0], 7);
  const double lever = std::hypot(together.to.offset.x(), together.to.offset.z());
  EXPECT_NEAR(m.hold_m[1], std::sqrt(2) * lever, 1e-12);
  EXPECT_EQ(m.hold_frame[1], 2);
}

// a's arms are stretched along X. b stands with its stretched arms along Z (turned by 90 degrees),
// its left forearm crossing a's left forearm in the middle, and its height above a's is given.
class SweptArms : public MeasureTest {
 protected:
  Vec3 Middle(int f, const Pose& pose) const {
    const PosedBody posed = PoseBody(subject_.body[f], pose);
    return 0.5 * (posed.node[Node(f, "left_elbow")] + posed.node[Node(f, "left_wrist")]);
  }
  void SetHeights(const std::function<double(int)>& above) {
    const Vec3 target = Middle(0, standing_[0]);
    Each(1, [&](int t, Pose* pose) {
      pose->rotation[0] = Turn(0, 90, 0);
      pose->root_position += target + Vec3(0, above(t), 0) - Middle(1, *pose);
    });
  }
};

TEST_F(SweptArms, AnArmThroughAnArmIsAPassThrough) {
  // From 5.6 cm above to 4.4 cm below in steps of 1 cm: through between frames 5 and 6.
  SetHeights([](int t) { return 0.056 - 0.01 * t; });
  const Metrics m = Run();
  ASSERT_EQ(m.pass_throughs.size(), 1u);
  EXPECT_EQ(m.pass_throughs[0].frame, 5);
  EXPECT_EQ(m.pass_throughs[0].node_a, Node(0, "left_wrist"));
  EXPECT_EQ(m.pass_throughs[0].node_b, Node(1, "left_wrist"));
}

TEST_F(SweptArms, ThereAndBackCountsTwice) {
  SetHeights([](int t) { return 0.036 - 0.01 * std::min(t, 10 - t); });
  const Metrics m = Run();
  ASSERT_EQ(m.pass_throughs.size(), 2u);
  EXPECT_EQ(m.pass_throughs[0].frame, 3);
  EXPECT_EQ(m.pass_throughs[1].frame, 6);
}

TEST_F(SweptArms, ComingCloseAndGoingAwayIsNone) {
  SetHeights([](int t) { return 0.005 + 0.01 * std::abs(5 - t); });
  const Metrics m = Run();
  EXPECT_TRUE(m.pass_throughs.empty());
  // Crossing axes: the depth is that of the forearms, at the closest 5 mm.
  EXPECT_NEAR(m.penetration_m, Radius(0, "left_wrist") + Radius(1, "left_wrist") - 0.005, 1e-12);
}

TEST_F(SweptArms, ThroughTheElbowIsSeenAsWell) {
  // b's forearm crosses a's elbow itself, so that upper arm and forearm share the jump.
  const Vec3 shift(-0.5 * subject_.length[0][Node(0, "left_wrist")], 0, 0);
  SetHeights([](int t) { return 0.056 - 0.01 * t; });
  Each(1, [&](int, Pose* pose) { pose->root_position += shift; });
  const Metrics m = Run();
  ASSERT_EQ(m.pass_throughs.size(), 1u);
  EXPECT_EQ(m.pass_throughs[0].frame, 5);
}

TEST_F(SweptArms, TheTagOfACrossingFlipsItsSign) {
  // Crossing forearms as the only tag: |GLI| under one half always, and the sign turns in the
  // middle.
  TangleTarget held;
  held.tag.tangle.a = {Node(0, "left_elbow"), Node(0, "left_wrist")};
  held.tag.tangle.b = {Node(1, "left_elbow"), Node(1, "left_wrist")};
  subject_.tangles = {held};
  SetHeights([](int t) { return 0.0501 - 0.01 * t; });
  const Metrics plus = Run();
  subject_.tangles[0].sign = -1;
  const Metrics minus = Run();
  EXPECT_EQ(plus.tangles[0].frames_below_half, kFrames);
  EXPECT_EQ(plus.tangle_kept_percent, 0);
  const double smallest = std::min(plus.smallest_gli, minus.smallest_gli);
  EXPECT_NEAR(smallest, -0.5, 0.01);  // 0.1 mm apart
  EXPECT_LE(plus.smallest_gli_between, plus.smallest_gli);
  EXPECT_LT(std::max(plus.smallest_gli, minus.smallest_gli), -0.4);  // 1 cm apart on the other side
}

TEST_F(MeasureTest, TanglesAreCountedFrameByFrame) {
  // The posture of the rough hug is kept for 8 frames and left for 3.
  const TemplatePosture hug = RoughHug(subject_.body[0], subject_.body[1]);
  const TemplateTangles found = FindTemplateTangles(hug, {});
  ASSERT_FALSE(found.tags.empty());
  subject_.tangles = TangleTargets({found.tags[0]}, hug, 0.05);
  for (int f = 0; f < 2; ++f) {
    Each(f, [&](int t, Pose* pose) {
      *pose = hug.pose[f];
      if (f == 1 && t >= 8) pose->root_position.z() += 3;
    });
  }
  const Metrics m = Run();
  EXPECT_EQ(m.tangles[0].frames_below_half, 3);
  EXPECT_NEAR(m.tangle_kept_percent, 100.0 * 8 / 11, 1e-12);
  EXPECT_GE(m.tangles[0].worst_frame, 8);
  EXPECT_NEAR(m.smallest_gli, 0, 0.05);
}

TEST_F(MeasureTest, RequirementsMetAndMissed) {
  subject_.tangles.resize(1);
  subject_.tangles[0].tag.tangle.a = {Node(0, "left_hand"), Node(0, "right_hand")};
  subject_.tangles[0].tag.tangle.b = {Node(1, "root"), Node(1, "head_top")};
  subject_.holds.resize(1);
  Metrics m = Run();
  m.tangles[0] = {0.61, 0.60, 0, 4};
  const Requirements limits;
  using Kind = RequirementKind;
  const auto check = [&](Kind kind, int figure = -1) {
    for (const RequirementCheck& c : CheckRequirements(subject_, m, limits)) {
      if (c.kind == kind && c.figure == figure) return c;
    }
    ADD_FAILURE() << "no such requirement";
    return RequirementCheck{};
  };
  const auto missed = [&] {
    std::vector<std::pair<Kind, int>> kinds;  // with the figure
    for (const RequirementCheck& c : CheckRequirements(subject_, m, limits)) {
      if (!c.met) kinds.emplace_back(c.kind, c.figure);
    }
    return kinds;
  };
  using Missed = std::vector<std::pair<Kind, int>>;
  const auto limbs = [](const RequirementCheck& c) {
    std::vector<std::pair<int, int>> out;
    for (const LimbNode& limb : c.limbs) out.emplace_back(limb.figure, limb.node);
    return out;
  };
  using Limbs = std::vector<std::pair<int, int>>;
  m.hold_m = {0.0199};
  EXPECT_EQ(missed(), Missed{});
  EXPECT_EQ(check(Kind::kTangle).value, 0.60);
  EXPECT_EQ(check(Kind::kTangle).item, 0);
  EXPECT_EQ(check(Kind::kTangle).frame, 4);
  EXPECT_EQ(limbs(check(Kind::kTangle)), (Limbs{{0, Node(0, "left_hand")},
                                                {0, Node(0, "right_hand")},
                                                {1, Node(1, "root")},
                                                {1, Node(1, "head_top")}}));
  m.tangles[0].min_signed_gli_between = 0.5;  // must be over, not at
  EXPECT_EQ(missed(), (Missed{{Kind::kTangle, -1}}));
  m.tangles[0].min_signed_gli_between = 0.51;
  m.hold_m = {0.0201};
  m.hold_frame = {9};
  EXPECT_EQ(missed(), (Missed{{Kind::kHold, -1}}));
  EXPECT_EQ(check(Kind::kHold).item, 0);
  EXPECT_EQ(check(Kind::kHold).frame, 9);
  m.hold_m = {0.02};
  m.pass_throughs = {{7, Node(0, "left_wrist"), Node(1, "head")}};
  EXPECT_EQ(missed(), (Missed{{Kind::kPassThroughs, -1}}));
  EXPECT_EQ(check(Kind::kPassThroughs).frame, 7);
  EXPECT_EQ(limbs(check(Kind::kPassThroughs)),
            (Limbs{{0, Node(0, "left_wrist")}, {1, Node(1, "head")}}));
  m.pass_throughs.clear();
  m.penetration_between_m = 0.021;
  m.penetration_frame = 3;
  m.penetration_node_a = Node(0, "left_hand");
  m.penetration_node_b = Node(1, "chest");
  EXPECT_EQ(missed(), (Missed{{Kind::kPenetration, -1}}));
  EXPECT_EQ(check(Kind::kPenetration).value, 0.021);
  EXPECT_EQ(check(Kind::kPenetration).frame, 3);
  EXPECT_EQ(limbs(check(Kind::kPenetration)),
            (Limbs{{0, Node(0, "left_hand")}, {1, Node(1, "chest")}}));
  m.penetration_between_m = 0.02;
  m.penetration_over_1cm_percent = 1.1;
  EXPECT_EQ(missed(), (Missed{{Kind::kPenetrationOver1cm, -1}}));
  m.penetration_over_1cm_percent = 1;
  m.figure[1].foot_drift_m = 0.011;
  m.figure[1].foot_drift_frame = 5;
  EXPECT_EQ(missed(), (Missed{{Kind::kFootDrift, 1}}));
  EXPECT_EQ(check(Kind::kFootDrift, 1).frame, 5);
  m.figure[1].foot_drift_m = 0;
  m.figure[0].floor_m = 0.011;
  EXPECT_EQ(missed(), (Missed{{Kind::kFloor, 0}}));
}

TEST_F(MeasureTest, WhatIsWrittenMustFitToo) {
  Metrics m = Run();
  m.figure[1].length_error_percent = 0.51;
  Requirements limits;
  const auto missed = [&](const std::array<double, 2>& write_back_m) {
    std::vector<std::pair<RequirementKind, int>> out;
    for (const RequirementCheck& c : CheckWritten(m, write_back_m, limits)) {
      if (!c.met) out.emplace_back(c.kind, c.figure);
    }
    return out;
  };
  using Missed = std::vector<std::pair<RequirementKind, int>>;
  EXPECT_EQ(missed({0.005, 0.0051}),
            (Missed{{RequirementKind::kWriteBack, 1}, {RequirementKind::kSegmentLength, 1}}));
  limits.segment_length_percent = 1;
  limits.write_back_m = 0.004;
  EXPECT_EQ(missed({0.005, 0.003}), (Missed{{RequirementKind::kWriteBack, 0}}));
}

}  // namespace
}  // namespace retarget::solver
