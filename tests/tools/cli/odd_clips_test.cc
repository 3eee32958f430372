// Clips that other tools write oddly (the reference data's folder `faults`), through the program.
#include "io/bvh/bvh.h"
#include "io/files.h"
#include "io/load_clip.h"
#include "io/scene/scene_motion.h"
#include "model/body/body.h"
#include "model/geometry/so3.h"
#include "tests/tools/run_program.h"
#include "tools/report/report.h"

namespace retarget::cli {
namespace {

// Clip a in the bear hug with the example's clip b, 60 frames, into `out`.
std::string Hug(const std::string& clip, const std::string& out) {
  const std::string hold = ProjectPath("data/holds/bear_hug/");
  return "--frames 0:60 --json --clip-a '" + clip + "' --clip-b " + hold + "b.bvh --template " +
         hold + "template.yaml --out " + out;
}

TEST(OddClips, SolveAsTheirUsualTwinsDo) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const std::string faults = SharedPath("data/faults/");
  int solved = 0;
  for (const char* file :
       {"01_decimetre/makehuman.bvh", "02_positions_are_deltas/a.bvh",
        "06_hand_and_foot_names/openni.bvh", "10_part_words_turned/long_collar.bvh",
        "15_two_people_one_bvh/a.bvh#figure=B_Hips", "11_vrma_first_animation/a.vrma"}) {
    const std::string out = scratch / ("out" + std::to_string(solved));
    const Outcome run = RunProgram(scratch, Hug(faults + file, out));
    ASSERT_EQ(run.code, 0) << file << run.err;
    const report::Json report = report::Json::parse(run.out);
    EXPECT_LT(report["write_back"]["a"]["largest_error_m"], 0.005) << file;
    EXPECT_EQ(RunProgram(scratch, "verify " + out).code, 0) << file;
    ++solved;
  }
  EXPECT_EQ(solved, 6);
  EXPECT_TRUE(fs::exists(scratch / "out5/a.vrma"));
  const Outcome mapped = RunProgram(scratch, "map " + (scratch / "out5/a.vrma"));
  EXPECT_EQ(mapped.code, 0) << mapped.err;
  EXPECT_NE(mapped.out.find("2 animations, the first is taken: 0 \"retargeted\""),
            std::string::npos)
      << mapped.out;
}

// One turns by 300 and by 360 degrees, the other stands in his clip: he is led round, by steps.
TEST(OddClips, WhoIsTurnedAwayIsFollowedAllTheWay) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const std::string hold = ProjectPath("data/holds/bear_hug/");
  for (const auto& [clip, degrees] : {std::pair("turn_300", 300.0), {"turn_360", 360.0}}) {
    const std::string out = scratch / clip;
    const Outcome run = RunProgram(
        scratch, "--frames 0:119 --json --clip-a " +
                     SharedPath(std::string("data/faults/25_turns_away/") + clip + ".bvh") +
                     " --clip-b " + hold + "b.bvh --template " + hold + "template.yaml --out " +
                     out);
    EXPECT_EQ(run.code, 0) << clip << run.err;
    EXPECT_EQ(report::Json::parse(run.out)["pass_throughs"].size(), 0u);
    const io::SceneMotion scene = io::ReadSceneGlb(out + "/scene.glb");
    std::array<double, 2> turned = {0, 0}, step = {0, 0};  // rad
    for (int f = 0; f < 2; ++f) {
      const std::vector<int> root = scene.FindNodes(f == 0 ? "a" : "b", {"root"});
      std::vector<Vec3> place;
      std::vector<Quat> before, now;
      for (size_t t = 0; t < scene.key_times.size(); ++t) {
        scene.NodeFrames(scene.key_times[t], root, &place, &now);
        if (t > 0) {
          const double yaw = YawOf(now[0] * before[0].conjugate());
          turned[f] += yaw;
          step[f] = std::max(step[f], std::abs(yaw));
        }
        before = now;
      }
    }
    EXPECT_NEAR(std::abs(turned[0]) / kDegree, degrees, 15) << clip;
    EXPECT_NEAR(std::abs(turned[1]) / kDegree, degrees, 15) << clip;
    EXPECT_GT(turned[0] * turned[1], 0) << clip;
    EXPECT_LT(step[1], 3 * step[0]) << clip;
  }
}

