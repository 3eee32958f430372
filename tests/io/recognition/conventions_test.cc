// Every published convention, as real files have it: with the bones that exporters add, under
// namespaces, in any order, with any local axes and with bones missing. The names are the oracle:
// they come from a list that the code under test does not read, the added bones from the tools'
// own skeletons.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>

#include "io/recognition/joint_profiles.h"
#include "io/recognition/recognise.h"
#include "tests/io/recognition/named_parts.h"
#include "tests/rig_figure.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

// A bone that exporters add: name, parent, offset in the rest pose (cm, x outwards). '#' and '@'
// stand for the convention's words of a side; such bones come twice.
struct Extra {
  const char* name;
  const char* parent;
  double x, y, z;
};

struct Convention {
  const char* key;      // in the published list
  const char* profile;  // the name that the program gives it
  const char* prefix;   // before all names
  const char* left;     // words for '#'
  const char* right;
  std::vector<Extra> extras;
};

const std::vector<Convention>& Conventions() {
  static const std::vector<Convention> conventions = {
      {"mixamo/rpm/humanik/lafan1",
       "mixamo",
       "mixamorig:",
       "Left",
       "Right",
       {{"HeadTop_End", "Head", 0, 20, 2},
        {"#Eye", "Head", 3, 8, 9},
        {"#HandThumb1", "#Hand", 3, -1, 3},
        {"#HandThumb2", "#HandThumb1", 3, 0, 2},
        {"#HandMiddle1", "#Hand", 9, 0, 0},
        {"#HandMiddle2", "#HandMiddle1", 3, 0, 0},
        {"#HandIndex1", "#Hand", 9, 0, 2},
        {"#ToeBase", "#Foot", 0, -6, 13},
        {"#Toe_End", "#ToeBase", 0, 0, 7},
        {"#ArmRoll", "#Arm", 14, 0, 0},
        {"#ForeArmRoll", "#ForeArm", 12, 0, 0},
        {"#UpLegRoll", "#UpLeg", 0, -20, 0}}},
      {"cmu_cgspeed",
       "cmu",
       "",
       "Left",
       "Right",
       {{"LHipJoint", "Hips", 0, 0, 0},
        {"RHipJoint", "Hips", 0, 0, 0},
        {"#FingerBase", "#Hand", 0, 0, 0},
        {"#HandIndex1", "#FingerBase", 5, 0, 0},
        {"LThumb", "LeftHand", 0, 0, 0},
        {"#ToeBase", "#Foot", 0, -4, 12}}},
      {"classic_bvh/xsens", "classic", "", "Left", "Right", {{"#Toe", "#Ankle", 0, -7, 14}}},
      {"rokoko_newton",
       "rokoko",
       "",
       "Left",
       "Right",
       {{"#Toe", "#Foot", 0, -6, 13},
        {"#ToeTip", "#Toe", 0, 0, 6},
        {"#HandThumb1", "#Hand", 3, 0, 3},
        {"#Finger3Metacarpal", "#Hand", 3, 0, 0},
        {"#Finger3Proximal", "#Finger3Metacarpal", 6, 0, 0},
        {"Jaw", "Head", 0, 2, 6}}},
      {"soma",
       "soma",
       "",
       "Left",
       "Right",
       {{"Neck2", "Neck1", 0, 4, 0},
        {"HeadEnd", "Head", 0, 18, 0},
        {"Jaw", "Head", 0, 2, 4},
        {"#HandMiddle1", "#Hand", 4, 0, 0},
        {"#HandMiddleEnd", "#HandMiddle1", 14, 0, 0},
        {"#ToeBase", "#Foot", 0, -6, 13},
        {"#ToeEnd", "#ToeBase", 0, 0, 6}}},
      {"vrm/unity/godot",
       "vrm",
       "",
       "left",
       "right",
       {{"#Toes", "#Foot", 0, -6, 13},
        {"#Eye", "head", 3, 8, 9},
        {"jaw", "head", 0, 2, 5},
        {"#MiddleProximal", "#Hand", 9, 0, 0},
        {"#MiddleIntermediate", "#MiddleProximal", 4, 0, 0},
        {"J_Sec_Hair1_01", "head", 0, 15, -6},
        {"J_Sec_Hair2_01", "J_Sec_Hair1_01", 0, -10, -3},
        {"Root_Skirt", "hips", 0, -10, 0}}},
      {"vroid",
       "vroid",
       "J_Bip_",
       "L",
       "R",
       {{"#_ToeBase", "#_Foot", 0, -6, 13},
        {"#_Middle1", "#_Hand", 9, 0, 0},
        {"#_Thumb1", "#_Hand", 3, 0, 3},
        {"J_Sec_#_Bust1", "C_UpperChest", 8, 0, 10},
        {"J_Adj_#_FaceEye", "C_Head", 3, 8, 9}}},
      {"unreal",
       "unreal",
       "",
       "l",
       "r",
       {{"neck_02", "neck_01", 0, 4, 0},
        {"ball_#", "foot_#", 0, -6, 14},
        {"upperarm_twist_01_#", "upperarm_#", 10, 0, 0},
        {"upperarm_twist_02_#", "upperarm_#", 20, 0, 0},
        {"upperarm_correctiveRoot_#", "upperarm_#", 0, 0, 0},
        {"upperarm_bck_#", "upperarm_correctiveRoot_#", 0, 0, -5},
        {"lowerarm_twist_01_#", "lowerarm_#", 16, 0, 0},
        {"lowerarm_twist_02_#", "lowerarm_#", 8, 0, 0},
        {"thigh_twist_01_#", "thigh_#", 0, -14, 0},
        {"calf_twist_01_#", "calf_#", 0, -28, 0},
        {"clavicle_out_#", "clavicle_#", 6, 3, 0},
        {"middle_metacarpal_#", "hand_#", 3, 0, 0},
        {"middle_01_#", "middle_metacarpal_#", 6, 0, 0},
        {"thumb_01_#", "hand_#", 3, 0, 3},
        {"ik_foot_root", "", 0, 0, 0},
        {"ik_foot_#", "ik_foot_root", 9, 8, 0},
        {"ik_hand_root", "", 0, 0, 0},
        {"ik_hand_gun", "ik_hand_root", -70, 140, 0},
        {"ik_hand_#", "ik_hand_gun", 70, 0, 0},
        {"interaction", "", 0, 0, 0},
        {"center_of_mass", "", 0, 100, 0},
        {"VB spine_03_hand_r", "spine_03", -60, 20, 0}}},
      {"smpl",
       "smpl",
       "",
       "left",
       "right",
       {{"#_foot", "#_ankle", 0, -6, 13},
        {"#_hand", "#_wrist", 8, 0, 0},
        {"jaw", "head", 0, 2, 5},
        {"#_eye_smplhf", "head", 3, 8, 9},
        {"#_middle1", "#_wrist", 9, 0, 0}}},
      {"smpl_fbx",
       "smpl",
       "m_avg_",
       "L",
       "R",
       {{"#_Foot", "#_Ankle", 0, -6, 13}, {"#_Hand", "#_Wrist", 8, 0, 0}}},
      {"biped",
       "biped",
       "Bip01 ",
       "L",
       "R",
       {{"# Toe0", "# Foot", 0, -8, 13},
        {"# Toe0Nub", "# Toe0", 0, 0, 7},
        {"# Finger0", "# Hand", 3, 0, 3},
        {"# Finger2", "# Hand", 9, 0, 0},
        {"# Finger2Nub", "# Finger2", 8, 0, 0},
        {"HeadNub", "Head", 0, 20, 0},
        {"Ponytail1", "Head", 0, 15, -8},
        {"Ponytail1Nub", "Ponytail1", 0, -20, -5},
        {"Footsteps", "Pelvis", 0, -90, 0},
        {"Prop1", "R Hand", -12, 0, 0},
        {"# ForeTwist", "# Forearm", 12, 0, 0}}},
      {"reallusion_cc",
       "reallusion",
       "CC_Base_",
       "L",
       "R",
       {{"Pelvis", "Hip", 0, 0, 0},
        {"NeckTwist02", "NeckTwist01", 0, 4, 0},
        {"FacialBone", "Head", 0, 2, 0},
        {"JawRoot", "FacialBone", 0, 2, 3},
        {"#_Eye", "FacialBone", 3, 6, 8},
        {"#_ToeBase", "#_Foot", 0, -6, 13},
        {"#_ToeBaseShareBone", "#_Foot", 0, -6, 13},
        {"#_BigToe1", "#_ToeBase", 2, 0, 4},
        {"#_UpperarmTwist01", "#_Upperarm", 0, 0, 0},
        {"#_UpperarmTwist02", "#_UpperarmTwist01", 14, 0, 0},
        {"#_ForearmTwist01", "#_Forearm", 0, 0, 0},
        {"#_ForearmTwist02", "#_ForearmTwist01", 12, 0, 0},
        {"#_ElbowShareBone", "#_Forearm", 0, 0, 0},
        {"#_KneeShareBone", "#_Calf", 0, 0, 0},
        {"#_ThighTwist01", "#_Thigh", 0, 0, 0},
        {"#_CalfTwist01", "#_Calf", 0, -5, 0},
        {"#_Mid1", "#_Hand", 9, 0, 0},
        {"#_RibsTwist", "Spine02", 8, 0, 8},
        {"#_Breast", "#_RibsTwist", 0, -3, 5}}},
      {"daz_poser",
       "daz",
       "",
       "l",
       "r",
       {{"#Toe", "#Foot", 0, -6, 13},
        {"#Buttock", "hip", 0, 0, 0},
        {"#Mid1", "#Hand", 9, 0, 0},
        {"#Thumb1", "#Hand", 3, 0, 3},
        {"leftEye", "head", 3, 8, 9},
        {"rightEye", "head", -3, 8, 9}}},
      {"rigify",
       "rigify",
       "DEF-",
       "L",
       "R",
       {{"toe.#", "foot.#", 0, -6, 14},
        {"spine.005", "spine.004", 0, 4, 0},
        {"pelvis.#", "spine", 6, 3, 4},
        {"breast.#", "spine.003", 8, 3, 8},
        {"upper_arm.#.001", "upper_arm.#", 15, 0, 0},
        {"forearm.#.001", "forearm.#", 12, 0, 0},
        {"thigh.#.001", "thigh.#", 0, -20, 0},
        {"shin.#.001", "shin.#", 0, -20, 0},
        {"f_middle.01.#", "hand.#", 9, 0, 0},
        {"palm.02.#", "hand.#", 3, 0, 0},
        {"thumb.01.#", "hand.#", 3, 0, 3}}},
      {"auto_rig_pro",
       "auto_rig_pro",
       "",
       "l",
       "r",
       {{"toes_01.#", "foot.#", 0, -6, 14},
        {"arm_twist.#", "arm_stretch.#", 5, 0, 0},
        {"forearm_twist.#", "forearm_stretch.#", 12, 0, 0},
        {"thigh_twist.#", "thigh_stretch.#", 0, -10, 0},
        {"leg_twist.#", "leg_stretch.#", 0, -28, 0},
        {"c_middle1_base.#", "hand.#", 3, 0, 0},
        {"c_middle1.#", "c_middle1_base.#", 6, 0, 0},
        {"c_skull_01.x", "head.x", 0, 4, 0},
        {"c_jawbone.x", "head.x", 0, 2, 4}}},
      {"project", "project", "", "l", "r", {{"#_toe", "#_ankle", 0, -6, 13}}}};
  return conventions;
}

