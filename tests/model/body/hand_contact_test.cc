// Gaps of capsules against closed forms, and which contacts a posture shows.
#include "model/body/hand_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/geometry/so3.h"

namespace retarget {
namespace {

// Two figures in the T-pose, side by side: a's left hand points at b.
struct Pair {
  std::array<Body, 2> body = {StandardBody(AverageMeasures(1.8)),
                              StandardBody(AverageMeasures(1.7))};
  std::array<Pose, 2> pose = {RestPose(body[0]), RestPose(body[1])};
  std::array<PosedBody, 2> Posed() const {
    return {PoseBody(body[0], pose[0]), PoseBody(body[1], pose[1])};
  }
  int Node(int figure, const char* name) const { return body[figure].FindNode(name); }
};

TEST(HandContact, GapIsThatOfTheSurfaces) {
  Pair pair;
  const int hand = pair.Node(0, "left_hand"), other = pair.Node(1, "right_hand");
  // Arms in one line, tip to tip.
  const auto at = [&] { return pair.Posed(); };
  const double tips = at()[0].node[hand].x() - at()[1].node[other].x();
  const double height = at()[0].node[hand].y() - at()[1].node[other].y();
  pair.pose[1].root_position += Vec3(tips + 0.3, height, 0);
  const double depth = at()[0].node[hand].z() - at()[1].node[other].z();
  pair.pose[1].root_position.z() += depth;
  const double radii = pair.body[0].nodes[hand].radius + pair.body[1].nodes[other].radius;
  const auto gap = [&] {
    return SurfaceGap(pair.body[0], at()[0].node, hand, pair.body[1], at()[1].node, other);
  };
  EXPECT_NEAR(gap(), 0.3 - radii, 1e-9);
  pair.pose[1].root_position.x() -= 0.3 - 0.5 * radii;
  EXPECT_NEAR(gap(), -0.5 * radii, 1e-9) << "they overlap";
}

TEST(HandContact, AHandTouchesTheNearestSegmentWithinReach) {
  Pair pair;
  const int hand = pair.Node(0, "left_hand"), elbow = pair.Node(1, "right_wrist");
  const std::array<PosedBody, 2> before = pair.Posed();
  // The middle of b's right forearm 2 cm off the tip of a's hand, along the hand.
  const Vec3 tip = before[0].node[hand];
  const int inner = pair.body[1].nodes[elbow].parent;
  const Vec3 middle = 0.5 * (before[1].node[elbow] + before[1].node[inner]);
  // b turned by a quarter, so that its arm lies across.
  pair.pose[1].rotation[0] = ExpSo3(Vec3(0, 0.5 * kPi, 0));
  const Vec3 turned = pair.pose[1].rotation[0] * (middle - before[1].node[0]);
  const double radii = pair.body[0].nodes[hand].radius + pair.body[1].nodes[elbow].radius;
  pair.pose[1].root_position = tip + Vec3(radii + 0.02, 0, 0) - turned;
  const std::vector<HandContact> found = FindHandContacts(pair.body, pair.Posed(), 0.03);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].figure, 0);
  EXPECT_EQ(found[0].hand, hand);
  EXPECT_EQ(found[0].to, elbow);
  EXPECT_NEAR(found[0].along, 1, 1e-6);
  EXPECT_NEAR(found[0].to_along, 0.5, 0.02);
  EXPECT_TRUE(FindHandContacts(pair.body, pair.Posed(), 0.015).empty());
  // The other way round it is b's.
  const std::vector<HandContact> swapped =
      FindHandContacts({pair.body[1], pair.body[0]}, {pair.Posed()[1], pair.Posed()[0]}, 0.03);
  ASSERT_EQ(swapped.size(), 1u);
  EXPECT_EQ(swapped[0].figure, 1);
  EXPECT_EQ(swapped[0].to, elbow);
}

}  // namespace
}  // namespace retarget
