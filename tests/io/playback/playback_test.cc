// Players against what is known beforehand: closed forms, glTF's rules written out once more, and
// the readers of clips, which share no code with them.
#include "io/playback/playback.h"

#include <random>

#include "io/acclaim/acclaim.h"
#include "io/bvh/bvh.h"
#include "io/gltf/clip.h"
#include "tests/io/gltf/gltf_maker.h"
#include "tests/io/gltf/gltf_oracle.h"

namespace retarget::io {
namespace {

constexpr const char* kArm =
    "HIERARCHY\nROOT Upper arm\n{ OFFSET 0 1 0\n CHANNELS 6 Xposition Yposition Zposition "
    "Zrotation "
    "Xrotation Yrotation\n JOINT Lower\n { OFFSET 2 0 0\n CHANNELS 1 Zrotation\n End Site\n { "
    "OFFSET 3 0 0 }\n }\n}\nMOTION\nFrames: 2\nFrame Time: 0.5\n1 2 3 0 0 0 0\n1 2 3 90 0 0 45\n";

std::string Refusal(const PlayedFile& file, const std::vector<PlayedJoint>& joints) {
  try {
    Play(file, joints, {0});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Playback, BvhByHand) {
  PlayedFile file{"BVH", "arm.bvh", kArm, "", "", "", 0};
  const Played played = Play(file, {{"Lower"}, {"Upper arm"}}, {0, 0.25, 0.5, 9});
  EXPECT_EQ(played.seconds, 0.5);
  EXPECT_LT((played.position[0][0] - Vec3(3, 2, 3)).norm(), 1e-12);
  EXPECT_LT((played.position[0][1] - Vec3(1, 2, 3)).norm(), 1e-12);
  const double half = 2 * std::sqrt(0.5);  // 45 degrees on the way to 90
  EXPECT_LT((played.position[1][0] - Vec3(1 + half, 2 + half, 3)).norm(), 1e-12);
  EXPECT_LT((played.position[2][0] - Vec3(1, 4, 3)).norm(), 1e-12);
  EXPECT_EQ(played.position[3][0], played.position[2][0]);
  PlayedFile displaced = file;
  displaced.displaced = {0};  // the root stands at its OFFSET and the channels' displacement
  EXPECT_LT((Play(displaced, {{"Lower"}}, {0}).position[0][0] - Vec3(3, 3, 3)).norm(), 1e-12);
  EXPECT_EQ(Refusal(file, {{"Hand"}}), "arm.bvh: has no joint Hand");
  file.bytes = "HIERARCHY\n";
  EXPECT_EQ(Refusal(file, {{"Hand"}}), "arm.bvh: no MOTION after the hierarchy");
}

// Every joint of a rig where its reader has it.
int CompareWithReader(const PlayedFile& file, const RigMotion& motion) {
  std::vector<PlayedJoint> joints;
  for (const RigJoint& joint : motion.rig.joints) joints.push_back({joint.name});
  std::vector<double> times;
  for (double t = 0; t < 1; t += 0.0917) times.push_back(t);
  const Played played = Play(file, joints, times);
  int checked = 0;
  for (size_t t = 0; t < times.size(); ++t) {
    const PosedRig posed = PoseRig(motion.rig, SampleRig(motion, times[t]));
    for (int j = 0; j < motion.rig.num_joints(); ++j) {
      if (motion.rig.Find(motion.rig.joints[j].name) != j) continue;  // the first of a name
      // Directions of Acclaim bones are unit but for their last digit, which the reader mends.
      const double rounding = file.format == "Acclaim" ? 1e-5 : 1e-6;
      EXPECT_LT((played.position[t][j] - posed.position[j]).norm(), rounding)
          << file.name << " " << motion.rig.joints[j].name << " at " << times[t];
      ++checked;
    }
  }
  return checked;
}

TEST(Playback, BvhAsTheReaderHasIt) {
  std::vector<std::string> paths = {ProjectPath("data/holds/bear_hug/a.bvh")};
  if (std::filesystem::exists(SharedPath("data/README.md"))) {
    for (const auto& entry : std::filesystem::directory_iterator(SharedPath("data/clips"))) {
      if (entry.path().extension() == ".bvh") paths.push_back(entry.path().string());
    }
  }
  int checked = 0;
  for (const std::string& path : paths) {
    const std::string bytes = ReadWholeFile(path);
    checked += CompareWithReader({"BVH", path, bytes, "", "", "", 0}, ParseBvh(bytes, path).motion);
  }
  EXPECT_GT(checked, 150);
}

TEST(Playback, AcclaimAsTheReaderHasIt) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string asf = ReadWholeFile(SharedPath("data/clips/cmu_16_15.asf"));
  const std::string amc = ReadWholeFile(SharedPath("data/clips/cmu_16_15.amc"));
  const RigMotion motion = ParseAcclaim(asf, "a.asf", amc, "a.amc", 120).motion;
  EXPECT_GT(CompareWithReader({"Acclaim", "a.amc", amc, asf, "", "", 120}, motion), 200);
}

// A character whose nodes are scaled unevenly, one of them in the animation, between matrices.
GltfMaker UnevenCharacter() {
  GltfMaker maker = AwkwardCharacter();
  std::mt19937 random(11);
  const int a = maker.AddAnimation("captured");
  const int times = maker.AddArray(Times(6, 25, 0.2), "SCALAR");
  for (const int node : {4, 5, 8}) {
    maker.AddChannel(a, node, "rotation", times, maker.AddArray(SomeRotations(&random, 6), "VEC4"));
  }
  maker.document["nodes"][0]["scale"] = {0.01, 0.012, 0.009};
  maker.document["nodes"][4]["scale"] = {1.2, 1.0, 0.9};
  std::vector<float> scales;
  for (int k = 0; k < 6; ++k) {
    for (const float s : {1.0F + 0.1F * k, 1.0F, 1.3F - 0.1F * k}) scales.push_back(s);
  }
  maker.AddChannel(a, 5, "scale", times, maker.AddArray(scales, "VEC3"));
  return maker;
}

TEST(Playback, GltfByItsRules) {
  const std::string bytes = UnevenCharacter().Glb();
  const GltfOracle oracle(bytes);
  std::vector<PlayedJoint> joints;
  for (int n = 0; n < static_cast<int>(oracle.parent.size()); ++n) joints.push_back({"", n});
  const std::vector<double> times = {0, 0.04, 0.05, 0.123, 0.2, 5};
  const Played played = Play({"glTF", "a.glb", bytes, "", "", "captured", 0}, joints, times);
  EXPECT_NEAR(played.seconds, 0.2, 1e-6);
  int checked = 0;
  for (size_t t = 0; t < times.size(); ++t) {
    const auto globals = oracle.Globals(0, 0.2F + times[t]);
    for (size_t n = 0; n < globals.size(); ++n) {
      const Vec3 expected = globals[n].topRightCorner<3, 1>();
      EXPECT_LT((played.position[t][n] - expected).norm(), 1e-9) << n << " at " << times[t];
      ++checked;
    }
  }
  EXPECT_EQ(checked, 60);
  EXPECT_EQ(Refusal({"glTF", "a.glb", bytes, "", "", "other", 0}, joints),
            "a.glb: no animation other");
  EXPECT_EQ(Refusal({"glTF", "a.glb", bytes, "", "", "captured", 0}, {{"tail"}}),
            "a.glb: has no joint tail");
  EXPECT_NE(Refusal({"glTF", "a.glb", bytes.substr(0, 900), "", "", "captured", 0}, joints), "");
}

// The reader's rig stands where the file's matrices put it, and so does what is written from it.
TEST(Playback, UnevenScalesAreReadAndWrittenAsTheFormatSays) {
  const GltfClip clip = ParseGltf(UnevenCharacter().Glb(), "a.glb", "");
  RigMotion motion = clip.motion;
  ASSERT_EQ(motion.num_frames(), 6);
  int checked = 0;
  for (const bool edited : {false, true}) {
    std::mt19937 random(21);
    for (RigFrame& frame : motion.frames) {
      for (Quat& q : frame.rotation) {
        if (edited) q = (q * SomeRotation(&random, 0.2)).normalized();
      }
    }
    const GltfOracle oracle(FormatGltf(clip, motion));
    const int animation = oracle.AnimationNamed("retargeted");
    for (int k = 0; k < motion.num_frames(); ++k) {
      const auto globals = oracle.Globals(animation, clip.key_times[k]);
      const PosedRig posed = PoseRig(motion.rig, motion.frames[k]);
      for (size_t j = 0; j < clip.joints.size(); ++j) {
        const Vec3 expected = globals[clip.joints[j].node].topRightCorner<3, 1>();
        EXPECT_LT((posed.position[j] - expected).norm(), 1e-6)
            << motion.rig.joints[j].name << " in frame " << k;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 80);
}

}  // namespace
}  // namespace retarget::io
