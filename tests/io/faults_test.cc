// Files that tools write and readers stumble over, each with a twin or a fact that says what is
// right: the reference data's folder `faults`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/load_clip.h"
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

}  // namespace
}  // namespace retarget::io
