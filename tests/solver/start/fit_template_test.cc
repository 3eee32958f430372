// Fitting a template to other bodies: what is right stays, what is broken is mended. The outcome is
// judged by Measure and by distances, not by residuals.
#include "solver/start/fit_template.h"

#include <gtest/gtest.h>

#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"
#include "solver/metrics/metrics.h"
#include "tests/solver/scene_fixture.h"

namespace retarget::solver {
namespace {

std::array<PosedBody, 2> PosedOf(const TemplatePosture& posture) {
  return {PoseBody(posture.body[0], posture.pose[0]), PoseBody(posture.body[1], posture.pose[1])};
}

double DeepestBetween(const TemplatePosture& posture) {
  const auto posed = PosedOf(posture);
  double deepest = -1;
  for (int i = 1; i < posture.body[0].num_nodes(); ++i) {
    for (int j = 1; j < posture.body[1].num_nodes(); ++j) {
      const Node &a = posture.body[0].nodes[i], &b = posture.body[1].nodes[j];
      const ClosestPoints closest = ClosestPointsOfSegments(
          posed[0].node[a.parent], posed[0].node[i], posed[1].node[b.parent], posed[1].node[j]);
      deepest = std::max(deepest, a.radius + b.radius - closest.distance);
    }
  }
  return deepest;
}

double HoldError(const TemplatePosture& posture) {
  const auto posed = PosedOf(posture);
  double largest = 0;
  for (const Hold& hold : posture.holds) {
    largest = std::max(largest, (HoldPosition(hold.from, posture.body, posed) -
                                 HoldPosition(hold.to, posture.body, posed))
                                    .norm());
  }
  return largest;
}

double SignedGli(const TemplatePosture& posture, const Tag& tag) {
  const auto posed = PosedOf(posture);
  std::array<std::vector<Vec3>, 2> points;
  for (int f = 0; f < 2; ++f) {
    for (const int n : NodesOn(posture.body[f], f == 0 ? tag.tangle.a : tag.tangle.b)) {
      points[f].push_back(posed[f].node[n]);
    }
  }
  return (tag.tangle.gli < 0 ? -1 : 1) * PolylineGli(points[0], points[1]);
}

// A hold of two points that coincide in the posture as it stands.
Hold HoldAsPosed(const TemplatePosture& posture, int figure_from, const char* from, int figure_to,
                 const char* to) {
  const auto posed = PosedOf(posture);
  Hold hold;
  hold.from = {figure_from, posture.body[figure_from].FindNode(from), Vec3::Zero()};
  hold.to = {figure_to, posture.body[figure_to].FindNode(to), Vec3::Zero()};
  const Mat3& frame = posed[figure_to].rotation[posture.body[figure_to].nodes[hold.to.node].link];
  hold.to.offset = frame.transpose() *
                   (posed[figure_from].node[hold.from.node] - posed[figure_to].node[hold.to.node]);
  return hold;
}

TemplatePosture HeldHug() {
  TemplatePosture posture =
      RoughHug(StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.70)));
  posture.holds = {HoldAsPosed(posture, 0, "left_hand", 0, "right_hand"),
                   HoldAsPosed(posture, 0, "right_wrist", 1, "chest")};
  return posture;
}

TEST(FitTemplate, ToTheSameBodiesChangesNothingWhereNothingIsViolated) {
  TemplatePosture posture = HeldHug();
  for (Body& body : posture.body) {
    for (Node& node : body.nodes) node.radius *= 0.01;  // thin enough not to touch
  }
  for (Pose& pose : posture.pose) pose.root_position.y() += 0.3;  // clear of the floor
  ASSERT_LT(DeepestBetween(posture), 0);
  const TemplateTangles tangles = FindTemplateTangles(posture, {});
  ASSERT_FALSE(tangles.tags.empty());
  const TemplatePosture fitted = FitTemplate(posture, posture.body, tangles.tags, {});
  for (int f = 0; f < 2; ++f) {
    EXPECT_LT((fitted.pose[f].root_position - posture.pose[f].root_position).norm(), 1e-9);
    for (size_t l = 0; l < posture.pose[f].rotation.size(); ++l) {
      EXPECT_LT(posture.pose[f].rotation[l].angularDistance(fitted.pose[f].rotation[l]), 1e-7);
    }
  }
  EXPECT_EQ(fitted.holds.size(), posture.holds.size());
  EXPECT_EQ(fitted.supports, posture.supports);
}