JointNames NamesOf(const nlohmann::json& joints) {
  JointNames names;
  for (const auto& [key, name] : joints.items()) {
    names[key.starts_with("L_")   ? "left_" + key.substr(2)
          : key.starts_with("R_") ? "right_" + key.substr(2)
                                  : key] = name.get<std::string>();
  }
  return names;
}

std::string WithSide(const char* pattern, const std::string& word) {
  return std::regex_replace(std::string(pattern), std::regex("#"), word);
}

void AddExtra(const Extra& extra, const std::string& word, double x, RigFigure* figure) {
  const std::string name = WithSide(extra.name, word), above = WithSide(extra.parent, word);
  if (figure->motion.rig.Find(name) >= 0) return;
  const int parent = above.empty() ? 0 : figure->motion.rig.Find(above);
  ASSERT_GE(parent, 0) << above;
  figure->Add(name, parent, figure->Place(parent) + Vec3(x * extra.x, extra.y, extra.z));
}

// The figure of a convention with all its extra bones.
RigFigure FullFigure(const Convention& c, const JointNames& names) {
  RigFigure figure(names);
  for (const Extra& extra : c.extras) {
    AddExtra(extra, c.left, 1, &figure);
    AddExtra(extra, c.right, -1, &figure);
  }
  figure.Rest();
  return figure;
}

