// Rigs whose names follow no convention as a whole, or a convention in part: what their words say,
// what their places say, and what is refused.
#include "io/recognition/joint_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "io/recognition/recognise.h"
#include "tests/io/recognition/named_parts.h"
#include "tests/rig_figure.h"

namespace retarget::io {
namespace {

constexpr const char* kTrunk[] = {"root", "spine0", "spine1", "neck", "head"};
constexpr const char* kSide[] = {"clavicle", "shoulder", "elbow", "wrist",
                                 "hip",      "knee",     "ankle", "toe"};

// Names between blanks, '-' where there is no bone; '#' stands for the words of the sides.
struct Naming {
  const char* trunk;
  const char* side;
  const char* left;
  const char* right;
};

JointNames NamesOf(const Naming& naming) {
  JointNames names;
  std::istringstream trunk(naming.trunk), side(naming.side);
  std::string name;
  for (const char* joint : kTrunk) {
    if (trunk >> name && name != "-") names[joint] = name;
  }
  for (const char* joint : kSide) {
    if (!(side >> name) || name == "-") continue;
    names[std::string("left_") + joint] = std::regex_replace(name, std::regex("#"), naming.left);
    names[std::string("right_") + joint] = std::regex_replace(name, std::regex("#"), naming.right);
  }
  return names;
}

void ExpectNames(const JointNames& names, const RigMotion& motion, const RigFacts& facts) {
  const auto expect = [&](const std::string& joint, int bone) {
    const auto name = names.find(joint);
    EXPECT_EQ(bone < 0 ? "-" : motion.rig.joints[static_cast<size_t>(bone)].name,
              name == names.end() ? "-" : name->second)
        << joint;
  };
  const JointMap& map = facts.map;
  VisitNamedParts(map, expect);
  expect("left_toe", map.left.toe);
  expect("right_toe", map.right.toe);
}

TEST(JointWords, ReadsSideAndPartInAnyOrderAndSpelling) {
  using enum BodyPart;
  const struct {
    const char* name;
    BodyPart part;
    BodySide side;
  } cases[] = {{"L_armUpper0001_bind_JNT", kUpperArm, BodySide::kLeft},
               {"upper_arm.R.001", kUpperArm, BodySide::kRight},
               {"RIGHT_LOWER_LEG", kShin, BodySide::kRight},
               {"lForeArm", kForearm, BodySide::kLeft},
               {"rig:leftforearm", kForearm, BodySide::kLeft},
               {"Leg_Lower_r", kShin, BodySide::kRight},
               {"LeftToeBase", kToe, BodySide::kLeft},
               {"bip_hand_L", kHand, BodySide::kLeft},
               {"LHandMiddle1", kMiddleFinger, BodySide::kLeft},
               {"LeftHandThumb1", kFinger, BodySide::kLeft},
               {"LeftArmTwist", kHelper, BodySide::kLeft},
               {"ik_foot_l", kHelper, BodySide::kLeft},
               {"HeadTop_End", kHelper, BodySide::kNone},
               {"C_spine0006_bind_JNT", kTrunk, BodySide::kNone},
               {"HipCenter", kTrunk, BodySide::kNone},
               {"ShoulderCenter", kTrunk, BodySide::kNone},
               {"LeftHip", kHip, BodySide::kLeft},
               {"M_neck", kNeck, BodySide::kNone},
               {"Armature.001", kNone, BodySide::kNone},
               {"roller", kNone, BodySide::kNone}};
  for (const auto& c : cases) {
    const JointWords words = ReadJointWords(c.name);
    EXPECT_EQ(words.part, c.part) << c.name;
    EXPECT_EQ(words.side, c.side) << c.name;
  }
}

TEST(JointWords, NamesOfPartsInAnyOrderAreRecognised) {
  const Naming namings[] = {
      {"C_spine0001_JNT C_spine0002_JNT C_spine0006_JNT C_neck0001_JNT C_head0001_JNT",
       "#_clavicle_JNT #_armUpper0001_JNT #_armLower0001_JNT #_hand0001_JNT #_legUpper0001_JNT "
       "#_legLower0001_JNT #_foot0001_JNT #_foot0002_JNT",
       "L", "R"},
      {"ctr_hip ctr_spineA ctr_spineB ctr_neck ctr_head",
       "clavicle_bind_#_jnt arm_upper_bind_#_jnt arm_lower_bind_#_jnt hand_bind_#_jnt "
       "leg_upper_bind_#_jnt leg_lower_bind_#_jnt foot_bind_#_jnt toe_bind_#_jnt",
       "lf", "rt"},
      {"M_pelvis M_spine1 M_spine2 M_neck M_head",
       "#_clav #_upArm #_loArm #_wrist #_upLeg #_loLeg #_foot #_ball", "L", "R"},
      // SlimeVR's, now and before.
      {"HIP WAIST CHEST NECK HEAD",
       "#_SHOULDER #_UPPER_ARM #_LOWER_ARM #_HAND #_UPPER_LEG #_LOWER_LEG #_FOOT -", "LEFT",
       "RIGHT"},
      {"Hip Waist Chest Neck Head", "#UpperShoulder #Shoulder #Elbow #Hand #Hip #Knee #Ankle #Foot",
       "Left", "Right"},
      // OpenNI, Kinect 1 and what pose estimators write: a hand for a wrist, a foot for an ankle.
      {"torso spine chest neck head", "- #_shoulder #_elbow #_hand #_hip #_knee #_foot -", "left",
       "right"},
      {"HipCenter Spine ShoulderCenter - Head", "- Shoulder# Elbow# Hand# Hip# Knee# Foot# -",
       "Left", "Right"},
      {"Hip Spine Thorax Neck Head", "- #Shoulder #Elbow #Wrist #Hip #Knee #Foot -", "L", "R"},
      // Blender's numbers, of all bones and of some.
      {"Hips.001 Spine.001 Spine2.001 Neck.001 Head.001",
       "#Shoulder.001 #Arm.001 #ForeArm.001 #Hand.001 #UpLeg.001 #Leg.001 #Foot.001 #ToeBase.001",
       "Left", "Right"},
      {"Hips.003 Spine.001 Spine2 Neck.002 Head",
       "#Shoulder.001 #Arm.002 #ForeArm.003 #Hand #UpLeg.004 #Leg #Foot.001 #ToeBase.009", "Left",
       "Right"},
      {"Armature.001_Hips Armature.001_Spine Armature.001_Chest Armature.001_Neck "
       "Armature.001_Head",
       "Armature.001_#Shoulder Armature.001_#Arm Armature.001_#ForeArm Armature.001_#Hand "
       "Armature.001_#UpLeg Armature.001_#Leg Armature.001_#Foot Armature.001_#ToeBase",
       "Left", "Right"},
      // Names that say something of the ends alone.
      {"bone0 bone1 bone2 bone3 bone4",
       "#Shoulder bone_#_a bone_#_b #Hand bone_#_c bone_#_d #Foot bone_#_e", "Left", "Right"},
      // Words that are no words stand between such as are.
      {"Hips Spine Chest Neck Head", "#Collar #UpperArm #LowrArm #Hand #Thig #Shin #Foot #Toe",
       "L_", "R_"}};
  for (const Naming& naming : namings) {
    SCOPED_TRACE(naming.side);
    const JointNames names = NamesOf(naming);
    RigFigure figure(names);
    figure.Move(4, 0.2, 5);
    figure.Shuffle(9);
    ExpectNames(names, figure.motion, Recognise(figure.motion, {}, "f"));
  }
}

// One side's names may be odd where the other's are not.
TEST(JointWords, ASideIsReadAsTheOtherIs) {
  JointNames names =
      NamesOf({"Hips Spine Chest Neck Head", "#Clav #ArmHi #ForeArm #Hand #Thigh #Shin #Foot #Toe",
               "Left", "Right"});
  names["left_shoulder"] = "LeftUpperArm";
  names["right_knee"] = "x17";
  names["right_ankle"] = "x18";
  names["left_hip"] = "x19";
  RigFigure figure(names);
  figure.Move(4, 0.2, 5);
  ExpectNames(names, figure.motion, Recognise(figure.motion, {}, "f"));
}

// Long collar bones make the shape ambiguous, not the words.
TEST(JointWords, TellsWhatTheShapeCannot) {
  const Naming naming = {"C_hip C_spineA C_spineB C_neck C_head",
                         "#_clavicle #_armUpper #_armLower #_hand #_legUpper #_legLower #_foot -",
                         "L", "R"};
  const JointNames names = NamesOf(naming);
  RigFigure figure(names);
  Rig& rig = figure.motion.rig;
  for (const char* bone : {"L_armUpper", "R_armUpper"}) {
    RigJoint& joint = rig.joints[static_cast<size_t>(rig.Find(bone))];
    joint.offset *= 25 / joint.offset.norm();
  }
  figure.Rest();
  const RigFacts facts = Recognise(figure.motion, {}, "f");
  ExpectNames(names, figure.motion, facts);
  EXPECT_EQ(facts.map.profile, "words");
  RigMotion nameless = figure.motion;
  for (RigJoint& joint : nameless.rig.joints) joint.name = "bone";
  EXPECT_THROW(Recognise(nameless, {}, "f"), InputError);
}

// What is filled by place is said, and a bone that cannot be meant is left alone.
TEST(JointWords, PlacesAreToldAndHelpersAreNot) {
  const JointNames names =
      NamesOf({"pelvis spine1 spine2 neck head",
               "#_collar #_shoulder #_elbow x#3 #_hip #_knee y#3 -", "left", "right"});
  RigFigure figure(names);
  const RigFacts facts = Recognise(figure.motion, {}, "f");
  ExpectNames(names, figure.motion, facts);
  EXPECT_TRUE(std::ranges::count(
      facts.notes,
      "told by their place in the tree: left_wrist ('xleft3'), left_ankle ('yleft3'), right_wrist "
      "('xright3'), right_ankle ('yright3')"));
  JointNames twisted = names;
  for (const std::string side : {"left", "right"}) {
    twisted[side + "_wrist"] = side + "_elbow_twist";
    twisted[side + "_ankle"] = side + "_knee_ik_target";
  }
  const RigFacts open = Recognise(RigFigure(twisted).motion, {}, "f");
  EXPECT_EQ(open.map.left.wrist, -1);
  EXPECT_EQ(open.map.right.ankle, -1);
}

// Words of a human are not enough: an animal has upper arms too.
TEST(JointWords, AnAnimalsWordsAreRefused) {
  const JointNames names = NamesOf({"C_hip C_spineA C_spineB C_neck C_head",
                                    "#_clavicle #_armUpper #_armLower #_hand #_legUpper #_legLower "
                                    "#_foot -",
                                    "L", "R"});
  RigFigure figure(names);
  Rig& rig = figure.motion.rig;
  // The trunk lies, the arms hang down.
  const Quat forwards = ExpSo3(Vec3(kPi / 2, 0, 0));
  rig.joints[static_cast<size_t>(rig.Find("C_spineA"))].offset =
      forwards * rig.joints[static_cast<size_t>(rig.Find("C_spineA"))].offset;
  rig.joints[static_cast<size_t>(rig.Find("C_spineB"))].offset =
      forwards * rig.joints[static_cast<size_t>(rig.Find("C_spineB"))].offset;
  rig.joints[static_cast<size_t>(rig.Find("C_neck"))].offset =
      forwards * rig.joints[static_cast<size_t>(rig.Find("C_neck"))].offset;
  figure.Rest();
  try {
    Recognise(figure.motion, {}, "f");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("as that of an animal does"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace retarget::io