TEST(FitTemplate, OnBodiesKeepsRotationsAndScalesHeightsAndOffsets) {
  const TemplatePosture posture = HeldHug();
  const std::array<Body, 2> body = {ScaledTo(posture.body[0], 0.9),
                                    ScaledTo(posture.body[1], 0.85)};
  const TemplatePosture laid = OnBodies(posture, body);  // both at half the stature
  for (int f = 0; f < 2; ++f) {
    EXPECT_NEAR(laid.pose[f].root_position.y(), 0.5 * posture.pose[f].root_position.y(), 1e-14);
    for (size_t l = 0; l < posture.pose[f].rotation.size(); ++l) {
      EXPECT_EQ(laid.pose[f].rotation[l].coeffs(), posture.pose[f].rotation[l].coeffs());
    }
  }
  const Vec3 before = posture.pose[1].root_position - posture.pose[0].root_position;
  const Vec3 after = laid.pose[1].root_position - laid.pose[0].root_position;
  EXPECT_LT((after - 0.5 * before).norm(), 1e-14);
  EXPECT_LT((laid.holds[0].to.offset - 0.5 * posture.holds[0].to.offset).norm(), 1e-14);
  // A picture at half the size: everything that was together still is, and all tangles are the
  // same.
  EXPECT_LT(HoldError(laid), 1e-14);
  const TemplateTangles one = FindTemplateTangles(posture, {}), two = FindTemplateTangles(laid, {});
  ASSERT_EQ(one.literal.size(), two.literal.size());
  for (size_t k = 0; k < one.literal.size(); ++k) {
    EXPECT_EQ(one.literal[k].a, two.literal[k].a);
    EXPECT_EQ(one.literal[k].b, two.literal[k].b);
    EXPECT_NEAR(one.literal[k].gli, two.literal[k].gli, 1e-10);
  }
}

TEST(FitTemplate, ToASmallerBodyRestoresHoldsTanglesAndDistance) {
  const TemplatePosture posture = HeldHug();
  const TemplateTangles tangles = FindTemplateTangles(posture, {});
  ASSERT_FALSE(tangles.tags.empty());
  for (const int smaller : {0, 1}) {
    std::array<Body, 2> body = posture.body;
    body[smaller] = ScaledTo(body[smaller], 0.75 * body[smaller].stature);
    const TemplatePosture laid = OnBodies(posture, body);
    // There is something to mend.
    EXPECT_GT(std::max(HoldError(laid), DeepestBetween(laid)), 0.02) << smaller;
    const TemplatePosture fitted = FitTemplate(posture, body, tangles.tags, {});
    EXPECT_LT(HoldError(fitted), 1e-3) << smaller;
    EXPECT_LT(DeepestBetween(fitted), 2e-3) << smaller;
    for (const Tag& tag : tangles.tags) EXPECT_GT(SignedGli(fitted, tag), 0.5) << smaller;
    // Still the same posture: no joint turned by more than a right angle.
    for (int f = 0; f < 2; ++f) {
      EXPECT_EQ(fitted.body[f].stature, body[f].stature);
      for (size_t l = 0; l < body[f].links.size(); ++l) {
        EXPECT_LT(posture.pose[f].rotation[l].angularDistance(fitted.pose[f].rotation[l]), kPi / 2);
      }
    }
  }
}

TEST(FitTemplate, LockedJointsKeepTheirRotation) {
  TemplatePosture posture = HeldHug();
  std::array<Body, 2> body = posture.body;
  body[1] = ScaledTo(body[1], 0.75 * body[1].stature);
  const int chest = body[0].FindLink("chest"), elbow = body[0].FindLink("left_elbow");
  body[0].links[chest].locked = body[0].links[elbow].locked = true;
  const TemplateTangles tangles = FindTemplateTangles(posture, {});
  const TemplatePosture fitted = FitTemplate(posture, body, tangles.tags, {});
  double largest = 0;
  for (int l = 0; l < body[0].num_links(); ++l) {
    const double turn = posture.pose[0].rotation[l].angularDistance(fitted.pose[0].rotation[l]);
    if (l == chest || l == elbow) {
      EXPECT_LT(turn, 1e-7);
    }
    largest = std::max(largest, turn);
  }
  EXPECT_GT(largest, 0.01);  // the others did turn
}

TEST(FitTemplate, TheUsersOwnTanglesStandAsTheyAre) {
  TemplatePosture posture = HeldHug();
  const Body &a = posture.body[0], &b = posture.body[1];
  TangleRequest request;
  request.a = {a.FindNode("left_hand"), a.FindNode("right_elbow")};
  request.b = {b.FindNode("root"), b.FindNode("head_top")};
  posture.tangles = {request};
  const TemplateTangles tangles = FindTemplateTangles(posture, {});
  ASSERT_EQ(tangles.tags.size(), 1u);
  EXPECT_EQ(tangles.tags[0].tangle.a, request.a);
  EXPECT_EQ(tangles.tags[0].tangle.b, request.b);
  EXPECT_NEAR(SignedGli(posture, tangles.tags[0]), std::abs(tangles.tags[0].tangle.gli), 1e-12);
  EXPECT_FALSE(tangles.literal.empty());
}

TEST(FitTemplate, TagsAimNoHigherThanTheTemplate) {
  const TemplatePosture posture = HeldHug();
  const TemplateTangles tangles = FindTemplateTangles(posture, {});
  for (const double margin : {0.0, 0.05, 0.5}) {
    const auto held = TangleTargets(tangles.tags, posture, margin);
    ASSERT_EQ(held.size(), tangles.tags.size());
    for (size_t k = 0; k < held.size(); ++k) {
      const double here = SignedGli(posture, tangles.tags[k]);
      EXPECT_NEAR(held[k].target, std::min(0.5 + margin, here), 1e-12);
      EXPECT_EQ(held[k].sign, tangles.tags[k].tangle.gli < 0 ? -1 : 1);
    }
  }
}

}  // namespace
}  // namespace retarget::solver