using Rename = std::function<std::string(const std::string&)>;

void RenameAll(const Rename& rename, RigFigure* figure) {
  for (RigJoint& joint : figure->motion.rig.joints) joint.name = rename(joint.name);
}

// The map must have the bone of every name in `names`, as `rename` made it.
void ExpectMap(const RigFigure& figure, const JointNames& names, const Rename& rename,
               const std::string& profile) {
  RigFacts facts;
  try {
    facts = Recognise(figure.motion, {}, "f");
  } catch (const InputError& error) {
    ADD_FAILURE() << error.what();
    return;
  }
  EXPECT_EQ(facts.map.profile, profile);
  EXPECT_GE(facts.confidence, 0.9);
  const auto expect = [&](const std::string& joint, int bone) {
    const auto name = names.find(joint);
    if (name == names.end()) {
      EXPECT_EQ(bone, -1) << joint;
    } else if (bone < 0) {
      ADD_FAILURE() << joint << " has no bone";
    } else {
      EXPECT_EQ(figure.motion.rig.joints[static_cast<size_t>(bone)].name, rename(name->second))
          << joint;
    }
  };
  const JointMap& map = facts.map;
  VisitNamedParts(map, expect);
  for (size_t n = 0; n < map.spine.size(); ++n) {
    expect("spine" + std::to_string(n), map.spine[n]);
  }
  EXPECT_FALSE(names.contains("spine" + std::to_string(map.spine.size())));
}

