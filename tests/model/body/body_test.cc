// The body's table, rest pose and measures, spelled out by hand from the design.
#include "model/body/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/body/pose.h"
#include "model/geometry/so3.h"

namespace retarget {
namespace {

struct NodeRow {
  const char* name;
  const char* parent;
  const char* link;
};
const std::vector<NodeRow> kNodes = {
    {"root", "", "root"},
    {"chest", "root", "waist"},
    {"neck", "chest", "chest"},
    {"head", "neck", "neck"},
    {"head_top", "head", "head"},
    {"left_shoulder", "neck", "left_clavicle"},
    {"left_elbow", "left_shoulder", "left_shoulder"},
    {"left_wrist", "left_elbow", "left_elbow"},
    {"left_hand", "left_wrist", "left_wrist"},
    {"right_shoulder", "neck", "right_clavicle"},
    {"right_elbow", "right_shoulder", "right_shoulder"},
    {"right_wrist", "right_elbow", "right_elbow"},
    {"right_hand", "right_wrist", "right_wrist"},
    {"left_hip", "root", "root"},
    {"left_knee", "left_hip", "left_hip"},
    {"left_ankle", "left_knee", "left_knee"},
    {"left_toe", "left_ankle", "left_ankle"},
    {"right_hip", "root", "root"},
    {"right_knee", "right_hip", "right_hip"},
    {"right_ankle", "right_knee", "right_knee"},
    {"right_toe", "right_ankle", "right_ankle"},
};

// Measures that are all different, so that no two can be mistaken for each other.
BodyMeasures Peculiar() {
  BodyMeasures m;
  m.root_chest = 0.21, m.chest_neck = 0.27, m.neck_head = 0.09, m.head_top = 0.19;
  m.left.clavicle = Vec3(0.03, 0.24, 0.01), m.right.clavicle = Vec3(-0.02, 0.23, 0.02);
  m.left.clavicle_shoulder = 0.16, m.right.clavicle_shoulder = 0.17;
  m.left.shoulder_elbow = 0.31, m.right.shoulder_elbow = 0.32;
  m.left.elbow_wrist = 0.25, m.right.elbow_wrist = 0.26;
  m.left.wrist_hand = 0.08, m.right.wrist_hand = 0.085;
  m.left.hip = Vec3(0.09, -0.05, 0.01), m.right.hip = Vec3(-0.10, -0.06, 0.00);
  m.left.hip_knee = 0.42, m.right.hip_knee = 0.43;
  m.left.knee_ankle = 0.40, m.right.knee_ankle = 0.41;
  m.left.ankle_toe = 0.14, m.right.ankle_toe = 0.15;
  return m;
}

TEST(Body, HasTheNodesSegmentsJointsAndCoordinatesOfThePaper) {
  const Body body = StandardBody(AverageMeasures(1.75));
  ASSERT_EQ(body.num_nodes(), 21);
  ASSERT_EQ(body.num_links(), 19);  // the root and 18 joints
  EXPECT_EQ(body.num_coordinates(), 60);
  int segments = 0;
  for (int n = 0; n < 21; ++n) {
    const Node& node = body.nodes[n];
    EXPECT_EQ(node.name, kNodes[n].name);
    EXPECT_EQ(body.FindNode(node.name), n);
    EXPECT_EQ(body.links[node.link].name, kNodes[n].link) << node.name;
    if (n == 0) {
      EXPECT_EQ(node.parent, -1);
      continue;
    }
    ASSERT_GE(node.parent, 0);
    ASSERT_LT(node.parent, n);
    EXPECT_EQ(body.nodes[node.parent].name, kNodes[n].parent) << node.name;
    EXPECT_GT(node.radius, 0) << node.name;
    EXPECT_GT(node.mass, 0) << node.name;
    EXPECT_GT(body.SegmentLength(n), 0) << node.name;
    ++segments;
  }
  EXPECT_EQ(segments, 20);
  EXPECT_EQ(body.nodes[0].radius, 0);
  for (int l = 1; l < body.num_links(); ++l) {
    EXPECT_GE(body.links[l].parent, 0);
    EXPECT_LT(body.links[l].parent, l);
    EXPECT_FALSE(body.links[l].locked);
  }
  EXPECT_EQ(body.FindNode("tail"), -1);
  EXPECT_EQ(body.FindLink("tail"), -1);
}

TEST(Body, EveryJointDrivesOneSegmentAndTheRootTwo) {
  const Body body = StandardBody(AverageMeasures(1.75));
  std::vector<int> carried(body.links.size(), 0);
  for (int n = 1; n < body.num_nodes(); ++n) ++carried[body.nodes[n].link];
  EXPECT_EQ(carried[0], 2);  // both hips
  for (int l = 1; l < body.num_links(); ++l) EXPECT_EQ(carried[l], 1) << body.links[l].name;
}

TEST(Body, RestPoseIsATPoseFacingPlusZWithTheLeftAtPlusX) {
  const BodyMeasures m = Peculiar();
  const Body body = StandardBody(m);
  const PosedBody rest = PoseBody(body, RestPose(body));
  std::vector<Vec3> expected(21);
  const double chest = 0.21, neck = 0.48;
  expected[0] = Vec3(0, 0, 0);
  expected[1] = Vec3(0, chest, 0);
  expected[2] = Vec3(0, neck, 0);
  expected[3] = Vec3(0, 0.57, 0);
  expected[4] = Vec3(0, 0.76, 0);
  expected[5] = Vec3(0.03 + 0.16, chest + 0.24, 0.01);
  expected[6] = Vec3(0.50, 0.45, 0.01);
  expected[7] = Vec3(0.75, 0.45, 0.01);
  expected[8] = Vec3(0.83, 0.45, 0.01);
  expected[9] = Vec3(-0.02 - 0.17, chest + 0.23, 0.02);
  expected[10] = Vec3(-0.51, 0.44, 0.02);
  expected[11] = Vec3(-0.77, 0.44, 0.02);
  expected[12] = Vec3(-0.855, 0.44, 0.02);
  expected[13] = Vec3(0.09, -0.05, 0.01);
  expected[14] = Vec3(0.09, -0.47, 0.01);
  expected[15] = Vec3(0.09, -0.87, 0.01);
  expected[16] = Vec3(0.09, -0.87, 0.15);
  expected[17] = Vec3(-0.10, -0.06, 0);
  expected[18] = Vec3(-0.10, -0.49, 0);
  expected[19] = Vec3(-0.10, -0.90, 0);
  expected[20] = Vec3(-0.10, -0.90, 0.15);
  for (int n = 0; n < 21; ++n) {
    EXPECT_LT((rest.node[n] - expected[n]).norm(), 1e-14) << body.nodes[n].name;
    if (n == 0) continue;
    const Vec3& parent = expected[body.nodes[n].parent];
    EXPECT_NEAR(body.SegmentLength(n), (expected[n] - parent).norm(), 1e-14) << body.nodes[n].name;
  }
}

TEST(Body, StatureIsFromTheGroundToTheVertex) {
  for (const double stature : {1.2, 1.756, 2.05}) {
    EXPECT_NEAR(StatureOf(AverageMeasures(stature)), stature, 1e-12);
    const Body body = StandardBody(AverageMeasures(stature));
    EXPECT_NEAR(body.stature, stature, 1e-12);
    const PosedBody rest = PoseBody(body, RestPose(body));
    const double ankle = rest.node[body.FindNode("left_ankle")].y();
    EXPECT_NEAR(rest.node[body.FindNode("head_top")].y() - ankle + kAnkleHeight * stature, stature,
                1e-12);
  }
  // Legs 0.82 and 0.84 with hips 0.05 and 0.06 below the root, trunk and head 0.76 above it.
  EXPECT_NEAR(StatureOf(Peculiar()), (0.83 + 0.055 + 0.76) / (1 - kAnkleHeight), 1e-12);
}

TEST(Body, MassesSumToTheWholeAndGrowWithTheCubeOfTheStature) {
  const auto mass = [](const Body& body) {
    double sum = 0;
    for (const Node& node : body.nodes) sum += node.mass;
    return sum;
  };
  // A body mass index of 23 at 1.756 m.
  EXPECT_NEAR(mass(StandardBody(AverageMeasures(1.756))), 23 * 1.756 * 1.756, 1e-9);
  EXPECT_NEAR(mass(StandardBody(AverageMeasures(0.878))), 23 * 1.756 * 1.756 / 8, 1e-9);
}

TEST(Body, LeftAndRightAreMirrorImages) {
  const Body body = StandardBody(AverageMeasures(1.8));
  const PosedBody rest = PoseBody(body, RestPose(body));
  int pairs = 0;
  for (int n = 0; n < body.num_nodes(); ++n) {
    const std::string& name = body.nodes[n].name;
    if (!name.starts_with("left_")) continue;
    const int other = body.FindNode("right_" + name.substr(5));
    ASSERT_GE(other, 0);
    const Vec3 mirrored(-rest.node[n].x(), rest.node[n].y(), rest.node[n].z());
    EXPECT_LT((mirrored - rest.node[other]).norm(), 1e-15);
    EXPECT_EQ(body.nodes[n].radius, body.nodes[other].radius);
    EXPECT_EQ(body.nodes[n].mass, body.nodes[other].mass);
    ++pairs;
  }
  EXPECT_EQ(pairs, 8);
}

TEST(Body, ScaledToScalesLengthsRadiiAndMasses) {
  const Body body = StandardBody(Peculiar());
  const double k = 0.75;
  const Body small = ScaledTo(body, k * body.stature);
  EXPECT_NEAR(small.stature, k * body.stature, 1e-15);
  ASSERT_EQ(small.num_nodes(), 21);
  // In any posture: every point of the small body is the large body's, nearer by the ratio.
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Pose pose = RestPose(body);
  for (Quat& q : pose.rotation) q = ExpSo3(Vec3(normal(random), normal(random), normal(random)));
  const PosedBody one = PoseBody(body, pose), other = PoseBody(small, pose);
  for (int n = 0; n < 21; ++n) {
    EXPECT_LT((k * one.node[n] - other.node[n]).norm(), 1e-14);
    EXPECT_NEAR(small.nodes[n].radius, k * body.nodes[n].radius, 1e-15);
    EXPECT_NEAR(small.nodes[n].mass, k * k * k * body.nodes[n].mass, 1e-13);
  }
  const Body same = ScaledTo(small, body.stature);
  for (int n = 1; n < 21; ++n) {
    EXPECT_NEAR(same.SegmentLength(n), body.SegmentLength(n), 1e-14);
  }
}

// Forward kinematics by 4x4 matrices, the textbook way.
TEST(Body, ForwardKinematicsIsTheProductOfTheTransforms) {
  const Body body = StandardBody(Peculiar());
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 10; ++trial) {
    Pose pose = RestPose(body);
    pose.root_position = Vec3(normal(random), normal(random), normal(random));
    for (Quat& q : pose.rotation) q = ExpSo3(Vec3(normal(random), normal(random), normal(random)));
    const PosedBody posed = PoseBody(body, pose);
    std::vector<Eigen::Matrix4d> world;
    for (int l = 0; l < body.num_links(); ++l) {
      Eigen::Matrix4d local = Eigen::Matrix4d::Identity();
      local.topLeftCorner<3, 3>() = pose.rotation[l].toRotationMatrix();
      local.topRightCorner<3, 1>() = l == 0 ? pose.root_position : body.links[l].centre;
      world.push_back(l == 0 ? local : Eigen::Matrix4d(world[body.links[l].parent] * local));
    }
    for (const Node& node : body.nodes) {
      const Eigen::Vector4d p = world[node.link] * node.offset.homogeneous();
      const int n = body.FindNode(node.name);
      EXPECT_LT((p.head<3>() - posed.node[n]).norm(), 1e-13) << node.name;
    }
    // All segments but neck-shoulder are rigid.
    for (int n = 1; n < body.num_nodes(); ++n) {
      if (body.nodes[n].name.ends_with("_shoulder")) continue;
      EXPECT_NEAR((posed.node[n] - posed.node[body.nodes[n].parent]).norm(), body.SegmentLength(n),
                  1e-13);
    }
  }
}

}  // namespace
}  // namespace retarget