TEST(OddClips, AStatureAloneSettlesTheUnit) {
  const Scratch scratch;
  io::BvhFile file = io::ReadBvh(ProjectPath("data/holds/bear_hug/a.bvh"));
  RigMotion& motion = file.motion;
  for (RigFrame& frame : motion.frames) {
    for (Vec3& translation : frame.translation) translation *= 0.033;
  }
  io::WriteFile(scratch / "a.bvh", io::FormatBvh(file, motion, 0.033), true);
  const Outcome refused = RunProgram(scratch, Hug(scratch / "a.bvh", scratch / "out"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("give its unit with --units, or its height with --stature"),
            std::string::npos)
      << refused.err;
  const Outcome run =
      RunProgram(scratch, Hug(scratch / "a.bvh", scratch / "out") + " --stature-a 1.78");
  EXPECT_EQ(run.code, 0) << run.err;
  const Outcome map = RunProgram(scratch, "map --stature 1.78 " + (scratch / "a.bvh"));
  EXPECT_NE(map.out.find("stature         1.78 m"), std::string::npos) << map.out << map.err;
}

TEST(OddClips, ATemplateIsTakenFromAPairInOneFile) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const std::string pair = SharedPath("data/faults/15_two_people_one_bvh/a.bvh");
  const Outcome map = RunProgram(scratch, "map " + pair);
  EXPECT_NE(map.out.find("figures         0 Hips, 1 B_Hips"), std::string::npos) << map.out;
  const Outcome made =
      RunProgram(scratch, "template --from-clips '" + pair + "#figure=0' '" + pair +
                              "#figure=1' --frame 3 --out " + (scratch / "t.yaml"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(fs::exists(scratch / "t.yaml"));
  const Outcome none = RunProgram(scratch, "map '" + pair + "#figure=Bips'");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("expected one of 0 \"Hips\", 1 \"B_Hips\""), std::string::npos)
      << none.err;
}

// The next tool finds a T-pose in frame 0 and the motion behind it.
TEST(OddClips, ATPoseMayComeFirst) {
  const Scratch scratch;
  const std::string hold = ProjectPath("data/holds/bear_hug/");
  const std::string clip = hold + "a.bvh";
  const Outcome kept = RunProgram(scratch, Hug(clip, scratch / "kept"));
  ASSERT_EQ(kept.code, 0) << kept.err;
  for (const std::string stature : {"", " --stature-a 1.5"}) {
    const std::string out = scratch / ("posed" + std::to_string(stature.size()));
    const Outcome posed = RunProgram(scratch, Hug(clip, out) + " --rest t-pose" + stature);
    ASSERT_EQ(posed.code, 0) << posed.err;
    EXPECT_EQ(RunProgram(scratch, "verify " + out).code, 0);
    const report::Json report = report::Json::parse(posed.out);
    EXPECT_EQ(report["write_back"]["a"]["rest_frames"], 1);
    EXPECT_LT(report["write_back"]["a"]["largest_error_m"], 0.005);
    io::ClipOptions options;
    options.path = out + "/a.bvh";
    const io::LoadedClip again = io::LoadClip(options);
    EXPECT_EQ(again.facts.t_pose_frames, std::vector<int>{0});
    // By another way than the recogniser's: arms level and across, legs upright, feet on the floor.
    const RigMotion& motion = again.file.motion;
    const PosedRig t = PoseRig(motion.rig, motion.frames[0]);
    const auto at = [&](int joint) -> Vec3 {
      return again.facts.metres_per_unit * t.position[static_cast<size_t>(joint)];
    };
    const JointMap& map = again.facts.map;
    for (const auto& [side, x] : {std::pair(&map.left, 1.0), {&map.right, -1.0}}) {
      EXPECT_GT((at(side->wrist) - at(side->shoulder)).normalized().x() * x, 0.999);
      EXPECT_LT((at(side->ankle) - at(side->hip)).normalized().y(), -0.99);
      EXPECT_NEAR(at(side->ankle).y(), kAnkleHeight * again.facts.stature, 0.02);
    }
    if (!stature.empty()) continue;
    const RigMotion plain = io::ReadBvh(scratch / "kept/a.bvh").motion;
    ASSERT_EQ(motion.num_frames(), plain.num_frames() + 1);
    for (int f = 0; f < plain.num_frames(); ++f) {
      for (size_t j = 0; j < plain.rig.joints.size(); ++j) {
        ASSERT_LT((plain.frames[f].translation[j] - motion.frames[f + 1].translation[j]).norm(),
                  1e-6);
        ASSERT_LT(plain.frames[f].rotation[j].angularDistance(motion.frames[f + 1].rotation[j]),
                  1e-6);
      }
    }
  }
}

TEST(OddClips, ATPoseIsOfBvhAlone) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const std::string vrma = SharedPath("data/faults/11_vrma_first_animation/a.vrma");
  const Outcome run =
      RunProgram(scratch, "--rest t-pose --clip-a " + vrma + " --clip-b " + vrma + " --template " +
                              ProjectPath("data/holds/bear_hug/template.yaml") + " --out " +
                              (scratch / "out"));
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("--rest t-pose: neither clip is, or is put on, a BVH file"),
            std::string::npos)
      << run.err;
}

}  // namespace
}  // namespace retarget::cli