class ConventionTest : public testing::Test {
 protected:
  // Calls check(convention, its names) for all of them.
  void ForEach(const std::function<void(const Convention&, const JointNames&)>& check) {
    const auto list = nlohmann::json::parse(ReadWholeFile(TestDataPath("rigs/joint_names.json")));
    ASSERT_EQ(list.size(), Conventions().size());
    for (const Convention& c : Conventions()) {
      SCOPED_TRACE(c.key);
      check(c, NamesOf(list.at(c.key).at("joints")));
    }
  }
  static std::string Same(const std::string& name) { return name; }
};

TEST_F(ConventionTest, WithTheBonesThatExportersAdd) {
  ForEach([](const Convention& c, const JointNames& names) {
    ExpectMap(FullFigure(c, names), names, Same, c.profile);
  });
}

TEST_F(ConventionTest, UnderPrefixesNamespacesAndMarks) {
  ForEach([](const Convention& c, const JointNames& names) {
    const std::string prefix = c.prefix;
    const std::vector<Rename> renames = {
        [&](const std::string& n) { return prefix + n; },
        [&](const std::string& n) { return "Armature|Bob:" + prefix + n; },
        [&](const std::string& n) { return "Character1_" + prefix + n; },
        [&](const std::string& n) { return "Skeleton 001_" + prefix + n; },
        [&](const std::string& n) { return prefix + n + "_JNT"; },
        [&](const std::string& n) { return prefix + n + ".001"; },
        // A second upload, ':' removed by three.js, ':' made '_' by Godot.
        [&](const std::string& n) { return "mixamorig1:" + n; },
        [&](const std::string& n) { return "mixamorig" + n; },
        [&](const std::string& n) { return "mixamorig12_" + n; },
    };
    for (const Rename& rename : renames) {
      SCOPED_TRACE(rename("*"));
      RigFigure figure = FullFigure(c, names);
      RenameAll(rename, &figure);
      ExpectMap(figure, names, rename, c.profile);
    }
  });
}

