// Frames that stand apart: put into a motion that has none, found, and repaired.
#include "model/rig/jumps.h"

#include <gtest/gtest.h>

#include "io/load_clip.h"
#include "model/geometry/so3.h"
#include "tests/test_data.h"

namespace retarget {
namespace {

class Jumps : public testing::Test {
 protected:
  Jumps() {
    io::ClipOptions options;
    options.path = ProjectPath("data/holds/rear_choke/a.bvh");
    clip_ = io::RecogniseClip(options);
    motion_ = clip_.file.motion;
    elbow_ = clip_.facts.map.left.elbow;
  }
  std::vector<JumpRun> Find() const { return FindJumps(motion_, clip_.facts.map); }
  void Disturb(int frame) {
    Quat& q = motion_.frames[frame].rotation[elbow_];
    q = q * ExpSo3(Vec3(1.6, 0.3, 0));
  }
  // Largest turn of the elbow from the undisturbed motion (rad).
  double Error(int frame) const {
    return motion_.frames[frame].rotation[elbow_].angularDistance(
        clip_.file.motion.frames[frame].rotation[elbow_]);
  }
  io::LoadedClip clip_;
  RigMotion motion_;
  int elbow_ = -1;
};

TEST_F(Jumps, AMotionOfAPersonHasNone) { EXPECT_TRUE(Find().empty()); }

TEST_F(Jumps, FramesThatStandApartAreFoundAndInterpolated) {
  for (const int frame : {40, 41, 90}) Disturb(frame);
  const std::vector<JumpRun> runs = Find();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].first, 40);
  EXPECT_EQ(runs[0].last, 41);
  EXPECT_EQ(runs[1].first, 90);
  EXPECT_EQ(runs[1].last, 90);
  EXPECT_EQ(runs[0].joint, elbow_);
  EXPECT_GT(runs[0].speed, 30);
  RepairJumps(runs, &motion_);
  for (const int frame : {40, 41, 90}) EXPECT_LT(Error(frame), 0.05) << frame;
  EXPECT_TRUE(Find().empty());
}

TEST_F(Jumps, AFirstFrameTakesTheNext) {
  Disturb(0);
  const std::vector<JumpRun> runs = Find();
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].first, 0);
  EXPECT_EQ(runs[0].last, 0);
  RepairJumps(runs, &motion_);
  EXPECT_LT(Error(0), 0.05);
}

TEST_F(Jumps, ACutIsSaidAndLeftAlone) {
  for (int t = 60; t < motion_.num_frames(); ++t) Disturb(t);
  const std::vector<JumpRun> runs = Find();
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_TRUE(runs[0].is_cut());
  EXPECT_EQ(runs[0].first, 60);
  const double before = Error(60);
  RepairJumps(runs, &motion_);
  EXPECT_EQ(Error(60), before);
}

TEST(RealJumps, ABadFirstFrameOfACapture) {
  SKIP_WITHOUT_SHARED_DATA();
  io::ClipOptions options;
  options.path = SharedPath("data/clips/cmu_16_15.bvh");
  const io::LoadedClip clip = io::RecogniseClip(options);
  const std::vector<JumpRun> runs = FindJumps(clip.file.motion, clip.facts.map);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].first, 0);
  options.repair_jumps = true;
  const io::LoadedClip repaired = io::RecogniseClip(options);
  EXPECT_TRUE(FindJumps(repaired.file.motion, repaired.facts.map).empty());
}

}  // namespace
}  // namespace retarget
