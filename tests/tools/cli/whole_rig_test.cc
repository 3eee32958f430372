// What is written reaches every bone of a figure, whatever it hangs from, and stands where the
// scene has it when it is played by the rules of its format.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/bvh/bvh.h"
#include "tests/io/gltf/gltf_maker.h"
#include "tests/io/gltf/gltf_oracle.h"
#include "tests/tools/run_program.h"

namespace retarget::cli {
namespace {

using nlohmann::json;

// A run of `clip` with the partner of the bear hug.
Outcome RunClip(const Scratch& scratch, const std::string& clip, const std::string& more = "",
                const std::string& out = "out") {
  return RunProgram(scratch, fmt::format("--clip-a {} --clip-b {}/b.bvh --template "
                                         "{}/template.yaml --frames 0:60 --out {} {}",
                                         clip, kHold, kHold, scratch / out, more));
}

// Largest distance (m) of the joints of out/a.glb to the nodes of out/scene.glb, both by 4x4
// matrices, at the scene's keys and between them.
double GlbToScene(const Scratch& scratch) {
  const io::GltfOracle scene(ReadWholeFile(scratch / "out/scene.glb"));
  const io::GltfOracle written(ReadWholeFile(scratch / "out/a.glb"));
  const json report = json::parse(ReadWholeFile(scratch / "out/report.json"));
  const json& nodes = report["write_back"]["a"]["nodes"];
  const int animation = written.AnimationNamed("retargeted");
  const auto [first, last] = written.Span(animation);
  const double begin = scene.Span(0).first;
  EXPECT_GE(nodes.size(), 15U);
  double worst = 0;
  for (double t = 0; t < std::min(last - first, 1.9); t += 1.0 / 60) {
    const auto globals = written.Globals(animation, first + t);
    const auto expected = scene.Globals(0, begin + t);
    for (size_t n = 0; n < expected.size(); ++n) {
      const std::string name = scene.document["nodes"][n].value("name", "");
      if (!name.starts_with("a/") || !nodes.contains(name.substr(2))) continue;
      const auto& at = globals[nodes[name.substr(2)].get<size_t>()];
      worst = std::max(worst, (at - expected[n]).topRightCorner<3, 1>().norm());
    }
  }
  return worst;
}

enum class Chest { kRigid, kUneven, kChanging };

// The first clip of the bear hug as a GLB below an armature, with a scale of the chest: none,
// uneven, or changing during the clip. Beside the figure stands the target of a hand, which is no
// joint of the skin.
std::string HeroGlb(Chest chest) {
  const bool changing = chest == Chest::kChanging;
  const RigMotion motion = io::ReadBvh(kHold + "/a.bvh").motion;
  io::GltfMaker maker;
  maker.document["scene"] = 0;
  const int a = maker.AddAnimation("hold");
  const int count = 61;
  const int times = maker.AddArray(io::Times(count, 1 / motion.frame_time), "SCALAR");
  json joints = json::array();
  const int armature = maker.AddNode("Armature", -1, Vec3::Zero());
  for (int j = 0; j < motion.rig.num_joints(); ++j) {
    const RigJoint& joint = motion.rig.joints[j];
    const int node = maker.AddNode(joint.name, joint.parent < 0 ? armature : joint.parent + 1,
                                   0.01 * joint.offset);
    joints.push_back(node);
    std::vector<float> rotations, places, scales;
    for (int k = 0; k < count; ++k) {
      const RigFrame& frame = motion.frames[std::min(k, motion.num_frames() - 1)];
      const Quat& q = frame.rotation[j];
      for (const double c : {q.x(), q.y(), q.z(), q.w()}) rotations.push_back(float(c));
      for (const double c : frame.translation[j]) places.push_back(float(0.01 * c));
      const double grown = changing ? 0.1 * std::sin(0.1 * k) : 0.2;
      for (const double c : {1 + grown, 1.0, 1 - grown / 2}) scales.push_back(float(c));
    }
    maker.AddChannel(a, node, "rotation", times, maker.AddArray(rotations, "VEC4"));
    if (joint.parent < 0) {
      maker.AddChannel(a, node, "translation", times, maker.AddArray(places, "VEC3"));
    }
    if (joint.name != "Spine1" || chest == Chest::kRigid) continue;
    if (changing) {
      maker.AddChannel(a, node, "scale", times, maker.AddArray(scales, "VEC3"));
    } else {
      maker.document["nodes"][node]["scale"] = {1.2, 1.0, 0.9};
    }
  }
  maker.AddNode("IK_Hand.L", armature, Vec3(0.6, 1.3, 0.2));
  maker.document["skins"].push_back({{"joints", joints}});
  return maker.Glb();
}

TEST(WholeRig, ScalesOfTheChestAreFollowed) {
  for (const bool changing : {false, true}) {
    const Scratch scratch;
    const std::string clip =
        scratch.Write("hero.glb", HeroGlb(changing ? Chest::kChanging : Chest::kUneven));
    ASSERT_NE(ReadWholeFile(clip).find("Spine1"), std::string::npos);
    const Outcome run = RunClip(scratch, clip);
    EXPECT_TRUE(run.code == 0 || run.code == 3) << run.err;
    EXPECT_NE(run.err.find(changing ? "change their scale" : "scaled unevenly"), std::string::npos)
        << run.err;
    EXPECT_LT(GlbToScene(scratch), 0.002) << (changing ? "changing" : "uneven");
  }
}

TEST(WholeRig, AFileThatIsElsewhereIsFound) {
  const Scratch scratch;
  const std::string clip = scratch.Write("hero.glb", HeroGlb(Chest::kUneven));
  RunClip(scratch, clip);
  const std::string before = RunProgram(scratch, "verify " + scratch / "out").out;
  EXPECT_EQ(before.find("MISSED write-back a"), std::string::npos) << before;
  // The same rotations under another scale of the chest: a reader of rotations sees nothing.
  std::string bytes = ReadWholeFile(scratch / "out/a.glb");
  const std::string scale = "\"scale\":[1.2,1.0,0.9]";
  const size_t at = bytes.find(scale);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, scale.size(), "\"scale\":[1.0,1.0,1.0]");
  scratch.Write("out/a.glb", bytes);
  const Outcome verify = RunProgram(scratch, "verify " + scratch / "out");
  EXPECT_EQ(verify.code, 3);
  EXPECT_NE(verify.out.find("MISSED write-back a"), std::string::npos) << verify.out;
  EXPECT_GT(GlbToScene(scratch), 0.02);
}

// Targets of inverse kinematics beside the figure, as game rigs have them, at the ankles of the
// first frame.
std::string WithTargets() {
  const io::BvhFile file = io::ReadBvh(kHold + "/a.bvh");
  const Rig& rig = file.motion.rig;
  std::string text = ReadWholeFile(kHold + "/a.bvh");
  const std::string channels =
      "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  std::string more = "ROOT ik_root\n{\nOFFSET 0 0 0\n" + channels, row = " 0 0 0 0 0 0";
  for (const auto& [name, joint] :
       {std::pair("ik_foot_l", "LeftFoot"), {"ik_foot_r", "RightFoot"}, {"prop", "LeftUpLeg"}}) {
    const Vec3 at = PoseRig(rig, file.motion.frames[0]).position[rig.Find(joint)] +
                    (name == std::string("prop") ? Vec3(60, 0, 0) : Vec3::Zero());
    more += fmt::format("JOINT {}\n{{\nOFFSET {} {} {}\n{}End Site\n{{\nOFFSET 0 5 0\n}}\n}}\n",
                        name, at.x(), at.y(), at.z(), channels);
    row += fmt::format(" {} {} {} 0 0 0", at.x(), at.y(), at.z());
  }
  text.insert(text.find("MOTION"), more + "}\n");
  size_t line = text.find('\n', text.find("Frame Time"));
  while ((line = text.find('\n', line + 1)) != std::string::npos) {
    const size_t end = text[line - 1] == '\r' ? line - 1 : line;
    text.insert(end, row);
    line = text.find('\n', line);
  }
  return text;
}

TEST(WholeRig, TargetsFollowAndWhatHangsBesideIsPlaced) {
  const Scratch scratch;
  const std::string clip = scratch.Write("targets.bvh", WithTargets());
  const RigMotion before = io::ReadBvh(clip).motion;
  ASSERT_GE(before.rig.Find("ik_foot_r"), 0);
  for (const bool follow : {true, false}) {
    const std::string out = follow ? "follow" : "keep";
    const Outcome run = RunClip(scratch, clip, follow ? "" : "--ik-targets-a keep", out);
    ASSERT_TRUE(run.code == 0 || run.code == 3) << run.err;
    EXPECT_EQ(run.err.find("'ik_foot_l' goes with 'LeftFoot'") != std::string::npos, true)
        << run.err;
    const RigMotion after = io::ReadBvh(scratch / (out + "/a.bvh")).motion;
    // In the frame of the bone that it goes with, or of the figure as it was placed.
    const auto place_in = [](const RigMotion& m, int k, const char* name, const char* bone) {
      const PosedRig posed = PoseRig(m.rig, m.frames[k]);
      const int j = m.rig.Find(name), b = m.rig.Find(bone);
      return Vec3(posed.rotation[b].conjugate() * (posed.position[j] - posed.position[b]));
    };
    double apart = 0, from_root = 0, prop = 0;
    for (int k = 0; k < after.num_frames(); k += 10) {
      for (const auto& [target, foot] :
           {std::pair("ik_foot_l", "LeftFoot"), {"ik_foot_r", "RightFoot"}}) {
        apart = std::max(
            apart, (place_in(after, k, target, foot) - place_in(before, k, target, foot)).norm());
        from_root = std::max(from_root, (place_in(after, k, target, "ik_root") -
                                         place_in(before, k, target, "ik_root"))
                                            .norm());
      }
      prop = std::max(
          prop,
          (place_in(after, k, "prop", "ik_root") - place_in(before, k, "prop", "ik_root")).norm());
    }
    EXPECT_LT(prop, 1e-4) << "it is no target";
    if (follow) {
      EXPECT_LT(apart, 1e-3);  // cm
      EXPECT_GT(from_root, 0.1);
    } else {
      EXPECT_LT(from_root, 1e-4);
    }
    // The placement turns the figure towards its partner and moves it: the targets with it.
    const PosedRig was = PoseRig(before.rig, before.frames[0]);
    const PosedRig is = PoseRig(after.rig, after.frames[0]);
    const int root = after.rig.Find("ik_root"), hips = 0;
    const Vec3 moved = is.position[hips] - was.position[hips];
    EXPECT_GT(moved.norm() + 100 * was.rotation[hips].angularDistance(is.rotation[hips]), 1);
    const Vec3 prop_was = was.position[before.rig.Find("prop")] - was.position[hips];
    const Vec3 prop_is = is.position[after.rig.Find("prop")] - is.position[hips];
    EXPECT_NEAR(prop_is.norm(), prop_was.norm(), 12) << "cm: it stays beside the figure";
    EXPECT_GE(root, 0);
  }
  const Outcome wrong = RunClip(scratch, clip, "--ik-targets-a bake");
  EXPECT_NE(wrong.code, 0);
}

// A target that is a node beside the joints, not animated before.
TEST(WholeRig, ATargetThatIsNoJointFollowsItsHand) {
  const Scratch scratch;
  const std::string clip = scratch.Write("hero.glb", HeroGlb(Chest::kRigid));
  const Outcome run = RunClip(scratch, clip);
  ASSERT_TRUE(run.code == 0 || run.code == 3) << run.err;
  EXPECT_NE(run.err.find("'IK_Hand.L' goes with 'LeftHand'"), std::string::npos) << run.err;
  const io::GltfOracle before(ReadWholeFile(clip));
  const io::GltfOracle after(ReadWholeFile(scratch / "out/a.glb"));
  size_t hand = 0, target = 0;
  for (size_t n = 0; n < after.parent.size(); ++n) {
    const std::string name = after.document["nodes"][n].value("name", "");
    if (name == "LeftHand") hand = n;
    if (name == "IK_Hand.L") target = n;
  }
  ASSERT_GT(hand * target, 0U);
  const int animation = after.AnimationNamed("retargeted");
  const auto [first, last] = after.Span(animation);
  double moved = 0;
  for (double t = 0; t < last - first; t += 0.1) {
    const auto was = before.Globals(0, t), is = after.Globals(animation, first + t);
    const Vec3 a = (was[hand].inverse() * was[target]).topRightCorner<3, 1>();
    const Vec3 b = (is[hand].inverse() * is[target]).topRightCorner<3, 1>();
    EXPECT_LT((a - b).norm(), 1e-4) << "at " << t;
    moved = std::max(moved, (was[target] - is[target]).topRightCorner<3, 1>().norm());
  }
  EXPECT_GT(moved, 0.01);
}

// The faults that were found, each with its right answer.
std::string Fault(const std::string& path) { return SharedPath("data/faults/" + path); }

TEST(WholeRig, AChestScaledUnevenly) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const Outcome run = RunClip(scratch, Fault("22_chest_scaled_unevenly/a.glb"));
  EXPECT_EQ(run.code, 0) << run.out;
  EXPECT_LT(GlbToScene(scratch), 0.005);
}

TEST(WholeRig, AHelperBoneThatTurns) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const Outcome run = RunClip(scratch, Fault("04_helper_bone_turns/a.bvh"));
  EXPECT_EQ(run.code, 0) << run.out;
  const json report = json::parse(ReadWholeFile(scratch / "out/report.json"));
  EXPECT_LT(report["write_back"]["a"]["largest_error_m"].get<double>(), 0.001);
}

