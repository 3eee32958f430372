// Holding hands, and how far they are from what they hold: known by construction.
#include "solver/metrics/hand_metrics.h"

#include <gtest/gtest.h>

#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

MetricsContext HoldingOne(const Scene& scene, const char* hand, int to_figure, const char* to) {
  MetricsContext subject = MetricsContextOf(scene);
  Hold hold;
  hold.from = {0, scene.body[0].FindNode(hand), Vec3::Zero()};
  hold.to = {to_figure, scene.body[to_figure].FindNode(to), Vec3::Zero()};
  subject.holds = {hold};
  return subject;
}

TEST(HandMetrics, HandsHoldTheSegmentsAtTheHeldNode) {
  const Scene scene = SmallScene(2, 0);
  const Body& b = scene.body[1];
  const std::vector<HoldingHand> hands =
      HoldingHands(HoldingOne(scene, "left_wrist", 1, "right_knee"));
  ASSERT_EQ(hands.size(), 1u);
  EXPECT_EQ(hands[0].segments, (std::vector<int>{scene.body[0].FindNode("left_hand"),
                                                 scene.body[0].FindNode("left_wrist")}));
  EXPECT_EQ(hands[0].to, (std::vector<int>{b.FindNode("right_knee"), b.FindNode("right_ankle")}));
  // Its own forearm is no surface that a hand could be off.
  EXPECT_TRUE(HoldingHands(HoldingOne(scene, "left_hand", 0, "left_elbow")).empty());
  EXPECT_TRUE(HoldingHands(HoldingOne(scene, "left_ankle", 1, "right_knee")).empty());
  // By whichever end has the hand.
  MetricsContext swapped = HoldingOne(scene, "left_hand", 1, "right_knee");
  std::swap(swapped.holds[0].from, swapped.holds[0].to);
  ASSERT_EQ(HoldingHands(swapped).size(), 1u);
  EXPECT_EQ(HoldingHands(swapped)[0].figure, 0);
}

TEST(HandMetrics, TheGapIsThe95thPercentileOfTheNearerOfHandAndForearm) {
  const Scene scene = SmallScene(2, 0);
  MetricsContext subject = MetricsContextOf(scene);
  subject.holds.clear();
  const int hand = scene.body[0].FindNode("right_hand"),
            knee = scene.body[1].FindNode("right_knee");
  subject.hand_contacts = {{0, hand, 0.5, knee, 0.5}};
  const int wrist = scene.body[0].nodes[hand].parent, elbow = scene.body[0].nodes[wrist].parent;
  const int hip = scene.body[1].nodes[knee].parent;
  // The thigh stands upright; the arm points at its middle along x, 1 to 20 cm off over 20 frames.
  std::vector<NodePositions> frames;
  for (int t = 1; t <= 20; ++t) {
    NodePositions node = {std::vector<Vec3>(21, Vec3::Zero()), std::vector<Vec3>(21, Vec3::Zero())};
    node[1][hip] = Vec3(0, 1, 0);
    node[1][knee] = Vec3(0, 0.5, 0);
    const double radii = scene.body[0].nodes[hand].radius + scene.body[1].nodes[knee].radius;
    node[0][hand] = Vec3(radii + 0.01 * t, 0.75, 0);
    node[0][wrist] = node[0][hand] + Vec3(0.1, 0, 0);
    node[0][elbow] = node[0][wrist] + Vec3(0.25, 0, 0);
    frames.push_back(node);
  }
  EXPECT_NEAR(HoldingHandGap(subject, 0, frames), 0.19, 1e-9);
  EXPECT_TRUE(std::isnan(HoldingHandGap(subject, 1, frames)));
  // The forearm alone lies against the thigh in one more frame in 20: the percentile stays within.
  for (NodePositions& node : frames) std::swap(node[0][hand], node[0][elbow]);
  const double off = scene.body[0].nodes[wrist].radius - scene.body[0].nodes[hand].radius;
  EXPECT_NEAR(HoldingHandGap(subject, 0, frames), 0.19 - off, 1e-9);
}

}  // namespace
}  // namespace retarget::solver