TEST_F(ConventionTest, WithOtherCaseAndSeparators) {
  const auto mapped = [](int (*change)(int)) {
    return [change](std::string n) {
      std::transform(n.begin(), n.end(), n.begin(),
                     [&](char ch) { return static_cast<char>(change(ch)); });
      return n;
    };
  };
  const auto separator = [](char with) {
    return [with](std::string n) {
      std::replace_if(
          n.begin(), n.end(), [](char ch) { return ch == '_' || ch == '.'; }, with);
      return n;
    };
  };
  const auto none = [](const std::string& n) {
    return std::regex_replace(n, std::regex("[_. ]"), "");
  };
  ForEach([&](const Convention& c, const JointNames& names) {
    const std::vector<Rename> renames = {mapped(std::tolower), mapped(std::toupper), separator(' '),
                                         separator('-'),       separator('.'),       none};
    for (const Rename& rename : renames) {
      SCOPED_TRACE(rename("A_b c.d"));
      RigFigure figure = FullFigure(c, names);
      RenameAll(rename, &figure);
      ExpectMap(figure, names, rename, c.profile);
    }
  });
}

// Sketchfab puts a number of its own behind every name.
TEST_F(ConventionTest, WithNumberedNames) {
  ForEach([](const Convention& c, const JointNames& names) {
    RigFigure figure = FullFigure(c, names);
    std::map<std::string, std::string> numbered;
    for (size_t j = 0; j < figure.motion.rig.joints.size(); ++j) {
      std::string& name = figure.motion.rig.joints[j].name;
      const std::string number = std::to_string(j);
      numbered[name] = name + "_0" + number;
      name = numbered[name];
    }
    ExpectMap(
        figure, names, [&](const std::string& n) { return numbered.at(n); }, c.profile);
  });
}

TEST_F(ConventionTest, InAnyOrderAndWithAnyLocalAxes) {
  ForEach([](const Convention& c, const JointNames& names) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      RigFigure figure = FullFigure(c, names);
      figure.Move(5, 0.3, seed);
      figure.TurnAxes(seed);
      figure.Shuffle(seed);
      ExpectMap(figure, names, Same, c.profile);
    }
  });
}

TEST_F(ConventionTest, WithoutWhatIsNotRequired) {
  ForEach([](const Convention& c, const JointNames& names) {
    const std::vector<std::vector<std::string>> missing = {
        {"neck"}, {"left_clavicle", "right_clavicle"}, {"spine1"}, {"neck", "spine1"}};
    for (const auto& joints : missing) {
      SCOPED_TRACE(joints.front());
      JointNames fewer = names;
      for (const std::string& joint : joints) fewer.erase(joint);
      if (!fewer.contains("spine1")) {  // those above move down
        for (int n = 1; names.contains("spine" + std::to_string(n + 1)); ++n) {
          fewer["spine" + std::to_string(n)] = names.at("spine" + std::to_string(n + 1));
          fewer.erase("spine" + std::to_string(n + 1));
        }
      }
      RigFigure figure(fewer);  // without extra bones, which could hang from the missing ones
      ExpectMap(figure, fewer, Same, c.profile);
    }
  });
}

// A root-motion bone, and a node for the armature, above the figure.
TEST_F(ConventionTest, BelowARootMotionBone) {
  ForEach([](const Convention& c, const JointNames& names) {
    RigFigure figure = FullFigure(c, names);
    auto& joints = figure.motion.rig.joints;
    for (RigJoint& joint : joints) joint.parent += 2;
    for (const char* name : {"Reference", "Armature"}) {
      joints.insert(joints.begin(), RigJoint{});
      joints.front().name = name;
    }
    joints[0].parent = -1;
    joints[1].parent = 0;
    figure.Rest();
    ExpectMap(figure, names, Same, c.profile);
  });
}

// --- Other conventions: joint lists of the tools' own skeletons ---

