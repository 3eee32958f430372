#include "io/template_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "model/geometry/so3.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

// One of everything. The tests of errors count its lines.
const char kExample[] = R"(format: 1
name: bear hug
description: "from behind: held"
tags: [hold, standing]
a:
  stature: 1.75
  radii: {chest: 0.13, left_toe: 0.05}
  root: {position: [0.1, 0.95, -0.3], rotation: [10, 0, 0]}
  joints:
    left_shoulder: [0, -75, -30]
    right_elbow: [0, 80, 0]
b:
  stature: 1.6
  root:
    position: [0, 0.87, 0]
  joints: {left_knee: [20, 0, 0], left_hip: [-90, 0, 0]}
holds:
  - from: {figure: a, node: left_hand, offset: [0, 0.01, 0]}
    to: {figure: b, node: right_wrist}
    rotation: true
  - from: {figure: a, node: left_toe}
    to: {figure: world}
  - from: {figure: b, node: head}
    to: {figure: b, node: left_hand, offset: [0.01, 0.02, 0.03]}
  - from: {figure: b, node: right_toe}
    to: {figure: world, position: [1, 2, 3]}
    rotation: true
supports: {b: [right_toe, right_ankle]}
root: {a: own, b: partner}
tangles:
  - {a: [right_hand, left_hand], b: [right_wrist, right_knee]}
  - {a: [root, head_top], b: [left_toe, neck]}
photo: {file: p.jpg, opacity: 0.25, scale: 2, offset: [3, -4]}
camera: {eye: [1, 2, 3], target: [0, 1.5, 0], fov_deg: 35}
contacts:
  - from: {figure: b, node: right_hand}
    to: {figure: a, node: chest, along: 0.25}
)";

TemplatePosture Example() { return ParseTemplate(kExample, "t.yaml"); }

