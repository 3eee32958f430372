// Any rig in, the same rig out: every format through the clip loader and the main command.
#include <algorithm>
#include <map>

#include "io/load_clip.h"
#include "model/geometry/so3.h"
#include "model/rig/write_back.h"
#include "tests/io/read_back.h"
#include "tests/tools/run_program.h"
#include "tools/cli/commands.h"
#include "tools/report/report.h"

namespace retarget::cli {
namespace {

std::string ErrorOf(const std::string& clip) {
  io::ClipOptions options;
  options.path = clip;
  options.option = "a";
  options.words = ProgramWords();
  try {
    io::LoadClip(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// What is not edited plays as before, whatever the format: 0.1 mm and 0.01 degrees per joint.
TEST(AnyRig, IdentityReturnsEveryFormat) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string clips = SharedPath("data/clips/"), characters = SharedPath("data/characters/");
  int formats = 0;
  for (const std::string& path :
       {clips + "cmu_16_15.asf:" + clips + "cmu_16_15.amc", clips + "cmu_16_15.bvh",
        characters + "cesium_man.gltf", characters + "m2m_mixamo-sample-rig.glb"}) {
    io::ClipOptions options;
    options.path = path;
    options.option = "a";
    const io::LoadedClip loaded = io::LoadClip(options);
    const RigMotion& captured = loaded.file.motion;
    const double span = std::min(loaded.duration(), 2.0);
    const Clip clip = loaded.Resampled(30, 0, static_cast<int>(span * 30) + 1);
    const RigMotion back = WriteBack(
        captured, *loaded.binding, 0, [](const Pose& p) { return p; }, clip, clip);
    const RigMotion read = io::ReadBack(loaded.file, io::FormatClipFile(loaded.file, back, "a", 1));
    ASSERT_GE(read.num_frames(), 1) << path;
    int checked = 0;
    for (int k = 0; k < read.num_frames(); k += 5) {
      const PosedRig before = PoseRig(captured.rig, captured.frames[k]);
      const PosedRig after = PoseRig(read.rig, SampleRig(read, k * captured.frame_time));
      for (int j = 0; j < captured.rig.num_joints(); ++j) {
        const int i = read.rig.Find(captured.rig.joints[j].name);
        ASSERT_GE(i, 0) << path << " " << captured.rig.joints[j].name;
        ASSERT_LT(loaded.facts.metres_per_unit * (before.position[j] - after.position[i]).norm(),
                  1e-4)
            << path << " frame " << k << " " << captured.rig.joints[j].name;
        ASSERT_LT(before.rotation[j].angularDistance(after.rotation[i]), 0.01 * kDegree)
            << path << " frame " << k << " " << captured.rig.joints[j].name;
        ++checked;
      }
    }
    EXPECT_GT(checked, 10) << path;
    ++formats;
  }
  EXPECT_EQ(formats, 4);
}

// A character in another clip's motion bends as the clip does and walks as far as its legs allow.
TEST(AnyRig, ACharacterTakesOverTheMotion) {
  SKIP_WITHOUT_SHARED_DATA();
  io::ClipOptions options;
  options.path = ProjectPath("data/holds/bear_hug/a.bvh");
  options.option = "a";
  const io::LoadedClip own = io::LoadClip(options);
  options.character = SharedPath("data/characters/m2m_human-male.glb");
  for (const double stature : {0.0, 1.2}) {
    options.stature = stature;
    const io::LoadedClip hero = io::LoadClip(options);
    EXPECT_TRUE(hero.skin_radii);
    EXPECT_EQ(hero.file.format, "glTF");
    if (stature > 0) {
      EXPECT_NEAR(hero.body.stature, stature, 1e-9);
    }
    const Clip before = own.Resampled(30, 0, 60), after = hero.Resampled(30, 0, 60);
    const double legs = hero.body.SegmentLength(hero.body.FindNode("left_knee")) /
                        own.body.SegmentLength(own.body.FindNode("left_knee"));
    for (int t = 0; t < 60; t += 10) {
      const PosedBody p = PoseBody(own.body, before.frames[t]);
      const PosedBody q = PoseBody(hero.body, after.frames[t]);
      for (const char* name : {"left_elbow", "left_wrist", "right_knee", "right_ankle"}) {
        const int n = own.body.FindNode(name), up = own.body.nodes[n].parent;
        const Vec3 was = (p.node[n] - p.node[up]).normalized();
        const Vec3 is = (q.node[n] - q.node[up]).normalized();
        EXPECT_LT(std::acos(std::clamp(was.dot(is), -1.0, 1.0)), 1 * kDegree) << name << " " << t;
      }
      const Vec3 went = before.frames[t].root_position - before.frames[0].root_position;
      const Vec3 goes = after.frames[t].root_position - after.frames[0].root_position;
      EXPECT_LT((goes - legs * went).norm(), 0.05 * went.norm() + 1e-6);
    }
  }
}

TEST(AnyRig, CharactersAndAcclaimThroughTheMainCommand) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const std::string characters = SharedPath("data/characters/");
  const Outcome run =
      RunProgram(scratch, kExample + " --frames 0:60 --json --character-a " + characters +
                              "m2m_human-male.glb --character-b " + characters +
                              "m2m_mixamo-sample-rig.glb --out " + (scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  const report::Json report = report::Json::parse(run.out);
  EXPECT_EQ(report["write_back"]["a"]["file"], "a.glb");
  EXPECT_LT(report["write_back"]["b"]["largest_error_m"], 0.005);
  EXPECT_EQ(report["inputs"]["clip_a"]["character"]["file"], characters + "m2m_human-male.glb");
  EXPECT_EQ(RunProgram(scratch, "verify " + (scratch / "out")).code, 0);
  // The user's file is in front of what was added to it.
  const std::string original = ReadWholeFile(characters + "m2m_human-male.glb");
  const std::string written = ReadWholeFile(scratch / "out/a.glb");
  EXPECT_GT(written.size(), original.size());
  EXPECT_NE(written.find("retargeted"), std::string::npos);

  // The same run with the characters shown measures the same.
  const Outcome shown = RunProgram(
      scratch, kExample + " --frames 0:60 --json --show characters --stature-b 1.5 --character-b " +
                   characters + "m2m_mixamo-sample-rig.glb --out " + (scratch / "shown"));
  ASSERT_EQ(shown.code, 0) << shown.err;
  const std::string scene = ReadWholeFile(scratch / "shown/scene.glb");
  EXPECT_NE(scene.find("b character/"), std::string::npos);
  EXPECT_EQ(scene.find("a character/"), std::string::npos);
  EXPECT_EQ(RunProgram(scratch, "verify " + (scratch / "shown")).code, 0);

  const std::string clips = SharedPath("data/clips/cmu_16_15");
  const Outcome amc = RunProgram(scratch, "--clip-a " + clips + ".asf:" + clips + ".amc --clip-b " +
                                              clips + ".bvh --frames 0:45 --template " +
                                              ProjectPath("data/holds/bear_hug/template.yaml") +
                                              " --out " + (scratch / "amc"));
  EXPECT_EQ(amc.code, 0) << amc.out;
  EXPECT_TRUE(fs::exists(scratch / "amc/a.amc") && fs::exists(scratch / "amc/a.asf"));
  EXPECT_EQ(RunProgram(scratch, "verify " + (scratch / "amc")).code, 0);
}

// On a joint of few axes an edit within them comes back from the file, one across them cannot.
TEST(AnyRig, StiffTurnsAreThoseThatTheFileCannotHold) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string clips = SharedPath("data/clips/cmu_16_15");
  io::ClipOptions options;
  options.path = clips + ".asf:" + clips + ".amc";
  options.option = "a";
  const io::LoadedClip clip = io::LoadClip(options);
  const RigFrame& captured = clip.file.motion.frames[100];
  const std::vector<LockedAxis> locked_axes = clip.binding->LockedAxesOf(captured);
  std::map<int, std::vector<Vec3>> by_link;
  for (const LockedAxis& turn : locked_axes) by_link[turn.link].push_back(turn.direction);
  const Body& body = clip.body;
  EXPECT_EQ(by_link[body.FindLink("left_elbow")].size(), 2u) << "it only bends";
  EXPECT_EQ(by_link[body.FindLink("left_ankle")].size(), 1u);
  EXPECT_EQ(by_link.count(body.FindLink("left_shoulder")), 0u);
  for (const char* name : {"left_elbow", "right_knee", "left_ankle"}) {
    const int l = body.FindLink(name);
    const auto error_of = [&](const Vec3& direction) {
      Pose pose = clip.binding->PoseOf(captured);
      pose.rotation[l] = pose.rotation[l] * ExpSo3(0.03 * direction);
      RigMotion motion = clip.file.motion;
      motion.frames = {clip.binding->Apply(captured, pose)};
      const RigMotion read = io::ReadBack(clip.file, io::FormatClipFile(clip.file, motion, "a", 1));
      return LogSo3(clip.binding->PoseOf(read.frames[0]).rotation[l].conjugate() * pose.rotation[l])
          .norm();
    };
    const std::vector<Vec3>& across = by_link[l];
    Vec3 within = across.size() == 2 ? across[0].cross(across[1]) : across[0].unitOrthogonal();
    EXPECT_LT(error_of(within), 0.003) << name;
    EXPECT_GT(error_of(across[0]), 0.01) << name;
  }
}

TEST(AnyRig, InspectSaysWhatIsInAFile) {
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const Outcome fox =
      RunProgram(scratch, "inspect --json " + SharedPath("data/characters/Fox.glb"));
  ASSERT_EQ(fox.code, 0) << fox.err;
  const report::Json json = report::Json::parse(fox.out);
  EXPECT_NE(json["animations"].get<std::string>().find("\"Walk\""), std::string::npos);
  EXPECT_EQ(json["human"].get<std::string>().rfind("no: ", 0), 0u);
  EXPECT_NE(RunProgram(scratch, "inspect " + kHold + "/a.bvh").out.find("yes: profile mixamo"),
            std::string::npos);
  EXPECT_EQ(RunProgram(scratch, "inspect nowhere.glb").code, 2);
}

TEST(AnyRig, ClipsThatCannotBeReadSayWhatToDo) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string clips = SharedPath("data/clips/"), characters = SharedPath("data/characters/");
  EXPECT_NE(ErrorOf(clips + "cmu_16_15.asf").find("name its motion too"), std::string::npos);
  EXPECT_NE(ErrorOf(clips + "cmu_16_15.amc").find("name its skeleton too"), std::string::npos);
  EXPECT_NE(ErrorOf(characters + "m2m_human-male.glb").find("--character-a"), std::string::npos);
  for (const char* gait : {"Survey", "Walk", "Run"}) {
    EXPECT_NE(ErrorOf(characters + "Fox.glb#animation=" + gait).find("--map-a"), std::string::npos)
        << gait;
  }
  EXPECT_NE(ErrorOf(characters + "Fox.glb#animation=Fly").find("no animation \"Fly\""),
            std::string::npos);
  EXPECT_NE(ErrorOf(clips + "cmu_16_15.bvh#animation=0").find("no glTF"), std::string::npos);
  EXPECT_NE(ErrorOf(characters + "Fox.glb#bone=1").find("#animation=NAME"), std::string::npos);
  const Scratch scratch;
  const Outcome shown =
      RunProgram(scratch, kExample + " --frames 0:9 --show characters --out " + (scratch / "x"));
  EXPECT_EQ(shown.code, 2) << "neither is a character";
  EXPECT_FALSE(fs::exists(scratch / "x/scene.glb"));
  EXPECT_NE(ErrorOf("nowhere.glb").find("nowhere.glb"), std::string::npos);
}

}  // namespace
}  // namespace retarget::cli
