// Rigs that lack bones: accepted, bound, and written back as they were.
#include <gtest/gtest.h>

#include <set>

#include "io/recognition/recognise.h"
#include "model/rig/binding.h"
#include "model/rig/write_back.h"
#include "tests/rig_figure.h"

namespace retarget::cli {
namespace {

struct Case {
  const char* what;
  int spines;
  std::vector<std::string> without;  // bones that the rig lacks
  std::set<std::string> locked;      // the body's joints that must be locked
};

const std::vector<Case>& Cases() {
  static const std::vector<Case> cases = {
      {"complete", 3, {}, {}},
      {"five spine bones", 5, {}, {}},
      {"one spine bone", 1, {}, {"waist"}},
      {"no spine", 0, {}, {"waist", "chest"}},
      {"no neck", 2, {"neck"}, {"neck"}},
      {"no neck, no spine", 0, {"neck"}, {"waist", "chest", "neck"}},
      {"no clavicles", 2, {"left_clavicle", "right_clavicle"}, {"left_clavicle", "right_clavicle"}},
      {"no head", 2, {"head"}, {"head"}},
      {"no neck, no head", 2, {"neck", "head"}, {"neck", "head"}},
      {"no hands", 2, {"left_wrist", "right_wrist"}, {"left_wrist", "right_wrist"}},
      {"no feet",
       2,
       {"left_ankle", "right_ankle", "left_toe", "right_toe"},
       {"left_ankle", "right_ankle"}},
      {"no toes", 2, {"left_toe", "right_toe"}, {}},
      {"stick figure",
       0,
       {"neck", "head", "left_clavicle", "right_clavicle", "left_wrist", "right_wrist",
        "left_ankle", "right_ankle", "left_toe", "right_toe"},
       {"waist", "chest", "neck", "head", "left_clavicle", "right_clavicle", "left_wrist",
        "right_wrist", "left_ankle", "right_ankle"}}};
  return cases;
}

JointNames NamesOf(const Case& c) {
  JointNames names = MixamoNames(c.spines);
  for (const std::string& joint : c.without) names.erase(joint);
  return names;
}

struct Bound {
  RigFacts facts;
  std::unique_ptr<RigBinding> binding;
};

Bound Bind(const RigMotion& motion) {
  Bound bound;
  bound.facts = io::Recognise(motion, {}, "f.bvh");
  bound.binding =
      std::make_unique<RigBinding>(motion, bound.facts, io::ChestBone(motion, bound.facts.map), 0);
  return bound;
}

void ExpectSamePlay(const RigMotion& before, const RigMotion& after, double metres_per_unit) {
  ASSERT_EQ(after.num_frames(), before.num_frames());
  for (int k = 0; k < before.num_frames(); ++k) {
    const PosedRig p = PoseRig(before.rig, before.frames[static_cast<size_t>(k)]);
    const PosedRig q = PoseRig(after.rig, after.frames[static_cast<size_t>(k)]);
    for (size_t j = 0; j < p.position.size(); ++j) {
      ASSERT_LT(metres_per_unit * (p.position[j] - q.position[j]).norm(), 1e-6)
          << "frame " << k << " " << before.rig.joints[j].name;
      ASSERT_LT(p.rotation[j].angularDistance(q.rotation[j]), 1e-6)
          << "frame " << k << " " << before.rig.joints[j].name;
    }
  }
}

TEST(IncompleteRig, IsBoundWithVirtualLockedJoints) {
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.what);
    RigFigure figure(NamesOf(c));
    figure.Move(12, 0.5, 7);
    for (const bool turned : {false, true}) {
      if (turned) figure.TurnAxes(3);
      const Bound bound = Bind(figure.motion);
      const Body& body = bound.binding->body();
      std::set<std::string> locked;
      for (const Link& link : body.links) {
        if (link.locked) locked.insert(link.name);
      }
      EXPECT_EQ(locked, c.locked);
      const auto& names = bound.facts.virtual_joints;
      EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), c.locked);
      // The tables put what is missing near where the tables had it: the body stays that tall.
      EXPECT_NEAR(body.stature, 1.75, turned ? 0.10 : 0.08);
      for (int n = 1; n < body.num_nodes(); ++n) {
        EXPECT_GT(body.SegmentLength(n), 0.01) << body.nodes[static_cast<size_t>(n)].name;
      }
    }
  }
}

