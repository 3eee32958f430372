// What is written, as Blender reads it.
#include "tests/blender/blender.h"

#include <unistd.h>

#include "io/bvh/bvh.h"
#include "io/clip_file.h"
#include "io/scene/scene_motion.h"
#include "model/rig/rig.h"
#include "tests/tools/run_program.h"

namespace retarget::cli {
namespace {

constexpr double kTolerance = 1e-4;  // m

// The shipped example, 40 frames of it, solved once for all tests.
class BlenderTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (std::system("command -v blender >/dev/null 2>&1") != 0) return;
    std::string name = (fs::temp_directory_path() / "retarget-blender-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    const std::string hold = ProjectPath("data/holds/bear_hug");
    const std::string command = std::string(RETARGET_BINARY) + " --clip-a " + hold +
                                "/a.bvh --clip-b " + hold + "/b.bvh --template " + hold +
                                "/template.yaml --frames 0:40 --out " + folder_ +
                                "/out >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  static void TearDownTestSuite() {
    if (!folder_.empty()) fs::remove_all(folder_);
  }
  static std::string Written(const std::string& name) { return folder_ + "/out/" + name; }

 private:
  static inline std::string folder_;
};

TEST_F(BlenderTest, SeesTheScenesAsTheyAreMeant) {
  SKIP_WITHOUT_BLENDER();
  for (const char* name : {"scene.glb", "source.glb"}) {
    const io::SceneMotion scene = io::ReadSceneGlb(Written(name));
    const JointCurves curves = BlenderJoints(Written(name), 30);
    EXPECT_GE(curves.size(), 42u) << name;  // the nodes of both figures
    EXPECT_TRUE(curves.contains("b/head_top"));
    int checked = 0;
    double worst = 0;
    for (const auto& [node, points] : curves) {
      ASSERT_EQ(points.size(), 40u) << node;
      const size_t slash = node.find('/');
      for (size_t f = 0; f < points.size(); ++f, ++checked) {
        std::vector<Vec3> ours;
        scene.NodePositions(static_cast<double>(f) / 30, node.substr(0, slash),
                            {node.substr(slash + 1)}, &ours);
        worst = std::max(worst, (ours[0] - points[f]).norm());
      }
    }
    EXPECT_LT(worst, kTolerance) << name;
    EXPECT_GE(checked, 42 * 40);
  }
}

// Every joint of a BVH file; `unit` in m.
void CompareBvh(const std::string& path, double unit) {
  const RigMotion motion = io::ReadBvh(path).motion;
  const JointCurves curves = BlenderJoints(path, 1 / motion.frame_time);
  ASSERT_EQ(curves.size(), motion.rig.joints.size());
  int checked = 0;
  double worst = 0;
  for (int f = 0; f < motion.num_frames(); ++f) {
    const PosedRig posed = PoseRig(motion.rig, motion.frames[static_cast<size_t>(f)]);
    for (size_t j = 0; j < posed.position.size(); ++j, ++checked) {
      const auto& points = curves.at(motion.rig.joints[j].name);
      ASSERT_EQ(points.size(), motion.frames.size());
      worst = std::max(worst, unit * (posed.position[j] - points[static_cast<size_t>(f)]).norm());
    }
  }
  EXPECT_LT(worst, kTolerance) << path;
  EXPECT_GE(checked, 30 * 20);
}

TEST_F(BlenderTest, SeesTheWrittenClipsAsTheyAreMeant) {
  SKIP_WITHOUT_BLENDER();
  CompareBvh(Written("a.bvh"), 0.01);
  CompareBvh(Written("b.bvh"), 0.01);
}

// Two characters with meshes, driven by the example's clips: what comes back on their rigs, joint
// by joint as the scene shows the nodes that they play.
TEST_F(BlenderTest, SeesTheWrittenCharactersAsTheyAreMeant) {
  SKIP_WITHOUT_BLENDER();
  SKIP_WITHOUT_SHARED_DATA();
  const Scratch scratch;
  const std::string characters = SharedPath("data/characters/");
  const Outcome run =
      RunProgram(scratch, kExample + " --frames 0:40 --character-a " + characters +
                              "m2m_human-male.glb --character-b " + characters +
                              "m2m_mixamo-sample-rig.glb --out " + (scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* name : {"a.glb", "b.glb"}) {
    io::ClipPath path = io::ParseClipPath(scratch / ("out/" + std::string(name)));
    path.select.animation = io::kAnimationName;
    const RigMotion motion = io::ReadClipFile(path).motion;
    const JointCurves curves = BlenderJoints(path.path, 1 / motion.frame_time, io::kAnimationName);
    int checked = 0;
    double worst = 0;
    for (int f = 0; f < motion.num_frames(); ++f) {
      const PosedRig posed = PoseRig(motion.rig, motion.frames[static_cast<size_t>(f)]);
      for (size_t j = 0; j < posed.position.size(); ++j) {
        const auto curve = curves.find(motion.rig.joints[j].name);
        if (curve == curves.end()) continue;
        ASSERT_GE(curve->second.size(), motion.frames.size());
        worst = std::max(worst, (posed.position[j] - curve->second[static_cast<size_t>(f)]).norm());
        ++checked;
      }
    }
    EXPECT_LT(worst, kTolerance) << name;
    EXPECT_GE(checked, 30 * 60) << name;
  }
}

TEST_F(BlenderTest, ReadsARealClipAsWeDo) {
  SKIP_WITHOUT_BLENDER();
  SKIP_WITHOUT_SHARED_DATA();
  CompareBvh(SharedPath("data/clips/mixamo_freebvh.bvh"), 0.01);
}

// The add-on's own script does what an artist does; this says whether what it measured is good.
TEST(BlenderAddOn, MakesALayerOfTheSolvedMotionAndTouchesNothingElse) {
  SKIP_WITHOUT_BLENDER();
  const Scratch scratch;
  const std::string command =
      "TMPDIR='" + (scratch / "") + "' RETARGET_BINARY=" RETARGET_BINARY " BLENDER_USER_SCRIPTS='" +
      (scratch / "scripts") + "' BLENDER_USER_CONFIG='" + (scratch / "config") +
      "' blender --background --factory-startup --python-exit-code 1 --python '" +
      ProjectPath("tests/blender/addon_test.py") + "' -- '" + ProjectPath("") + "' '" +
      RETARGET_BLENDER_ZIP "' '" + scratch / "" + "' >'" + (scratch / "log") + "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << ReadWholeFile(scratch / "log");
  const nlohmann::json measured = nlohmann::json::parse(ReadWholeFile(scratch / "result.json"));
  EXPECT_GE(measured["checked"], 30 * 40);
  EXPECT_LT(measured["bvh"], kTolerance) << measured;
  // The rig itself reaches the scene's nodes as well as the report says.
  EXPECT_LT(measured["glb"].get<double>(), measured["write_back"].get<double>() + kTolerance);
  EXPECT_GT(measured["moved"], 0.01);
  EXPECT_TRUE(measured["undo"]);
}

}  // namespace
}  // namespace retarget::cli