struct Skeleton {
  const char* profile;
  const char* trunk;  // root, spine, neck, head; a comma between the joints of the next
  const char* left;   // clavicle, shoulder, elbow, wrist, hip, knee, ankle
  const char* from;   // in the names of the left side, becomes `to` on the right
  const char* to;
};

// clang-format off
const Skeleton kSkeletons[] = {
  {"daz_genesis8", "hip; abdomenLower, abdomenUpper, chestLower, chestUpper; neckLower; head",
    "lCollar, lShldrBend, lForearmBend, lHand, lThighBend, lShin, lFoot", "^l", "r"},
  {"daz_genesis9", "hip; spine1, spine2, spine3, spine4; neck1; head",
    "l_shoulder, l_upperarm, l_forearm, l_hand, l_thigh, l_shin, l_foot", "^l_", "r_"},
  {"motive", "Hip; Ab, Chest; Neck; Head",
    "LShoulder, LUArm, LFArm, LHand, LThigh, LShin, LFoot", "^L", "R"},
  {"mixamo", "Robot_Hips; Robot_Spine, Robot_Spine1, Robot_Spine2; Robot_Neck; Robot_Head",
    "Robot_LeftShoulder, Robot_LeftArm, Robot_LeftForeArm, Robot_LeftHand, Robot_LeftUpLeg, "
    "Robot_LeftLeg, Robot_LeftFoot", "Left", "Right"},
  {"mixamo", "hips_JNT; spine_JNT, spine1_JNT, spine2_JNT; neck_JNT; head_JNT",
    "l_shoulder_JNT, l_arm_JNT, l_forearm_JNT, l_hand_JNT, l_upleg_JNT, l_leg_JNT, l_foot_JNT",
    "^l_", "r_"},
  {"mixamo", "hips_joint; spine_1_joint, spine_2_joint, spine_3_joint, spine_4_joint, "
    "spine_5_joint, spine_6_joint, spine_7_joint; neck_1_joint; head_joint",
    "left_shoulder_1_joint, left_arm_joint, left_forearm_joint, left_hand_joint, "
    "left_upLeg_joint, left_leg_joint, left_foot_joint", "left", "right"},
  {"biped", "ValveBiped.Bip01_Pelvis; ValveBiped.Bip01_Spine, ValveBiped.Bip01_Spine1, "
    "ValveBiped.Bip01_Spine2, ValveBiped.Bip01_Spine4; ValveBiped.Bip01_Neck1; "
    "ValveBiped.Bip01_Head1",
    "ValveBiped.Bip01_L_Clavicle, ValveBiped.Bip01_L_UpperArm, ValveBiped.Bip01_L_Forearm, "
    "ValveBiped.Bip01_L_Hand, ValveBiped.Bip01_L_Thigh, ValveBiped.Bip01_L_Calf, "
    "ValveBiped.Bip01_L_Foot", "_L_", "_R_"},
  {"advanced_skeleton", "Root_M; Spine1_M, Spine2_M, Chest_M; Neck_M; Head_M",
    "Scapula_L, Shoulder_L, Elbow_L, Wrist_L, Hip_L, Knee_L, Ankle_L", "_L$", "_R"},
  {"synty", "Hips; Spine_01, Spine_02, Spine_03; Neck; Head",
    "Clavicle_L, Shoulder_L, Elbow_L, Hand_L, UpperLeg_L, LowerLeg_L, Ankle_L", "_L$", "_R"},
  {"cascadeur", "pelvis; stomach, chest; neck; head",
    "clavicle_l, arm_l, forearm_l, hand_l, thigh_l, calf_l, foot_l", "_l$", "_r"},
  {"vrm", "LowerTorso; UpperTorso; ; Head",
    ", LeftUpperArm, LeftLowerArm, LeftHand, LeftUpperLeg, LeftLowerLeg, LeftFoot", "Left",
    "Right"},
  {"vrm", "hips; spine, chest; ; head",
    ", upperarm.l, lowerarm.l, hand.l, upperleg.l, lowerleg.l, foot.l", "l$", "r"},
  {"xsens", "Pelvis; L5, L3, T12, T8; Neck; Head",
    "LeftShoulder, LeftUpperArm, LeftForeArm, LeftHand, LeftUpperLeg, LeftLowerLeg, LeftFoot",
    "Left", "Right"},
  {"kinect", "PELVIS; SPINE_NAVAL, SPINE_CHEST; NECK; HEAD",
    "CLAVICLE_LEFT, SHOULDER_LEFT, ELBOW_LEFT, WRIST_LEFT, HIP_LEFT, KNEE_LEFT, ANKLE_LEFT",
    "LEFT", "RIGHT"},
  {"second_life", "mPelvis; mTorso, mChest; mNeck; mHead",
    "mCollarLeft, mShoulderLeft, mElbowLeft, mWristLeft, mHipLeft, mKneeLeft, mAnkleLeft",
    "Left", "Right"},
  {"makehuman", "root; spine05, spine04, spine03, spine02, spine01; neck01; head",
    "clavicle.L, upperarm01.L, lowerarm01.L, wrist.L, upperleg01.L, lowerleg01.L, foot.L",
    "L$", "R"},
  {"mmd", "Hips; Spine, Chest; Neck; Head",
    "Left shoulder, Left arm, Left elbow, Left wrist, Left leg, Left knee, Left ankle", "Left",
    "Right"},
  {"mmd_japanese", "\u30bb\u30f3\u30bf\u30fc; \u4e0a\u534a\u8eab, \u4e0a\u534a\u8eab2; \u9996; "
    "\u982d", "\u5de6\u80a9, \u5de6\u8155, \u5de6\u3072\u3058, \u5de6\u624b\u9996, \u5de6\u8db3, "
    "\u5de6\u3072\u3056, \u5de6\u8db3\u9996", "\u5de6", "\u53f3"},
  {"cmu_asf", "root; lowerback, upperback, thorax; lowerneck; head",
    "lclavicle, lhumerus, lradius, lwrist, lfemur, ltibia, lfoot", "^l", "r"},
};
// clang-format on

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    part.erase(0, part.find_first_not_of(' ') == std::string::npos ? part.size()
                                                                   : part.find_first_not_of(' '));
    parts.push_back(part);
  }
  return parts;
}