// Where the rig has a joint, the body has its node there, whatever is virtual besides.
TEST(IncompleteRig, NodesStandAtTheJoints) {
  int checked = 0;
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.what);
    RigFigure figure(NamesOf(c));
    figure.Move(12, 0.4, 11);
    figure.TurnAxes(5);
    const Bound bound = Bind(figure.motion);
    const Body& body = bound.binding->body();
    for (const RigFrame& frame : figure.motion.frames) {
      const PosedBody posed = PoseBody(body, bound.binding->PoseOf(frame));
      const std::vector<Vec3> joints = bound.binding->JointPositions(frame);
      for (int n = 0; n < body.num_nodes(); ++n) {
        const int joint = bound.binding->JointAtNode(n);
        if (joint < 0) continue;
        // A spine of many bones bends between root and chest, which the body's straight one
        // cannot.
        const double most = c.spines > 1 ? 0.02 : 1e-6;
        EXPECT_LT((joints[static_cast<size_t>(joint)] - posed.node[static_cast<size_t>(n)]).norm(),
                  most)
            << body.nodes[static_cast<size_t>(n)].name;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 1500);
}

TEST(IncompleteRig, IdentityComesBack) {
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.what);
    RigFigure figure(NamesOf(c));
    figure.Move(12, 0.8, 13);
    figure.TurnAxes(17);
    const Bound bound = Bind(figure.motion);
    Clip clip;
    clip.fps = 30;
    for (const RigFrame& frame : figure.motion.frames) {
      clip.frames.push_back(bound.binding->PoseOf(frame));
    }
    const RigMotion back = WriteBack(
        figure.motion, *bound.binding, 0, [](const Pose& p) { return p; }, clip, clip);
    ExpectSamePlay(figure.motion, back, bound.facts.metres_per_unit);
  }
}

// An edit of the joints that are there is found on the rig again, to what the report demands of a
// written file (5 mm).
TEST(IncompleteRig, EditsReachTheRig) {
  int checked = 0;
  for (const Case& c : Cases()) {
    SCOPED_TRACE(c.what);
    RigFigure figure(NamesOf(c));
    figure.Move(6, 0.3, 19);
    figure.TurnAxes(23);
    const Bound bound = Bind(figure.motion);
    const Body& body = bound.binding->body();
    const RigFrame& frame = figure.motion.frames[4];
    Pose pose = bound.binding->PoseOf(frame);
    pose.root_position += Vec3(0.2, 0.05, -0.1);
    pose.rotation[0] = YawRotation(0.7) * pose.rotation[0];
    for (int l = 1; l < body.num_links(); ++l) {
      const Link& link = body.links[static_cast<size_t>(l)];
      if (link.locked || link.name == "waist") continue;
      Quat& turn = pose.rotation[static_cast<size_t>(l)];
      turn = turn * ExpSo3(Vec3(0.2, -0.15, 0.1 * (l % 3)));
    }
    const std::vector<Vec3> joints =
        bound.binding->JointPositions(bound.binding->Apply(frame, pose));
    const PosedBody posed = PoseBody(body, pose);
    for (int n = 0; n < body.num_nodes(); ++n) {
      const int joint = bound.binding->JointAtNode(n);
      if (joint < 0) continue;
      EXPECT_LT((joints[static_cast<size_t>(joint)] - posed.node[static_cast<size_t>(n)]).norm(),
                0.005)
          << body.nodes[static_cast<size_t>(n)].name;
      ++checked;
    }
  }
  EXPECT_GT(checked, 150);
}

// Bones of no length: hips at the root, a hand at the wrist, a neck at the head.
TEST(IncompleteRig, BonesOfNoLengthAreFolded) {
  for (const std::string joint : {"LeftUpLeg", "Neck", "Spine", "LeftShoulder"}) {
    SCOPED_TRACE(joint);
    RigFigure figure(MixamoNames(1));
    RigJoint& folded = figure.motion.rig.joints[static_cast<size_t>(figure.motion.rig.Find(joint))];
    const Vec3 offset = folded.offset;
    folded.offset.setZero();
    if (joint == "LeftUpLeg") {
      const int other = figure.motion.rig.Find("RightUpLeg");
      figure.motion.rig.joints[static_cast<size_t>(other)].offset.setZero();
    }
    if (joint == "Neck") {  // all of it below the neck
      folded.offset = offset;
      const int head = figure.motion.rig.Find("Head");
      figure.motion.rig.joints[static_cast<size_t>(head)].offset.setZero();
    }
    figure.Move(8, 0.4, 29);
    const Bound bound = Bind(figure.motion);
    EXPECT_TRUE(std::isfinite(bound.binding->body().stature));
    for (const RigFrame& frame : figure.motion.frames) {
      const Pose pose = bound.binding->PoseOf(frame);
      for (const Quat& turn : pose.rotation) ASSERT_NEAR(turn.norm(), 1, 1e-9);
      const PosedRig p = PoseRig(figure.motion.rig, frame);
      const PosedRig q = PoseRig(figure.motion.rig, bound.binding->Apply(frame, pose));
      for (size_t j = 0; j < p.position.size(); ++j) {
        ASSERT_LT((p.position[j] - q.position[j]).norm(), 1e-4);
      }
    }
  }
}

