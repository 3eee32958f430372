// Clips against the template's figures: an oracle in closed form, and what must not matter.
#include "solver/start/clip_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "model/geometry/so3.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

TemplatePosture TwoAtRest() {
  TemplatePosture posture;
  for (int f = 0; f < 2; ++f) {
    posture.body[f] = StandardBody(AverageMeasures(f == 0 ? 1.8 : 1.6));
    posture.pose[f] = RestPose(posture.body[f]);
  }
  return posture;
}

Pose Bent(const Body& body, const Pose& pose, const char* link, const Quat& by) {
  Pose out = pose;
  Quat& rotation = out.rotation[body.FindLink(link)];
  rotation = rotation * by;
  return out;
}

TEST(ClipFit, NeitherPlaceNorHeadingNorSizeMatters) {
  const TemplatePosture posture = TwoAtRest();
  const FigurePosture figure(posture, 0, {});
  for (const double yaw : {0.0, 1.0, -2.5, kPi}) {
    const Pose pose = Moved(posture.pose[0], YawRotation(yaw), Vec3(3, -0.2, 1));
    EXPECT_LT(figure.DistanceOf(pose).value(), 1e-12);
    EXPECT_NEAR(std::remainder(figure.DistanceOf(pose).yaw + yaw, 2 * kPi), 0, 1e-12);
  }
  // Any other posture is as far from a figure of one size as from that of another.
  TemplatePosture larger = posture;
  larger.body[0] = ScaledTo(posture.body[0], 2.5);
  const Pose bent = Bent(posture.body[0], posture.pose[0], "left_knee", Turn(70, 0, 0));
  EXPECT_GT(figure.DistanceOf(bent).value(), 0.01);
  EXPECT_NEAR(FigurePosture(larger, 0, {}).DistanceOf(bent).value(),
              figure.DistanceOf(bent).value(), 1e-12);
}

// Both forearms of a T-pose turned up by an angle: wrists and hands move on circles round the
// elbows, no turn about the vertical makes that less, and nothing else moves.
TEST(ClipFit, DistanceIsThatOfCircularArcs) {
  TemplatePosture posture = TwoAtRest();
  const Body& body = posture.body[0];
  const int wrist = body.FindNode("left_wrist"), hand = body.FindNode("left_hand");
  const double forearm = body.SegmentLength(wrist), palm = body.SegmentLength(hand);
  Tag arms;
  arms.tangle.a = {body.FindNode("left_hand"), body.FindNode("right_hand")};
  const int on_path = static_cast<int>(NodesOn(body, arms.tangle.a).size());
  for (const double degrees : {10.0, 45.0, 90.0}) {
    Pose pose = Bent(body, posture.pose[0], "left_elbow", Turn(0, 0, degrees));
    pose = Bent(body, pose, "right_elbow", Turn(0, 0, -degrees));
    const double chord = 2 * std::sin(0.5 * degrees * kPi / 180);
    const double sum =
        2 * chord * chord * (forearm * forearm + (forearm + palm) * (forearm + palm));
    const PostureDistance distance = FigurePosture(posture, 0, {arms}).DistanceOf(pose);
    EXPECT_NEAR(distance.whole, std::sqrt(sum / 20) / body.stature, 1e-9);
    EXPECT_NEAR(distance.involved, std::sqrt(sum / on_path) / body.stature, 1e-9);
    EXPECT_LT(distance.stance, 1e-12);
    EXPECT_NEAR(distance.yaw, 0, 1e-12);
    EXPECT_NEAR(distance.value(), std::hypot(distance.whole, distance.involved) / std::sqrt(2),
                1e-12);
  }
}

TEST(ClipFit, TheBestInstantIsWhereTheFigureIsMet) {
  const TemplatePosture posture = TwoAtRest();
  Clip clip;
  for (int t = 0; t < 30; ++t) {
    clip.frames.push_back(
        Bent(posture.body[1], posture.pose[1], "right_hip", Turn(4.0 * (t - 17), 0, 0)));
  }
  const Instant best = BestInstant(FigurePosture(posture, 1, {}), clip);
  EXPECT_EQ(best.frame, 17);
  EXPECT_LT(best.distance.value(), 1e-12);
}

// One who stands and one who sits.
TEST(ClipFit, SaysWhatDoesNotFit) {
  TemplatePosture posture = TwoAtRest();
  const auto sitting = [&](int f) {
    Pose pose = RestPose(posture.body[f]);
    for (const char* side : {"left", "right"}) {
      pose = Bent(posture.body[f], pose, (std::string(side) + "_hip").c_str(), Turn(-90, 0, 0));
      pose = Bent(posture.body[f], pose, (std::string(side) + "_knee").c_str(), Turn(90, 0, 0));
    }
    return pose;
  };
  const auto striding = [&](int f) {
    const Pose rest = RestPose(posture.body[f]);
    const Pose pose = Bent(posture.body[f], rest, "left_hip", Turn(-30, 0, 0));
    return Bent(posture.body[f], pose, "right_hip", Turn(25, 0, 0));
  };
  const auto lying = [&](int f) {
    Pose pose = RestPose(posture.body[f]);
    pose.rotation[0] = Turn(-90, 0, 0) * pose.rotation[0];
    return pose;
  };
  posture.pose[1] = sitting(1);
  const auto warnings = [&](const Pose& a, const Pose& b) {
    std::array<Clip, 2> clips;
    clips[0].frames = {a};
    clips[1].frames = {b};
    const std::vector<std::string> said =
        WarningsOf(FitOf(posture, {}, clips, 0), IsSameMotion(clips[0], clips[1]));
    return std::accumulate(said.begin(), said.end(), std::string(),
                           [](const std::string& x, const std::string& y) { return x + y + "\n"; });
  };
  const Pose stand = RestPose(posture.body[0]);
  EXPECT_EQ(warnings(stand, sitting(1)), "");
  EXPECT_EQ(warnings(striding(0), sitting(1)), "");
  EXPECT_NE(warnings(sitting(0), striding(1)).find("other way round"), std::string::npos);
  EXPECT_NE(warnings(stand, striding(1)).find("clip b does not fit figure b"), std::string::npos);
  EXPECT_NE(warnings(lying(0), sitting(1)).find("clip a fits no figure"), std::string::npos);
  EXPECT_NE(warnings(stand, lying(1)).find("clip b fits no figure"), std::string::npos);
  EXPECT_NE(warnings(stand, stand).find("same motion"), std::string::npos);
}

TEST(ClipFit, TheSameMotionElsewhereIsTheSameAndAnotherIsNot) {
  const Body body = StandardBody(AverageMeasures(1.7));
  const Clip clip = Fidget(body, RestPose(body), 20, 30, 5, 0.2);
  Clip elsewhere = clip;
  for (Pose& pose : elsewhere.frames) pose = Moved(pose, YawRotation(2), Vec3(1, 0, -3));
  EXPECT_TRUE(IsSameMotion(clip, clip));
  EXPECT_TRUE(IsSameMotion(clip, elsewhere));
  EXPECT_FALSE(IsSameMotion(clip, Fidget(body, RestPose(body), 20, 30, 6, 0.2)));
  Clip differs_once = clip;
  differs_once.frames[11] = Bent(body, clip.frames[11], "left_knee", Turn(40, 0, 0));
  EXPECT_FALSE(IsSameMotion(clip, differs_once));
  Clip shorter = clip;
  shorter.frames.pop_back();
  EXPECT_FALSE(IsSameMotion(clip, shorter));
}

}  // namespace
}  // namespace retarget::solver
