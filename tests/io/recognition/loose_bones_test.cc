#include "io/recognition/loose_bones.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/rig_figure.h"

namespace retarget::io {
namespace {

// A figure with its map, as recognition gives it.
struct Mapped {
  RigFigure figure{{{"root", "pelvis"},
                    {"spine0", "spine_01"},
                    {"spine1", "spine_02"},
                    {"neck", "neck_01"},
                    {"head", "head"},
                    {"left_shoulder", "upperarm_l"},
                    {"left_elbow", "lowerarm_l"},
                    {"left_wrist", "hand_l"},
                    {"right_shoulder", "upperarm_r"},
                    {"right_elbow", "lowerarm_r"},
                    {"right_wrist", "hand_r"},
                    {"left_hip", "thigh_l"},
                    {"left_knee", "calf_l"},
                    {"left_ankle", "foot_l"},
                    {"left_toe", "ball_l"},
                    {"right_hip", "thigh_r"},
                    {"right_knee", "calf_r"},
                    {"right_ankle", "foot_r"},
                    {"right_toe", "ball_r"}}};
  JointMap map;

  Mapped() {
    const auto at = [&](const std::string& name) { return figure.motion.rig.Find(name); };
    map.root = at("pelvis");
    map.spine = {at("spine_01"), at("spine_02")};
    map.neck = {at("neck_01")};
    map.head = at("head");
    for (const auto& [side, s] : {std::pair("_l", &map.left), {"_r", &map.right}}) {
      const std::string end = side;
      s->shoulder = at("upperarm" + end);
      s->elbow = at("lowerarm" + end);
      s->wrist = at("hand" + end);
      s->hip = at("thigh" + end);
      s->knee = at("calf" + end);
      s->ankle = at("foot" + end);
      s->toe = at("ball" + end);
    }
  }

  // What a bone of that name goes with, that stands apart from the figure; empty: nothing.
  std::string Target(const std::string& name, const Vec3& where) {
    figure.Add(name, -1, where);
    figure.Rest();
    const auto followers = FindFollowers(figure.motion, map, 0.01, 1.75);
    const Rig& rig = figure.motion.rig;
    const auto it = std::find_if(followers.begin(), followers.end(), [&](const RigFollower& f) {
      return f.joint == rig.num_joints() - 1;
    });
    return it == followers.end() ? "" : rig.joints[it->bone].name;
  }
};

TEST(LooseBones, TargetsAreToldByTheirNames) {
  const std::pair<const char*, const char*> cases[] = {{"ik_foot_l", "foot_l"},
                                                       {"ik_hand_r", "hand_r"},
                                                       {"ik_hand_gun", "hand_r"},
                                                       {"LeftFootIK", "foot_l"},
                                                       {"IKRightHand", "hand_r"},
                                                       {"Foot_IK.L", "foot_l"},
                                                       {"ctrl_foot.R", "foot_r"},
                                                       {"IK_Target_Leg_R", "foot_r"},
                                                       {"ToeIK.L", "ball_l"},
                                                       {"Arm_IK_Target.L", "hand_l"},
                                                       {"PoleTarget.Knee.R", "thigh_r"},
                                                       {"elbow_pole_l", "upperarm_l"},
                                                       {"LeftKneePole", "thigh_l"},
                                                       {"leg_pv_r", "thigh_r"},
                                                       {"ik_foot_root", ""},
                                                       {"ik_hand_root", ""},
                                                       {"camera_target", ""},
                                                       {"sword", ""},
                                                       {"Kimono_L", ""},
                                                       {"footstool", ""}};
  int checked = 0;
  for (const auto& [name, bone] : cases) {
    EXPECT_EQ(Mapped().Target(name, Vec3(90, 40, 60)), bone) << name;
    ++checked;
  }
  EXPECT_EQ(checked, 20);
}

TEST(LooseBones, ANameWithoutASideGoesWithTheNearer) {
  EXPECT_EQ(Mapped().Target("ik_foot", Vec3(40, 10, 0)), "foot_l");
  EXPECT_EQ(Mapped().Target("ik_foot", Vec3(-40, 10, 0)), "foot_r");
}

TEST(LooseBones, WhatStandsAtAJointGoesWithIt) {
  Mapped mapped;
  const Vec3 hand = mapped.figure.Place(mapped.map.left.wrist);
  EXPECT_EQ(mapped.Target("prop", hand + Vec3(1, 0, 0)), "hand_l");
  EXPECT_EQ(Mapped().Target("prop", hand + Vec3(30, 0, 0)), "");
}

TEST(LooseBones, FeetAtTheEndsOfTheShinsAreAnkles) {
  for (const bool at_end : {true, false}) {
    Mapped mapped;
    JointMap map = mapped.map;
    const Vec3 foot = mapped.figure.Place(map.left.ankle);
    // Another foot beside the root, and none on the leg.
    map.left.ankle = map.left.toe = -1;
    mapped.figure.motion.rig.joints[mapped.map.left.ankle].name = "end";
    const int loose = mapped.figure.Add("foot_l", -1, at_end ? foot : Vec3(foot + Vec3(0, 0, 40)));
    mapped.figure.Rest();
    const std::vector<std::string> names = FindLooseFeet(mapped.figure.motion, &map);
    EXPECT_EQ(names.size(), at_end ? 1U : 0U);
    EXPECT_EQ(map.left.ankle, at_end ? loose : -1);
    EXPECT_EQ(map.right.ankle, mapped.map.right.ankle);
  }
}

// One that stays behind when the leg moves would make the shin change its length: it is no ankle.
TEST(LooseBones, AFootThatStaysBehindIsNoAnkle) {
  Mapped mapped;
  JointMap map = mapped.map;
  map.left.ankle = map.left.toe = -1;
  mapped.figure.motion.rig.joints[mapped.map.left.ankle].name = "end";
  mapped.figure.Add("foot_l", -1, mapped.figure.Place(mapped.map.left.ankle));
  mapped.figure.Rest();
  RigFrame bent = mapped.figure.motion.frames[0];
  bent.rotation[map.left.hip] = ExpSo3(Vec3(-1, 0, 0));
  mapped.figure.motion.frames.push_back(bent);
  EXPECT_TRUE(FindLooseFeet(mapped.figure.motion, &map).empty());
  const auto followers = FindFollowers(mapped.figure.motion, map, 0.01, 1.75);
  ASSERT_EQ(followers.size(), 1U) << "it goes with the shin";
  EXPECT_EQ(followers[0].bone, map.left.knee);
}

}  // namespace
}  // namespace retarget::io