// The example with the first `from` replaced by `to`.
std::string Edited(const std::string& from, const std::string& to) {
  std::string text = kExample;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string ParseError(const std::string& text) {
  try {
    ParseTemplate(text, "t.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::array<PosedBody, 2> PosedFigures(const TemplatePosture& posture) {
  return {PoseBody(posture.body[0], posture.pose[0]), PoseBody(posture.body[1], posture.pose[1])};
}

double Angle(const Quat& x, const Quat& y) { return LogSo3(x.conjugate() * y).norm(); }

void ExpectSameFigure(const TemplatePosture& x, const TemplatePosture& y, int f) {
  const Body &bx = x.body[f], &by = y.body[f];
  ASSERT_EQ(bx.num_links(), by.num_links());
  ASSERT_EQ(bx.num_nodes(), by.num_nodes());
  EXPECT_LT((x.pose[f].root_position - y.pose[f].root_position).norm(), 1e-6);
  for (int l = 0; l < bx.num_links(); ++l) {
    EXPECT_LT((bx.links[l].centre - by.links[l].centre).norm(), 1e-8);
    EXPECT_LT(Angle(x.pose[f].rotation[l], y.pose[f].rotation[l]), 1e-6);
  }
  for (int n = 0; n < bx.num_nodes(); ++n) {
    EXPECT_LT((bx.nodes[n].offset - by.nodes[n].offset).norm(), 1e-8);
    EXPECT_NEAR(bx.nodes[n].radius, by.nodes[n].radius, 1e-8) << bx.nodes[n].name;
  }
}

void ExpectSamePoint(const HoldPoint& x, const HoldPoint& y) {
  EXPECT_EQ(x.figure, y.figure);
  EXPECT_EQ(x.node, y.node);
  EXPECT_LT((x.offset - y.offset).norm(), 1e-6);
}

void ExpectSameView(const TemplatePosture& x, const TemplatePosture& y) {
  ASSERT_EQ(x.photo.has_value(), y.photo.has_value());
  if (x.photo) {
    EXPECT_EQ(x.photo->file, y.photo->file);
    EXPECT_EQ(x.photo->opacity, y.photo->opacity);
    EXPECT_EQ(x.photo->scale, y.photo->scale);
    EXPECT_EQ(x.photo->offset, y.photo->offset);
  }
  ASSERT_EQ(x.camera.has_value(), y.camera.has_value());
  if (x.camera) {
    EXPECT_LT((x.camera->eye - y.camera->eye).norm(), 1e-6);
    EXPECT_LT((x.camera->target - y.camera->target).norm(), 1e-6);
    EXPECT_EQ(x.camera->fov_deg, y.camera->fov_deg);
  }
}

void ExpectSamePosture(const TemplatePosture& x, const TemplatePosture& y) {
  EXPECT_EQ(x.name, y.name);
  EXPECT_EQ(x.description, y.description);
  EXPECT_EQ(x.keywords, y.keywords);
  EXPECT_EQ(x.supports, y.supports);
  EXPECT_EQ(x.root, y.root);
  for (int f = 0; f < 2; ++f) ExpectSameFigure(x, y, f);
  ASSERT_EQ(x.holds.size(), y.holds.size());
  for (size_t h = 0; h < x.holds.size(); ++h) {
    ExpectSamePoint(x.holds[h].from, y.holds[h].from);
    ExpectSamePoint(x.holds[h].to, y.holds[h].to);
    EXPECT_EQ(x.holds[h].rotation, y.holds[h].rotation);
    EXPECT_LT(Angle(x.holds[h].relative_rotation, y.holds[h].relative_rotation), 1e-6);
  }
  ASSERT_EQ(x.tangles.size(), y.tangles.size());
  for (size_t t = 0; t < x.tangles.size(); ++t) {
    EXPECT_EQ(x.tangles[t].a, y.tangles[t].a);
    EXPECT_EQ(x.tangles[t].b, y.tangles[t].b);
  }
  ExpectSameView(x, y);
}

TEST(TemplateFileTest, ReadsTheExample) {
  const TemplatePosture p = Example();
  EXPECT_EQ(p.name, "bear hug");
  EXPECT_EQ(p.description, "from behind: held");
  EXPECT_EQ(p.keywords, (std::vector<std::string>{"hold", "standing"}));
  EXPECT_NEAR(p.body[0].stature, 1.75, 1e-12);
  EXPECT_NEAR(p.body[1].stature, 1.6, 1e-12);
  EXPECT_EQ(p.body[0].nodes[p.body[0].FindNode("chest")].radius, 0.13);
  EXPECT_EQ(p.body[0].nodes[p.body[0].FindNode("left_toe")].radius, 0.05);
  EXPECT_EQ(p.pose[0].root_position, Vec3(0.1, 0.95, -0.3));
  EXPECT_LT(Angle(p.pose[0].rotation[0], ExpSo3(Vec3(10 * kDegree, 0, 0))), 1e-12);
  EXPECT_LT(Angle(p.pose[0].rotation[p.body[0].FindLink("left_shoulder")],
                  ExpSo3(Vec3(0, -75, -30) * kDegree)),
            1e-12);
  EXPECT_LT(Angle(p.pose[0].rotation[p.body[0].FindLink("waist")], Quat::Identity()), 1e-12);
  EXPECT_EQ(p.root, (std::array{RootReference::kOwnClip, RootReference::kPartner}));
  ASSERT_EQ(p.tangles.size(), 2u);
  EXPECT_EQ(p.tangles[0].a, (Path{8, 12}));  // written the other way round
  EXPECT_EQ(p.tangles[0].b, (Path{11, 18}));
  EXPECT_EQ(p.tangles[1].b, (Path{2, 16}));
  EXPECT_EQ(p.photo->file, "p.jpg");
  EXPECT_EQ(p.photo->opacity, 0.25);
  EXPECT_EQ(p.photo->offset, Eigen::Vector2d(3, -4));
  EXPECT_EQ(p.camera->eye, Vec3(1, 2, 3));
  EXPECT_EQ(p.camera->fov_deg, 35);
}

TEST(TemplateFileTest, HoldsDefaultToThePosture) {
  const TemplatePosture p = Example();
  const auto posed = PosedFigures(p);
  ASSERT_EQ(p.holds.size(), 4u);
  for (int h : {0, 1}) {
    EXPECT_LT(
        (HoldPosition(p.holds[h].from, p.body, posed) - HoldPosition(p.holds[h].to, p.body, posed))
            .norm(),
        1e-12);
  }
  EXPECT_EQ(p.holds[0].from.offset, Vec3(0, 0.01, 0));
  EXPECT_EQ(p.holds[1].to.figure, kWorld);
  EXPECT_LT((p.holds[1].to.offset - posed[0].node[p.holds[1].from.node]).norm(), 1e-12);
  EXPECT_EQ(p.holds[2].from.offset, Vec3::Zero());
  EXPECT_EQ(p.holds[2].to.offset, Vec3(0.01, 0.02, 0.03));
  EXPECT_EQ(p.holds[3].to.offset, Vec3(1, 2, 3));
}

TEST(TemplateFileTest, HoldsKeepTheRelativeRotation) {
  const TemplatePosture p = Example();
  const auto posed = PosedFigures(p);
  const int wrist_a = p.body[0].FindLink("left_wrist"), elbow_b = p.body[1].FindLink("right_elbow");
  EXPECT_TRUE(p.holds[0].rotation);
  EXPECT_LT((posed[1].rotation[elbow_b] * p.holds[0].relative_rotation.toRotationMatrix() -
             posed[0].rotation[wrist_a])
                .norm(),
            1e-12);
  EXPECT_FALSE(p.holds[1].rotation);
  EXPECT_LT(Angle(p.holds[1].relative_rotation, Quat::Identity()), 1e-12);
  EXPECT_LT((p.holds[3].relative_rotation.toRotationMatrix() -
             posed[1].rotation[p.body[1].FindLink("right_ankle")])
                .norm(),
            1e-12);
}

TEST(TemplateFileTest, SupportsDefaultToTheStandingFeet) {
  const TemplatePosture p = Example();
  EXPECT_EQ(p.supports[0], StandingNodes(p.body[0], PosedFigures(p)[0]));
  EXPECT_EQ(p.supports[0].size(), 4u);
  EXPECT_EQ(p.supports[1], (std::vector<int>{20, 19}));
  // The raised left leg of b does not stand.
  const TemplatePosture q =
      ParseTemplate(Edited("supports: {b: [right_toe, right_ankle]}\n", ""), "t.yaml");
  EXPECT_EQ(q.supports[1], (std::vector<int>{19, 20}));
  EXPECT_TRUE(ParseTemplate(Edited("{b: [right_toe, right_ankle]}", "{a: []}"), "t.yaml")
                  .supports[0]
                  .empty());
}

TEST(TemplateFileTest, OptionalKeysMayBeLeftOut) {
  const TemplatePosture p = ParseTemplate(
      "format: 1\nname: n\na: {stature: 1.8, root: {position: [0, 1, 0]}}\n"
      "b: {stature: 1.8, root: {position: [0, 1, 1]}}\n",
      "t.yaml");
  EXPECT_TRUE(p.holds.empty() && p.tangles.empty() && p.keywords.empty() && !p.photo && !p.camera);
  EXPECT_EQ(p.root, (std::array{RootReference::kOwnClip, RootReference::kOwnClip}));
  ExpectSamePosture(ParseTemplate(FormatTemplate(p), "again.yaml"), p);
}

TEST(TemplateFileTest, ExampleSurvivesTheRoundTrip) {
  const TemplatePosture p = Example();
  const std::string text = FormatTemplate(p);
  const TemplatePosture again = ParseTemplate(text, "again.yaml");
  ExpectSamePosture(again, p);
  EXPECT_EQ(FormatTemplate(again), text);
  EXPECT_NE(text.find("  stature: 1.75\n  radii: {chest: 0.13, left_toe: 0.05}\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("    left_shoulder: [0, -75, -30]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("root: {a: world, b: partner}\n"), std::string::npos) << text;
}

// Unequal sides, odd radii, rotations of up to half a turn, awkward names.
TemplatePosture RandomPosture(std::mt19937* random) {
  const auto draw = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(*random);
  };
  const auto vector = [&](double most) {
    return Vec3(draw(-most, most), draw(-most, most), draw(-most, most));
  };
  TemplatePosture p;
  p.name = "0x10: [odd] # \"name\" \\ \n \t\xC3\xA9 ";
  p.description = "null";
  p.keywords = {"true", "- a", "~", "", " lead", "plain tag", "1.5", "a\x7F\x01"};
  for (int f = 0; f < 2; ++f) {
    BodyMeasures m = AverageMeasures(draw(1.4, 2));
    for (double* x : {&m.root_chest, &m.head_top, &m.left.elbow_wrist, &m.right.ankle_toe,
                      &m.left.hip_knee, &m.right.clavicle_shoulder}) {
      *x *= draw(0.8, 1.2);
    }
    m.left.clavicle += vector(0.02);
    m.right.hip += vector(0.02);
    p.body[f] = StandardBody(m);
    p.body[f].nodes[7].radius *= 1.1;
    p.pose[f] = RestPose(p.body[f]);
    p.pose[f].root_position = vector(2);
    for (Quat& q : p.pose[f].rotation) q = ExpSo3(draw(0, kPi) * vector(1).normalized());
    for (int n = 13; n < 21; n += 1 + static_cast<int>(draw(0, 4))) p.supports[f].push_back(n);
  }
  const auto posed = PosedFigures(p);
  Hold hold;
  hold.from = {0, 8, vector(0.1)};
  hold.to = {1, 12, vector(0.1)};
  hold.rotation = true;
  hold.relative_rotation = Quat(Mat3(posed[1].rotation[p.body[1].nodes[12].link].transpose() *
                                     posed[0].rotation[p.body[0].nodes[8].link]));
  p.holds = {hold, {{1, 3, vector(1e-4)}, {kWorld, 0, vector(2)}, false, Quat::Identity()}};
  p.tangles = {{{3, 8}, {0, 12}}};
  return p;
}

TEST(TemplateFileTest, AnyBodyAndPoseSurviveTheRoundTrip) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const TemplatePosture p = RandomPosture(&random);
    const std::string text = FormatTemplate(p);
    EXPECT_NE(text.find("  lengths:\n"), std::string::npos);
    EXPECT_NE(text.find("  radii: {left_wrist: "), std::string::npos);
    ExpectSamePosture(ParseTemplate(text, "again.yaml"), p);
  }
}

TEST(TemplateFileTest, ScaledAverageBodiesAreWrittenByStature) {
  TemplatePosture p = Example();
  for (Body& body : p.body) body = ScaledTo(StandardBody(AverageMeasures(1.6)), 1.9);
  const std::string text = FormatTemplate(p);
  EXPECT_NE(text.find("a:\n  stature: 1.9\n  root"), std::string::npos) << text;
  EXPECT_EQ(text.find("lengths"), std::string::npos);
}

// The YAML blocks of the description of the format.
std::vector<std::string> DocumentedBlocks() {
  const std::string page = ReadWholeFile(ProjectPath("docs/template_format.md"));
  std::vector<std::string> blocks;
  const std::string open = "```yaml\n", close = "```";
  for (size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const size_t end = page.find(close, at);
    blocks.push_back(page.substr(at, end - at));
    at = end + close.size();
  }
  return blocks;
}

TEST(TemplateFileTest, DocumentedExamplesAreRead) {
  const std::vector<std::string> blocks = DocumentedBlocks();
  ASSERT_EQ(blocks.size(), 2u);
  const TemplatePosture p = ParseTemplate(blocks[0], "docs/template_format.md");
  EXPECT_EQ(p.holds.size(), 3u);
  EXPECT_EQ(p.tangles.size(), 1u);
  EXPECT_EQ(p.supports[0].size(), 4u);
  EXPECT_EQ(p.supports[1].size(), 4u);
  EXPECT_TRUE(p.photo && p.camera);
  const TemplatePosture q = ParseTemplate(Edited("  stature: 1.75\n", blocks[1]), "t.yaml");
  EXPECT_NEAR(q.body[0].stature, 1.75, 0.1);
}

struct BadEdit {
  const char* from;
  const char* to;
  const char* message;
};

void ExpectRefused(const BadEdit& edit) {
  const std::string message = ParseError(Edited(edit.from, edit.to));
  EXPECT_NE(message.find(edit.message), std::string::npos)
      << edit.from << " -> " << edit.to << "\ngave: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(TemplateFileTest, RefusesBadHeadsAndFigures) {
  const BadEdit edits[] = {
      {"format: 1\n", "format: 2\nnew: 1\n",
       "t.yaml:1: format: expected version 1, the only one this program reads, found \"2\""},
      {"format: 1\n", "", "t.yaml:1: missing key \"format\""},
      {"name: bear hug\n", "", "t.yaml:1: missing key \"name\""},
      {"name: bear hug", "name:", "t.yaml:2: name: expected text, found nothing"},
      {"name:", "nmae:", "t.yaml:2: unknown key \"nmae\", did you mean \"name\"?"},
      {"tags: [hold, standing]", "tags: hold", "t.yaml:4: tags: expected a list, found \"hold\""},
      {"tags: [hold, standing]", "tags: [[hold]]",
       "t.yaml:4: tags[0]: expected text, found a list of 1"},
      {"tags: [hold", "name: [hold", "t.yaml:4: key \"name\" is given twice, first in line 2"},
      {"  stature: 1.75\n", "", "t.yaml:5: a: expected either stature or lengths, found neither"},
      {"  stature: 1.75\n", "  stature: 1.75\n  lengths: {}\n",
       "t.yaml:5: a: expected either stature or lengths, found both"},
      {"stature: 1.75", "stature: 175",
       "t.yaml:6: a.stature: expected a number from 0.5 to 3 (m), found \"175\""},
      {"stature: 1.75", "stature: tall", "t.yaml:6: a.stature: expected a number"},
      {"stature: 1.75", "height: 1.75", "t.yaml:6: unknown key \"a.height\", expected one of "},
      {"stature: 1.75", "statur: 1.75",
       "t.yaml:6: unknown key \"a.statur\", did you mean \"a.stature\"?"},
      {"{chest: 0.13", "{chest: 0",
       "t.yaml:7: a.radii.chest: expected a number from 0.0001 to 1 (m), found \"0\""},
      {"{chest: 0.13", "{root: 0.13", "t.yaml:7: unknown key \"a.radii.root\""},
      {"position: [0.1, 0.95, -0.3]", "position: [0.1, 0.95]",
       "t.yaml:8: a.root.position: expected a list of 3 numbers (m), found a list of 2"},
      {"position: [0.1, 0.95, -0.3]", "position: [0.1, .inf, 0]",
       "t.yaml:8: a.root.position[1]: expected a number from -1000 to 1000 (m), found \".inf\""},
      {"position: [0.1, 0.95, -0.3], ", "", "t.yaml:8: missing key \"a.root.position\""},
      {"rotation: [10, 0, 0]", "rotation: 10",
       "t.yaml:8: a.root.rotation: expected a list of 3 numbers (deg), found \"10\""},
      {"left_shoulder: [", "left_sholuder: [",
       "t.yaml:10: unknown key \"a.joints.left_sholuder\", did you mean "
       "\"a.joints.left_shoulder\"?"},
      {"left_shoulder: [0, -75, -30]", "left_shoulder: [0, -75, 400]",
       "t.yaml:10: a.joints.left_shoulder[2]: expected a number from -360 to 360 (deg)"},
      {"left_shoulder: [0, -75, -30]", "root: [0, -75, 0]", "t.yaml:10: unknown key"},
      {"b:\n  stature: 1.6\n  root:\n    position: [0, 0.87, 0]\n", "b:\n  stature: 1.6\n",
       "t.yaml:12: missing key \"b.root\""},
      {"  joints:\n    left_shoulder: [0, -75, -30]\n    right_elbow: [0, 80, 0]\n",
       "  joints: [left_shoulder]\n",
       "t.yaml:9: a.joints: expected a map of keys and values, found a list of 1"},
  };
  for (const BadEdit& edit : edits) ExpectRefused(edit);
}

TEST(TemplateFileTest, RefusesBadLengths) {
  const std::string lengths = DocumentedBlocks().at(1);
  const struct {
    const char* from;
    const char* to;
    const char* message;
  } edits[] = {
      {"    neck_head: 0.09\n", "", "t.yaml:6: missing key \"a.lengths.neck_head\""},
      {"neck_head: 0.09", "neck_head: 0", "t.yaml:9: a.lengths.neck_head: expected a number"},
      {"neck_head: 0.09", "neck_head: 2.9",
       "t.yaml:6: a.lengths: expected lengths of a stature from 0.5 to 3 m, found 4.67 m"},
      {"hip: [0.09, -0.05, 0]", "hip: 0.09",
       "a.lengths.left.hip: expected a list of 3 numbers (m), found \"0.09\""},
      {"hip_knee:", "hip_kne:",
       "unknown key \"a.lengths.left.hip_kne\", did you mean \"a.lengths.left.hip_knee\"?"},
  };
  for (const auto& edit : edits) {
    std::string block = lengths;
    block.replace(block.find(edit.from), std::string(edit.from).size(), edit.to);
    const std::string message = ParseError(Edited("  stature: 1.75\n", block));
    EXPECT_NE(message.find(edit.message), std::string::npos) << edit.to << " gave: " << message;
  }
}

TEST(TemplateFileTest, RefusesBadHoldsAndTheRest) {
  const BadEdit edits[] = {
      {"node: left_hand,", "node: left_hnad,",
       "t.yaml:18: holds[0].from.node: unknown node \"left_hnad\", did you mean \"left_hand\"?"},
      {"figure: a, node: left_hand", "figure: c, node: left_hand",
       "t.yaml:18: holds[0].from.figure: unknown figure \"c\", expected one of a, b"},
      {"figure: a, node: left_toe", "figure: world, node: left_toe",
       "t.yaml:21: holds[1].from.figure: unknown figure \"world\""},
      {"offset: [0, 0.01, 0]", "ofset: [0, 0.01, 0]",
       "t.yaml:18: unknown key \"holds[0].from.ofset\", did you mean \"holds[0].from.offset\"?"},
      {"    to: {figure: world}", "    to: {figure: world, node: head}",
       "t.yaml:22: unknown key \"holds[1].to.node\", expected one of figure, position"},
      {"    to: {figure: world}\n", "", "t.yaml:21: missing key \"holds[1].to\""},
      {"rotation: true", "rotation: yes",
       "t.yaml:20: holds[0].rotation: expected true or false, found \"yes\""},
      {"figure: b, node: left_hand, offset", "figure: b, node: head, offset",
       "t.yaml:23: holds[2]: expected two different points, found the same node twice"},
      {"supports: {b: [right_toe,", "supports: {b: [right_ankle,",
       "t.yaml:28: supports.b[1]: expected every node once, found \"right_ankle\" twice"},
      {"supports: {b:", "supports: {c:",
       "t.yaml:28: unknown key \"supports.c\", expected one of a, b"},
      {"{a: own, b: partner}", "{a: partner, b: partner}",
       "t.yaml:29: root: expected one figure that follows its own clip, found partner twice"},
      {"{a: own, b: partner}", "{a: wrld}",
       "t.yaml:29: root.a: unknown leader \"wrld\", did you mean \"world\"?"},
      {"a: [right_hand, left_hand]", "a: [right_hand]",
       "t.yaml:31: tangles[0].a: expected a list of 2 nodes, found a list of 1"},
      {"a: [right_hand, left_hand]", "a: [right_hand, right_hand]",
       "t.yaml:31: tangles[0].a: expected two different nodes"},
      {"b: [right_wrist, right_knee]", "b: [right_wrist, right_knee], to: 2.5",
       "t.yaml:31: tangles[0].to: a tangle holds throughout: windows in time are not supported "
       "yet"},
      {"b: [right_wrist, right_knee]", "from: 0, b: [right_wrist, right_knee]",
       "t.yaml:31: tangles[0].from: a tangle holds throughout"},
      {"b: [right_wrist, right_knee]", "b: [right_wrist, right_knee], form: 0",
       "t.yaml:31: unknown key \"tangles[0].form\", expected one of a, b"},
      {"opacity: 0.25", "opacity: 25",
       "t.yaml:33: photo.opacity: expected a number from 0 to 1, found \"25\""},
      {"file: p.jpg, ", "", "t.yaml:33: missing key \"photo.file\""},
      {"target: [0, 1.5, 0]", "target: [1, 2, 3]", "t.yaml:34: camera: expected an eye away from"},
      {"fov_deg: 35", "fov_deg: 180",
       "t.yaml:34: camera.fov_deg: expected a number from 1 to 179 (deg), found \"180\""},
      {"camera: {", "camera: ", "t.yaml:34: not valid YAML: "},
  };
  for (const BadEdit& edit : edits) ExpectRefused(edit);
}

TEST(TemplateFileTest, ContactsAreReadPlacedAndWritten) {
  const TemplatePosture p = Example();
  ASSERT_TRUE(p.contacts);
  ASSERT_EQ(p.contacts->size(), 1u);
  const HandContact& contact = p.contacts->front();
  EXPECT_EQ(contact.figure, 1);
  EXPECT_EQ(contact.hand, p.body[1].FindNode("right_hand"));
  EXPECT_EQ(contact.to, p.body[0].FindNode("chest"));
  EXPECT_EQ(contact.to_along, 0.25);
  HandContact placed = contact;
  PlaceHandContact(p.body, PosedFigures(p), &placed);
  EXPECT_EQ(contact.along, placed.along) << "where the two are nearest";
  const std::string text = FormatTemplate(p);
  const TemplatePosture again = ParseTemplate(text, "again.yaml");
  ASSERT_TRUE(again.contacts && again.contacts->size() == 1);
  EXPECT_NEAR(again.contacts->front().along, contact.along, 1e-8);
  EXPECT_EQ(again.contacts->front().to_along, 0.25);
  // None at all is not the same as nothing said.
  TemplatePosture none = p;
  none.contacts->clear();
  EXPECT_TRUE(ParseTemplate(FormatTemplate(none), "none.yaml").contacts->empty());
  none.contacts.reset();
  EXPECT_FALSE(ParseTemplate(FormatTemplate(none), "none.yaml").contacts);
}

TEST(TemplateFileTest, RefusesBadContacts) {
  const BadEdit edits[] = {
      {"node: right_hand}", "node: right_wrist}",
       "t.yaml:36: contacts[0].from.node: unknown hand \"right_wrist\""},
      {"to: {figure: a, node: chest, along: 0.25}", "to: {figure: b, node: chest}",
       "t.yaml:37: contacts[0].to: expected a segment of the partner, found one of the hand's own"},
      {"node: chest, along", "node: root, along",
       "t.yaml:37: contacts[0].to: expected a node that ends a segment, found the root"},
      {"along: 0.25", "along: 25",
       "t.yaml:37: contacts[0].to.along: expected a number from 0 to 1, found \"25\""},
      {"along: 0.25", "alng: 0.25",
       "t.yaml:37: unknown key \"contacts[0].to.alng\", did you mean \"contacts[0].to.along\"?"},
      {"    to: {figure: a, node: chest, along: 0.25}\n", "",
       "t.yaml:36: missing key \"contacts[0].to\""},
  };
  for (const BadEdit& edit : edits) ExpectRefused(edit);
}

TEST(TemplateFileTest, RefusesTextsThatAreNoTemplates) {
  EXPECT_EQ(ParseError(""), "t.yaml:1: expected a map of keys and values, found nothing");
  EXPECT_EQ(ParseError("# only this\n"), ParseError(""));
  EXPECT_EQ(ParseError("[]"), "t.yaml:1: expected a map of keys and values, found a list of 0");
  EXPECT_NE(ParseError(std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16)), "");
  EXPECT_NE(ParseError("a: &x [*x]\n"), "");
  EXPECT_NE(ParseError(std::string(50'000, '[')), "");
}

TEST(TemplateFileTest, ReadsFiles) {
  const auto path = std::filesystem::temp_directory_path() / "retarget_template_file_test.yaml";
  std::ofstream(path) << kExample;
  ExpectSamePosture(ReadTemplate(path.string()), Example());
  std::filesystem::remove(path);
  EXPECT_THROW(ReadTemplate(path.string()), InputError);
}

// Seeded injuries to a text: bytes, cuts, lines and odd words.
class Damager {
 public:
  explicit Damager(unsigned seed) : random_(seed) {}

  std::string Damage(std::string text) {
    for (int n = 1 + Below(2); n > 0 && !text.empty(); --n) text = DamageOnce(std::move(text));
    return text;
  }

 private:
  int Below(size_t count) {
    return static_cast<int>(std::uniform_int_distribution<size_t>(0, count - 1)(random_));
  }

  std::string DamageOnce(std::string text) {
    static const std::vector<std::string> kOdd = {"&x",
                                                  "*x",
                                                  "!!map",
                                                  "? ",
                                                  "- ",
                                                  ": ",
                                                  "{",
                                                  "}",
                                                  "[",
                                                  "]",
                                                  "\"",
                                                  "'",
                                                  "|\n",
                                                  ">\n",
                                                  "---\n",
                                                  "...\n",
                                                  "%YAML 1.2\n",
                                                  "\t",
                                                  "nan",
                                                  ".inf",
                                                  "1e999",
                                                  "-1",
                                                  "~",
                                                  "null",
                                                  "yes",
                                                  "true",
                                                  "left_hnd",
                                                  "<<: ",
                                                  "#",
                                                  "0.5",
                                                  "1",
                                                  "left_toe",
                                                  "a",
                                                  "world",
                                                  " ",
                                                  "\n",
                                                  std::string(1, '\0'),
                                                  "\xFF\xFE",
                                                  "\xEF\xBB\xBF",
                                                  "@",
                                                  "`"};
    const size_t at = Below(text.size());
    switch (Below(8)) {
      case 0:
        text[at] = static_cast<char>(Below(256));
        return text;
      case 1:
        return text.substr(0, at);
      case 2:
        return text.erase(at, 1 + Below(40));
      case 3:
        return text.insert(Below(text.size()), text.substr(at, 1 + Below(80)));
      case 4:
        return text.insert(at, kOdd[Below(kOdd.size())]);
      case 5:
        return ReplaceWord(std::move(text), at, kOdd[Below(kOdd.size())]);
      case 6:
        return EraseLine(std::move(text), at);
      default:
        return ChangeDigit(std::move(text), at);
    }
  }

  static std::string ReplaceWord(std::string text, size_t at, const std::string& word) {
    const size_t begin = std::min(text.find_first_of(" [", at), text.size() - 1) + 1;
    const size_t end = std::min(text.find_first_of(" ,]}\n", begin), text.size());
    return text.replace(begin, end - begin, word);
  }

  static std::string EraseLine(std::string text, size_t at) {
    const size_t begin = text.rfind('\n', at) + 1;  // npos + 1 is 0
    return text.erase(begin, std::min(text.find('\n', begin), text.size() - 1) + 1 - begin);
  }

  std::string ChangeDigit(std::string text, size_t at) {
    const size_t digit = text.find_first_of("0123456789", at);
    if (digit != std::string::npos) text[digit] = static_cast<char>('0' + Below(10));
    return text;
  }

  std::mt19937 random_;
};

TEST(TemplateFileTest, DamagedTextsAreReadOrRefused) {
  Damager damager(20240607);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 300; ++i) {
    const std::string text = damager.Damage(kExample);
    TemplatePosture posture;
    try {
      posture = ParseTemplate(text, "t.yaml");
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("t.yaml:"), 0u) << message;
      EXPECT_TRUE(std::none_of(message.begin(), message.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20;
      })) << message;
      EXPECT_LT(message.size(), 500u) << message;
      ++refused;
      continue;
    }
    ExpectSamePosture(ParseTemplate(FormatTemplate(posture), "again.yaml"), posture);
    ++accepted;
  }
  EXPECT_GT(accepted, 10);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace retarget::io
