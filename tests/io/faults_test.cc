// Files that tools write and readers stumble over, each with a twin or a fact that says what is
// right: the reference data's folder `faults`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/gltf/container.h"
#include "io/load_clip.h"
#include "tests/io/read_back.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

LoadedClip Read(const std::string& file) {
  ClipOptions options;
  options.path = SharedPath("data/faults/") + file;
  return RecogniseClip(options);
}

nlohmann::json JointsOf(const LoadedClip& clip) {
  return nlohmann::json::parse(MapJson(clip.facts, clip.file.motion)).at("joints");
}

TEST(Faults, DecimetresMakeAnAdult) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const char* file : {"01_decimetre/a.bvh", "01_decimetre/makehuman.bvh"}) {
    const LoadedClip clip = Read(file);
    EXPECT_EQ(clip.facts.unit_name, "dm") << file;
    EXPECT_NEAR(clip.facts.stature, 1.76, 0.01) << file;
  }
}

TEST(Faults, DisplacementsAreTheFigureOfAbsolutePositions) {
  SKIP_WITHOUT_SHARED_DATA();
  const LoadedClip deltas = Read("02_positions_are_deltas/a.bvh");
  const LoadedClip usual = Read("02_positions_are_deltas/absolute.bvh");
  EXPECT_EQ(deltas.facts.unit_name, "cm");
  EXPECT_NEAR(deltas.facts.stature, usual.facts.stature, 1e-4);
  EXPECT_EQ(JointsOf(deltas), JointsOf(usual));
}

TEST(Faults, HandsAndFeetEndTheLimbs) {
  SKIP_WITHOUT_SHARED_DATA();
  const LoadedClip clip = Read("06_hand_and_foot_names/openni.bvh");
  const nlohmann::json joints = JointsOf(clip);
  for (const std::string side : {"left_", "right_"}) {
    EXPECT_EQ(joints.at(side + "wrist"), side + "hand");
    EXPECT_EQ(joints.at(side + "ankle"), side + "foot");
    EXPECT_EQ(joints.at(side + "clavicle"), side + "collar");
  }
  EXPECT_TRUE(clip.facts.virtual_joints.empty());
}

TEST(Faults, PartsAreToldByTheirWords) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::pair<const char*, const char*> parts[] = {
      {"clavicle", "_clavicle_bind_JNT"},  {"shoulder", "_armUpper0001_bind_JNT"},
      {"elbow", "_armLower0001_bind_JNT"}, {"wrist", "_hand0001_bind_JNT"},
      {"hip", "_legUpper0001_bind_JNT"},   {"knee", "_legLower0001_bind_JNT"},
      {"ankle", "_foot0001_bind_JNT"},     {"toe", "_foot0002_bind_JNT"}};
  for (const char* file : {"a.bvh", "long_collar.bvh", "pose.bvh", "animation_only.glb"}) {
    SCOPED_TRACE(file);
    const LoadedClip clip = Read(std::string("10_part_words_turned/") + file);
    const nlohmann::json joints = JointsOf(clip);
    for (const auto& [part, name] : parts) {
      EXPECT_EQ(joints.at(std::string("left_") + part), std::string("L") + name);
      EXPECT_EQ(joints.at(std::string("right_") + part), std::string("R") + name);
    }
    EXPECT_EQ(joints.at("head"), "C_head0001_bind_JNT");
    EXPECT_EQ(joints.at("neck"), "C_neck0001_bind_JNT");
    EXPECT_GE(clip.facts.confidence, 0.95);
  }
}

TEST(Faults, TwoPeopleOfOneBvhAreReadOneByOne) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string file = "15_two_people_one_bvh/a.bvh";
  const LoadedClip both = Read(file);
  EXPECT_EQ(both.file.figures, (std::vector<std::string>{"Hips", "B_Hips"}));
  EXPECT_EQ(JointsOf(both).at("root"), "Hips");
  EXPECT_EQ(both.facts.notes.front(),
            "the file holds 2 figures, 0 \"Hips\", 1 \"B_Hips\": the first one is read; "
            "#figure=1 after its name selects the next");
  const LoadedClip first = Read(file + "#figure=0");
  EXPECT_EQ(JointsOf(first), JointsOf(both));
  for (const char* select : {"#figure=1", "#figure=B_Hips"}) {
    const LoadedClip second = Read(file + select);
    const nlohmann::json expected = JointsOf(first);
    for (const auto& [part, bone] : expected.items()) {
      EXPECT_EQ(JointsOf(second).at(part), "B_" + bone.get<std::string>());
    }
    // Their frames are the columns of the file, and what is written holds them alone.
    const RigMotion& all = both.file.motion;
    const RigMotion& own = second.file.motion;
    ASSERT_EQ(2 * own.rig.num_joints(), all.rig.num_joints());
    const RigMotion again = ReadBack(second.file, FormatClipFile(second.file, own, "x", 1));
    ASSERT_EQ(again.rig.num_joints(), own.rig.num_joints());
    for (int j = 0; j < own.rig.num_joints(); ++j) {
      const int k = own.rig.num_joints() + j;
      EXPECT_EQ(again.rig.joints[j].name, all.rig.joints[k].name);
      EXPECT_EQ(again.rig.joints[j].offset, all.rig.joints[k].offset);
      for (int f = 0; f < all.num_frames(); ++f) {
        EXPECT_EQ(own.frames[f].translation[j], all.frames[f].translation[k]);
        EXPECT_LT(again.frames[f].rotation[j].angularDistance(all.frames[f].rotation[k]), 1e-6);
      }
    }
  }
  try {
    Read(file + "#figure=2");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("no figure \"2\", expected one of 0 \"Hips\", 1 \"B_Hips\""),
        std::string::npos)
        << error.what();
  }
}

TEST(Faults, AVrmAnimationComesBackAsOne) {
  SKIP_WITHOUT_SHARED_DATA();
  const LoadedClip clip = Read("11_vrma_first_animation/a.vrma");
  const auto files = FormatClipFile(clip.file, clip.file.motion, "x", 1);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].name, "x.vrma");
  const auto document = nlohmann::json::parse(SplitGltf(files[0].bytes, "x").json);
  ASSERT_EQ(document.at("animations").size(), 2U);
  EXPECT_EQ(document.at("animations")[0].at("name"), kAnimationName);
  const RigMotion again = ReadBack(clip.file, files);
  EXPECT_EQ(again.num_frames(), clip.file.motion.num_frames());
  ClipFile character = clip.file;
  std::get<GltfClip>(character.original).name = "folder/Hero.VRM";
  EXPECT_EQ(NamesOfClipFile(character, "x"), (std::vector<std::string>{"x.vrm"}));
  std::get<GltfClip>(character.original).name = "folder/hero.glb";
  EXPECT_EQ(NamesOfClipFile(character, "x"), (std::vector<std::string>{"x.glb"}));
}

}  // namespace
}  // namespace retarget::io
