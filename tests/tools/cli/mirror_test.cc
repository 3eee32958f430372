// Left and right exchanged: motions, and a whole scene.
#include "model/rig/mirror.h"

#include "io/bvh/bvh.h"
#include "io/recognition/recognise.h"
#include "tests/tools/run_program.h"
#include "tools/report/report.h"

namespace retarget::cli {
namespace {

const Vec3 kMirror(-1, 1, 1);

// A rig that is its own mirror image: every joint stands where the mirror shows its counterpart.
TEST(Mirror, ShowsWhatAMirrorShows) {
  const RigMotion motion = io::ReadBvh(kHold + "/a.bvh").motion;
  const JointMap map = io::Recognise(motion, {}, "a.bvh").map;
  const std::vector<int> counterparts = Counterparts(motion.rig, map);
  const RigMotion mirrored = Mirrored(motion, counterparts);
  const auto name = [&](int j) { return motion.rig.joints[static_cast<size_t>(j)].name; };
  EXPECT_EQ(name(counterparts[static_cast<size_t>(motion.rig.Find("LeftHandMiddle1"))]),
            "RightHandMiddle1");
  EXPECT_EQ(name(counterparts[static_cast<size_t>(motion.rig.Find("Spine1"))]), "Spine1");
  double worst = 0, moved = 0;
  for (size_t t = 0; t < motion.frames.size(); t += 10) {
    const PosedRig before = PoseRig(motion.rig, motion.frames[t]);
    const PosedRig after = PoseRig(motion.rig, mirrored.frames[t]);
    for (size_t j = 0; j < before.position.size(); ++j) {
      const Vec3 seen = kMirror.cwiseProduct(before.position[static_cast<size_t>(counterparts[j])]);
      worst = std::max(worst, (after.position[j] - seen).norm());
      moved = std::max(moved, (after.position[j] - before.position[j]).norm());
    }
  }
  EXPECT_LT(worst, 0.01) << "cm: the file's own rounding of offsets";
  EXPECT_GT(moved, 10);
}

// Twice is the motion itself, on rigs of all kinds, fingers, twists and faces included.
TEST(Mirror, TwiceIsTheMotionItself) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const char* file : {"clips/iclone_007_01_walk.bvh", "clips/mixamo_freebvh.bvh",
                           "clips/bandai_walk_normal_001.bvh", "clips/cmu_16_15.bvh",
                           "pairs/cmu_salsa_10/60_10_scaled.bvh", "clips/fair_dab.bvh"}) {
    SCOPED_TRACE(file);
    const RigMotion motion = io::ReadBvh(SharedPath("data/") + file).motion;
    const JointMap map = io::Recognise(motion, {}, file).map;
    const std::vector<int> counterparts = Counterparts(motion.rig, map);
    int pairs = 0;
    for (size_t j = 0; j < counterparts.size(); ++j) {
      const size_t other = static_cast<size_t>(counterparts[j]);
      EXPECT_EQ(counterparts[other], static_cast<int>(j));
      pairs += other != j;
    }
    EXPECT_GE(pairs, 14);
    const RigMotion twice = Mirrored(Mirrored(motion, counterparts), counterparts);
    for (const size_t t : {size_t{0}, motion.frames.size() / 2, motion.frames.size() - 1}) {
      const PosedRig before = PoseRig(motion.rig, motion.frames[t]);
      const PosedRig after = PoseRig(motion.rig, twice.frames[t]);
      for (size_t j = 0; j < before.position.size(); ++j) {
        EXPECT_LT((after.position[j] - before.position[j]).norm(), 1e-6);
        EXPECT_LT(after.rotation[j].angularDistance(before.rotation[j]), 1e-6);
      }
    }
  }
}

std::string OtherSide(const std::string& node) {
  if (node.starts_with("left_")) return "right_" + node.substr(5);
  if (node.starts_with("right_")) return "left_" + node.substr(6);
  return node;
}

// 1 where `image` is the path on the other side, -1 where it is listed from its other end, else 0.
int OrderOf(const report::Json& path, const report::Json& image) {
  const std::string first = OtherSide(path[0]), last = OtherSide(path[1]);
  if (image[0] == first && image[1] == last) return 1;
  return image[0] == last && image[1] == first ? -1 : 0;
}

// Mirrored clips in the mirrored template: the mirror image of the result.
TEST(Mirror, AMirroredSceneIsSolvedAsItsMirrorImage) {
  const Scratch scratch;
  const std::string hold = ProjectPath("data/holds/rear_choke");
  for (const char* clip : {"a", "b"}) {
    const Outcome mirror = RunProgram(scratch, "mirror " + hold + "/" + clip + ".bvh --out " +
                                                   (scratch / (clip + std::string(".bvh"))));
    ASSERT_EQ(mirror.code, 0) << mirror.err;
  }
  ASSERT_EQ(RunProgram(scratch, "pose " + hold + "/template.yaml --mirror both --out " +
                                    (scratch / "template.yaml"))
                .code,
            0);
  report::Json report[2];
  for (int k = 0; k < 2; ++k) {
    const std::string from = k == 0 ? hold + "/" : scratch / "";
    const Outcome run =
        RunProgram(scratch, "--clip-a " + from + "a.bvh --clip-b " + from + "b.bvh --template " +
                                from + "template.yaml --frames 0:60 --json --out " +
                                (scratch / ("out" + std::to_string(k))));
    ASSERT_EQ(run.code, 0) << run.err;
    report[k] = report::Json::parse(run.out);
  }
  ASSERT_EQ(report[0]["tangles"].size(), report[1]["tangles"].size());
  for (const report::Json& tag : report[0]["tangles"]) {
    // The same limbs on the other side; a path that is listed from its other end changes the sign.
    int found = 0;
    for (const report::Json& image : report[1]["tangles"]) {
      const int order = OrderOf(tag["a"], image["a"]) * OrderOf(tag["b"], image["b"]);
      if (order == 0) continue;
      ++found;
      EXPECT_NEAR(order * image["template_gli"].get<double>(), -tag["template_gli"].get<double>(),
                  1e-3);
    }
    EXPECT_EQ(found, 1);
  }
  const report::Json &one = report[0]["metrics"]["result"], &other = report[1]["metrics"]["result"];
  EXPECT_NEAR(other["smallest_gli"].get<double>() / one["smallest_gli"].get<double>(), 1, 0.02);
  for (const char* figure : {"a", "b"}) {
    for (const char* key : {"pose_error_cm", "joint_edit_deg"}) {
      EXPECT_NEAR(other[figure][key].get<double>() / one[figure][key].get<double>(), 1, 0.02)
          << figure << " " << key;
    }
  }
}

TEST(Mirror, RefusesAnotherFormatsName) {
  const Scratch scratch;
  const Outcome run =
      RunProgram(scratch, "mirror " + kHold + "/a.bvh --out " + (scratch / "a.glb"));
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("expected a name that ends in .bvh"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "a.glb"));
}

}  // namespace
}  // namespace retarget::cli