// Unreal's lowerarm_twist stands half way and takes half of the hand's turn, Reallusion's second
// one hangs from the first; a watch that does not lie on the axis keeps still.
TEST(TwistHelpers, TakeTheirShareOfTheEdit) {
  RigFigure figure(MixamoNames(2));
  const int elbow = figure.motion.rig.Find("LeftForeArm"),
            wrist = figure.motion.rig.Find("LeftHand");
  const Vec3 from = figure.Place(elbow), to = figure.Place(wrist);
  const int half = figure.Add("lowerarm_twist_01_l", elbow, 0.5 * (from + to));
  const int first = figure.Add("ForearmTwist01", elbow, from + 0.25 * (to - from));
  const int second = figure.Add("ForearmTwist02", first, from + 0.75 * (to - from));
  const int watch = figure.Add("watch", elbow, from + 0.8 * (to - from) + Vec3(0, 4, 0));
  figure.Move(4, 0.3, 31);
  for (RigFrame& frame : figure.motion.frames) {
    for (const int joint : {half, first, second}) {  // helpers turn about their axis
      frame.rotation[static_cast<size_t>(joint)] = ExpSo3(Vec3(0.2, 0, 0));
    }
  }
  figure.TurnAxes(37);
  const Bound bound = Bind(figure.motion);
  const Body& body = bound.binding->body();
  const RigFrame& frame = figure.motion.frames[2];
  Pose pose = bound.binding->PoseOf(frame);
  const auto hand = static_cast<size_t>(body.FindLink("left_wrist"));
  constexpr double kTurn = 0.8;  // about the forearm, which lies along x
  pose.rotation[hand] = ExpSo3(Vec3(kTurn, 0, 0)) * pose.rotation[hand];
  const PosedRig before = PoseRig(figure.motion.rig, frame);
  const PosedRig after = PoseRig(figure.motion.rig, bound.binding->Apply(frame, pose));
  const auto turned = [&](int joint) {
    return before.rotation[static_cast<size_t>(joint)].angularDistance(
        after.rotation[static_cast<size_t>(joint)]);
  };
  EXPECT_NEAR(turned(elbow), 0, 1e-6);
  EXPECT_NEAR(turned(wrist), kTurn, 1e-6);
  EXPECT_NEAR(turned(half), 0.5 * kTurn, 1e-6);
  EXPECT_NEAR(turned(first), 0.25 * kTurn, 1e-6);
  EXPECT_NEAR(turned(second), 0.75 * kTurn, 1e-6);
  EXPECT_NEAR(turned(watch), 0, 1e-6);
  for (const int joint : {elbow, wrist, half, first, second, watch}) {
    const auto j = static_cast<size_t>(joint);
    EXPECT_LT((before.position[j] - after.position[j]).norm(), 1e-6);
  }
}

// A root-motion bone above the hips keeps its own motion; the hips are written relative to it.
TEST(RootMotion, KeepsItsOwnMotion) {
  RigFigure figure(MixamoNames(2));
  Rig& rig = figure.motion.rig;
  for (RigJoint& joint : rig.joints) ++joint.parent;
  rig.joints.insert(rig.joints.begin(), RigJoint{});
  rig.joints[0].name = "root";
  rig.joints[0].translates = rig.joints[1].translates = true;
  figure.Move(6, 0.3, 41);
  for (RigFrame& frame : figure.motion.frames) frame.rotation[0] = YawRotation(0.3);
  const Bound bound = Bind(figure.motion);
  EXPECT_EQ(rig.joints[static_cast<size_t>(bound.facts.map.root)].name, "Hips");
  const RigFrame& frame = figure.motion.frames[3];
  Pose pose = bound.binding->PoseOf(frame);
  pose.root_position += Vec3(0.3, 0.1, -0.2);
  const RigFrame out = bound.binding->Apply(frame, pose);
  EXPECT_LT((out.translation[0] - frame.translation[0]).norm(), 1e-9);
  EXPECT_LT(out.rotation[0].angularDistance(frame.rotation[0]), 1e-7);
  EXPECT_LT((bound.binding->JointPositions(out)[1] - pose.root_position).norm(), 1e-6);
}

}  // namespace
}  // namespace retarget::cli