JointNames NamesOf(const Skeleton& s) {
  const auto groups = Split(s.trunk, ';');
  JointNames names = {{"root", groups[0]}, {"head", groups[3]}};
  int spines = 0;
  for (const std::string& bone : Split(groups[1], ',')) {
    names["spine" + std::to_string(spines++)] = bone;
  }
  if (!groups[2].empty()) names["neck"] = groups[2];
  const auto left = Split(s.left, ',');
  const char* joints[] = {"clavicle", "shoulder", "elbow", "wrist", "hip", "knee", "ankle"};
  for (size_t n = 0; n < left.size(); ++n) {
    if (left[n].empty()) continue;
    names[std::string("left_") + joints[n]] = left[n];
    names[std::string("right_") + joints[n]] =
        std::regex_replace(left[n], std::regex(s.from), s.to);
  }
  return names;
}

TEST(OtherConventions, AreRecognised) {
  for (const Skeleton& s : kSkeletons) {
    SCOPED_TRACE(std::string(s.profile) + " " + s.trunk);
    const JointNames names = NamesOf(s);
    RigFigure figure(names);
    figure.Move(4, 0.2, 5);
    figure.Shuffle(9);
    ExpectMap(
        figure, names, [](const std::string& n) { return n; }, s.profile);
  }
}

// Rigify's full rig holds every bone twice: the deforming ones are read.
TEST(OtherConventions, DeformingBonesComeBeforeTheirOriginals) {
  const auto list = nlohmann::json::parse(ReadWholeFile(TestDataPath("rigs/joint_names.json")));
  const JointNames names = NamesOf(list.at("rigify").at("joints"));
  const Rename marked[] = {[](const std::string& n) { return "ORG-" + n; },
                           [](const std::string& n) { return "DEF-" + n; }};
  RigFigure figure(names);
  RenameAll(marked[0], &figure);
  RigFigure deforming(names);
  RenameAll(marked[1], &deforming);
  const int first = figure.motion.rig.num_joints();
  for (RigJoint joint : deforming.motion.rig.joints) {
    if (joint.parent >= 0) joint.parent += first;
    figure.motion.rig.joints.push_back(joint);
  }
  figure.Rest();
  ExpectMap(figure, names, marked[1], "rigify");
}