TEST(WholeRig, FeetThatHangFromTheMasterBone) {
  SKIP_WITHOUT_SHARED_DATA();
  int checked = 0;
  {
    const Scratch scratch;
    EXPECT_EQ(RunClip(scratch, Fault("08_feet_hang_from_master/a.bvh")).code, 0);
    const RigMotion motion = io::ReadBvh(scratch / "out/a.bvh").motion;
    for (const RigFrame& frame : motion.frames) {
      const PosedRig posed = PoseRig(motion.rig, frame);
      for (const std::string side : {"Left", "Right"}) {
        const int shin = motion.rig.Find(side + "Leg"), foot = motion.rig.Find(side + "Foot");
        const Vec3 end =
            posed.position[shin] + posed.rotation[shin] * motion.rig.joints[shin].end_site.value();
        EXPECT_LT((posed.position[foot] - end).norm(), 0.2) << "cm";
        ++checked;
      }
    }
  }
  const Scratch scratch;
  EXPECT_EQ(RunClip(scratch, Fault("08_feet_hang_from_master/a.glb")).code, 0);
  EXPECT_LT(GlbToScene(scratch), 0.005);
  const json report = json::parse(ReadWholeFile(scratch / "out/report.json"));
  EXPECT_TRUE(report["write_back"]["a"]["joints"].contains("left_ankle"));
  EXPECT_GT(checked, 100);
}

}  // namespace
}  // namespace retarget::cli