TEST(OtherConventions, TwoFiguresOfOneNamingAreTold) {
  RigFigure figure(MixamoNames(3)), other(MixamoNames(3));
  const int first = figure.motion.rig.num_joints();
  for (RigJoint joint : other.motion.rig.joints) {
    if (joint.parent >= 0) joint.parent += first;
    figure.motion.rig.joints.push_back(joint);
  }
  figure.Rest();
  const RigFacts facts = Recognise(figure.motion, {}, "f");
  EXPECT_EQ(facts.map.root, 0);
  const auto& notes = facts.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("2 figures") != std::string::npos;
  }));
}

// In 3ds Max' own bipeds the thighs hang from the first spine bone: that is the root then.
TEST(OtherConventions, LegsMayHangFromTheFirstSpineBone) {
  const Skeleton biped = {"biped",
                          "Bip01 Pelvis; Bip01 Spine, Bip01 Spine1, Bip01 Spine2; Bip01 Neck; "
                          "Bip01 Head",
                          "Bip01 L Clavicle, Bip01 L UpperArm, Bip01 L Forearm, Bip01 L Hand, "
                          "Bip01 L Thigh, Bip01 L Calf, Bip01 L Foot",
                          " L ", " R "};
  RigFigure figure(NamesOf(biped));
  Rig& rig = figure.motion.rig;
  const int spine = rig.Find("Bip01 Spine");
  for (const char* thigh : {"Bip01 L Thigh", "Bip01 R Thigh"}) {
    RigJoint& joint = rig.joints[static_cast<size_t>(rig.Find(thigh))];
    joint.offset -= rig.joints[static_cast<size_t>(spine)].offset;
    joint.parent = spine;
  }
  figure.Rest();
  const RigFacts facts = Recognise(figure.motion, {}, "f");
  EXPECT_EQ(facts.map.profile, "biped");
  EXPECT_EQ(facts.map.root, spine);
  EXPECT_EQ(facts.map.spine,
            (std::vector<int>{rig.Find("Bip01 Spine1"), rig.Find("Bip01 Spine2")}));
  EXPECT_EQ(facts.map.left.hip, rig.Find("Bip01 L Thigh"));
}

// Two figures of two conventions, each as complete as the other: the user has to say which.
TEST(OtherConventions, ATieIsRefusedByTheJointThatDiffers) {
  const Skeleton kinect = {
      "kinect", "PELVIS; SPINE_NAVAL, SPINE_CHEST; NECK; HEAD",
      "CLAVICLE_LEFT, SHOULDER_LEFT, ELBOW_LEFT, WRIST_LEFT, HIP_LEFT, KNEE_LEFT, ANKLE_LEFT",
      "LEFT", "RIGHT"};
  const Skeleton avatar = {
      "second_life", "mPelvis; mTorso, mChest; mNeck; mHead",
      "mCollarLeft, mShoulderLeft, mElbowLeft, mWristLeft, mHipLeft, mKneeLeft, mAnkleLeft", "Left",
      "Right"};
  RigFigure figure(NamesOf(kinect)), other(NamesOf(avatar));
  const int first = figure.motion.rig.num_joints();
  for (RigJoint joint : other.motion.rig.joints) {
    if (joint.parent >= 0) joint.parent += first;
    figure.motion.rig.joints.push_back(joint);
  }
  figure.Rest();
  std::string message;
  try {
    Recognise(figure.motion, {}, "f");
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(
      message.find("f: no human figure: left_shoulder may be 'SHOULDER_LEFT' (as 'kinect' has "
                   "it) or 'mShoulderLeft' (as 'second_life' has it); to map it by hand: "),
      std::string::npos)
      << message;
}

}  // namespace
}  // namespace retarget::io
