#include "io/recognition/recognise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "io/bvh/bvh.h"
#include "io/recognition/joint_profiles.h"
#include "model/geometry/so3.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

using Names = std::map<std::string, std::string>;  // the project's name -> the rig's

const char* const kSides[] = {"left", "right"};

// A figure of 1.70 m in a T-pose: cm, Y up, facing +Z. `names` needs root, head, spine0.. and both
// sides' limbs; neck and clavicles are made where they have a name.
class Figure {
 public:
  explicit Figure(const Names& names) : names_(names) {
    motion.frame_time = 0.01;
    Add("root", -1, {0, 93, 0});
    AddTrunk();
    for (int side = 0; side < 2; ++side) AddLimbs(kSides[side], side == 0 ? 1 : -1);
    RigFrame frame;
    for (const RigJoint& joint : motion.rig.joints) {
      frame.translation.push_back(joint.offset);
      frame.rotation.push_back(Quat::Identity());
    }
    motion.frames.push_back(frame);
  }

  int Index(const std::string& name) const { return motion.rig.Find(names_.at(name)); }

  // A copy of the first frame with both arms turned down by so many degrees.
  RigFrame ArmsLowered(double degrees) const {
    RigFrame frame = motion.frames.front();
    frame.rotation[Index("left_shoulder")] = ExpSo3(Vec3(0, 0, -degrees * kDegree));
    frame.rotation[Index("right_shoulder")] = ExpSo3(Vec3(0, 0, degrees * kDegree));
    return frame;
  }

  void Scale(double factor) {
    for (RigJoint& joint : motion.rig.joints) {
      joint.offset *= factor;
      if (joint.end_site) *joint.end_site *= factor;
    }
    for (RigFrame& frame : motion.frames) {
      for (Vec3& translation : frame.translation) translation *= factor;
    }
  }

  RigMotion motion;

 private:
  bool Has(const std::string& name) const { return names_.contains(name); }

  int Add(const std::string& name, int parent, const Vec3& offset) {
    RigJoint joint;
    joint.name = names_.at(name);
    joint.parent = parent;
    joint.offset = offset;
    motion.rig.joints.push_back(joint);
    return motion.rig.num_joints() - 1;
  }

  void AddTrunk() {
    int num_spine = 0, at = 0;
    while (Has("spine" + std::to_string(num_spine))) ++num_spine;
    for (int n = 0; n < num_spine; ++n) {
      at = Add("spine" + std::to_string(n), at, {0, 40.0 / (num_spine + 1), 0});
    }
    chest_ = at;
    if (Has("neck")) at = Add("neck", at, {0, 15, 0});
    at = Add("head", at, {0, Has("neck") ? 10.0 : 25.0, 0});
    motion.rig.joints[at].end_site = Vec3(0, 20, 0);
  }

  void AddLimbs(const std::string& side, double x) {
    int at = chest_;
    if (Has(side + "_clavicle")) at = Add(side + "_clavicle", at, {3 * x, 10, 0});
    at = Add(side + "_shoulder", at, {15 * x, Has(side + "_clavicle") ? 0.0 : 10.0, 0});
    at = Add(side + "_elbow", at, {28 * x, 0, 0});
    at = Add(side + "_wrist", at, {25 * x, 0, 0});
    motion.rig.joints[at].end_site = Vec3(18 * x, 0, 0);
    at = Add(side + "_hip", 0, {9 * x, -6, 0});
    at = Add(side + "_knee", at, {0, -41, 0});
    at = Add(side + "_ankle", at, {0, -39, 0});
    motion.rig.joints[at].end_site = Vec3(0, -5, 15);
  }

  Names names_;
  int chest_ = 0;
};

Names ClassicNames() {
  Names names = {{"root", "Hips"},
                 {"spine0", "Chest"},
                 {"spine1", "Chest2"},
                 {"neck", "Neck"},
                 {"head", "Head"}};
  for (const auto& [side, word] : {std::pair("left_", "Left"), std::pair("right_", "Right")}) {
    for (const auto& [part, name] :
         {std::pair("clavicle", "Collar"), std::pair("shoulder", "Shoulder"),
          std::pair("elbow", "Elbow"), std::pair("wrist", "Wrist"), std::pair("hip", "Hip"),
          std::pair("knee", "Knee"), std::pair("ankle", "Ankle")}) {
      names[std::string(side) + part] = std::string(word) + name;
    }
  }
  return names;
}

std::string Message(const RigMotion& motion, const RecogniseOptions& options = {}) {
  try {
    Recognise(motion, options, "f.bvh");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool HasNote(const RigFacts& facts, const std::string& part) {
  return std::any_of(facts.notes.begin(), facts.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// Every joint by the project's name.
Names BonesOf(const RigFacts& facts, const RigMotion& motion) {
  return nlohmann::json::parse(MapJson(facts, motion)).at("joints").get<Names>();
}

TEST(RecogniseTest, FigureInEveryUnit) {
  for (const auto& [unit, metres] :
       {std::pair("m", 1.0), std::pair("cm", 0.01), std::pair("mm", 0.001), std::pair("dm", 0.1),
        std::pair("in", 0.0254), std::pair("cmu", 0.0254 / 0.45)}) {
    Figure figure(ClassicNames());
    figure.Scale(0.01 / metres);
    const RigFacts facts = Recognise(figure.motion, {}, "f.bvh");
    EXPECT_EQ(facts.unit_name, unit);
    EXPECT_DOUBLE_EQ(facts.metres_per_unit, metres);
    // By hand: leg, hip drop, two of three equal parts of 40 cm, chest to neck, neck, head.
    EXPECT_NEAR(facts.stature, (0.80 + 0.06 + 0.8 / 3 + 0.15 + 0.10 + 0.20) / (1 - 0.039), 1e-9);
    EXPECT_EQ(facts.up, 'y');
    EXPECT_TRUE(facts.notes.empty()) << facts.notes.front();
    EXPECT_EQ(facts.t_pose_frames, std::vector<int>{0});
  }
}

TEST(RecogniseTest, HeadWithoutEndUsesTheTable) {
  Figure figure(ClassicNames());
  figure.motion.rig.joints[figure.Index("head")].end_site.reset();
  const RigFacts facts = Recognise(figure.motion, {}, "f.bvh");
  EXPECT_NEAR(facts.stature, (0.80 + 0.06 + 0.8 / 3 + 0.15 + 0.10) / (1 - 0.039 - 0.130), 1e-9);
}

TEST(RecogniseTest, ImplausibleHeightNeedsUnits) {
  Figure figure(ClassicNames());
  figure.Scale(7);  // 11.5 m in cm, 29 m in inches, 1.2 m in mm: only mm is plausible
  EXPECT_EQ(Recognise(figure.motion, {}, "f.bvh").unit_name, "mm");
  figure.Scale(3.0 / 7);
  EXPECT_NE(Message(figure.motion).find("f.bvh: the figure is 49"), std::string::npos)
      << Message(figure.motion);
  EXPECT_NE(Message(figure.motion).find("ClipOptions::units"), std::string::npos);
  const RigFacts facts = Recognise(figure.motion, {.metres_per_unit = 0.0033, .up = {}}, "f.bvh");
  EXPECT_EQ(facts.unit_name, "0.0033");
  EXPECT_NEAR(facts.stature, 1.623, 0.01);
}

// In every pair of units in which a figure is a human, the one that makes an adult is meant.
TEST(RecogniseTest, AnAdultComesBeforeAChild) {
  Figure figure(ClassicNames());
  const double height = Recognise(figure.motion, {}, "f.bvh").stature;
  int checked = 0;
  for (const auto& [unit, metres] : {std::pair("m", 1.0),
                                     {"cm", 0.01},
                                     {"mm", 0.001},
                                     {"dm", 0.1},
                                     {"in", 0.0254},
                                     {"cmu", 0.0254 / 0.45}}) {
    for (double stature = 1.42; stature < 2.1; stature += 0.04) {
      Figure adult(ClassicNames());
      adult.Scale(0.01 * stature / height / metres);
      const RigFacts facts = Recognise(adult.motion, {}, "f.bvh");
      EXPECT_EQ(facts.unit_name, unit) << stature;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 6 * 17);
}

// A stature that is given settles the unit, listed or not, where no unit makes an adult.
TEST(RecogniseTest, AGivenStatureSettlesTheUnit) {
  RecogniseOptions options;
  options.stature = 1.62;
  for (const double scale : {0.003, 0.02, 0.03, 3.0, 30.0, 2000.0}) {
    Figure figure(ClassicNames());
    figure.Scale(scale);
    const RigFacts facts = Recognise(figure.motion, options, "f.bvh");
    const double cm = Recognise(Figure(ClassicNames()).motion, {}, "f.bvh").stature;
    EXPECT_NEAR(facts.stature, 1.62, 1e-9) << scale;
    EXPECT_NEAR(facts.metres_per_unit, 0.01 / scale * 1.62 / cm, 1e-9) << scale;
    EXPECT_TRUE(HasNote(facts, "the unit is taken from its stature"));
    EXPECT_FALSE(HasNote(facts, "is unusual"));
  }
  // A child's, in a unit that is listed.
  options.stature = 1.05;
  Figure child(ClassicNames());
  child.Scale(0.62);
  EXPECT_EQ(Recognise(child.motion, options, "f.bvh").unit_name, "cm");
  // An adult's unit is known: the body is scaled, not the file.
  options.stature = 1.3;
  EXPECT_EQ(Recognise(Figure(ClassicNames()).motion, options, "f.bvh").unit_name, "cm");
}

TEST(RecogniseTest, LimbsWithoutLengthAreRefused) {
  for (const auto& [joint, limb] :
       {std::pair("left_elbow", "the left upper arm has no length: 'LeftShoulder' and 'LeftElbow'"),
        {"right_wrist", "the right forearm has no length: 'RightElbow' and 'RightWrist'"},
        {"left_knee", "the left thigh has no length: 'LeftHip' and 'LeftKnee'"},
        {"right_ankle", "the right shin has no length: 'RightKnee' and 'RightAnkle'"}}) {
    Figure figure(ClassicNames());
    const int at = figure.Index(joint);
    figure.motion.rig.joints[at].offset.setZero();
    figure.motion.frames[0].translation[at].setZero();
    EXPECT_EQ(Message(figure.motion),
              std::string("f.bvh: ") + limb + " stand in one place, expected a bone between them");
  }
}

TEST(RecogniseTest, OptionsWin) {
  Figure figure(ClassicNames());
  const RigFacts facts = Recognise(figure.motion, {.metres_per_unit = 0.02, .up = 'z'}, "f.bvh");
  EXPECT_EQ(facts.metres_per_unit, 0.02);
  EXPECT_EQ(facts.up, 'z');
  EXPECT_TRUE(HasNote(facts, "stature"));
  EXPECT_TRUE(HasNote(facts, "seldom stands along +z"));
  EXPECT_NE(Message(figure.motion, {.metres_per_unit = -1, .up = {}}), "");
  EXPECT_NE(Message(figure.motion, {.metres_per_unit = {}, .up = 'x'}), "");
}

TEST(RecogniseTest, UpAxisFromTheMotion) {
  Figure figure(ClassicNames());
  figure.motion.frames[0].rotation[0] = ExpSo3(Vec3(kPi / 2, 0, 0));  // y to z
  EXPECT_EQ(Recognise(figure.motion, {}, "f.bvh").up, 'z');
}

// On its side, or face up with the legs hanging, no axis is told by the motion.
TEST(RecogniseTest, LyingFigureTellsUpByItsOffsets) {
  for (const Vec3& lying : {Vec3(0, 0, 100), Vec3(40, 20, 95), Vec3(0, 30, -92)}) {
    Figure figure(ClassicNames());
    figure.motion.frames[0].rotation[0] =
        ExpSo3(Vec3(10 * kDegree, 0, 0)) * ExpSo3(lying * kDegree);
    const RigFacts facts = Recognise(figure.motion, {}, "f.bvh");
    EXPECT_EQ(facts.up, 'y') << lying.transpose();
    EXPECT_TRUE(HasNote(facts, "seldom stands along +y"));
    EXPECT_EQ(Recognise(figure.motion, {.metres_per_unit = {}, .up = 'z'}, "f.bvh").up, 'z');
  }
}

// Thighs raised and shins folded under them: the toes point backwards on a sound figure.
TEST(RecogniseTest, LegsDrawnUpAreNotMirrored) {
  Figure figure(ClassicNames());
  for (const std::string side : {"left", "right"}) {
    figure.motion.frames[0].rotation[figure.Index(side + "_hip")] = ExpSo3(Vec3(-1.0, 0, 0));
    figure.motion.frames[0].rotation[figure.Index(side + "_knee")] = ExpSo3(Vec3(2.4, 0, 0));
    figure.motion.frames[0].rotation[figure.Index(side + "_ankle")] = ExpSo3(Vec3(0.9, 0, 0));
  }
  EXPECT_FALSE(HasNote(Recognise(figure.motion, {}, "f.bvh"), "exchanged"));
}

TEST(RecogniseTest, NotesMirroredAndUnequalFigures) {
  Names exchanged;
  for (const auto& [key, name] : ClassicNames()) {
    const bool left = key.starts_with("left_"), right = key.starts_with("right_");
    const std::string part = key.substr(key.find('_') + 1);
    exchanged[left ? "right_" + part : right ? "left_" + part : key] = name;
  }
  EXPECT_TRUE(HasNote(Recognise(Figure(exchanged).motion, {}, "f.bvh"), "exchanged"));
  Figure figure(ClassicNames());
  figure.motion.frames[0].translation[figure.Index("left_wrist")] *= 0.7;
  EXPECT_TRUE(HasNote(Recognise(figure.motion, {}, "f.bvh"), "forearms differ"));
}

TEST(RecogniseTest, TPoseAtTheStart) {
  Figure figure(ClassicNames());
  auto& frames = figure.motion.frames;
  for (int f = 0; f < 10; ++f) frames.push_back(figure.ArmsLowered(80));
  RigFacts facts = Recognise(figure.motion, {}, "f.bvh");
  EXPECT_EQ(facts.t_pose_frames, std::vector<int>{0});
  EXPECT_TRUE(HasNote(facts, "ClipOptions::skip_frames 1 "));
  frames.insert(frames.begin(), frames.front());
  EXPECT_EQ(Recognise(figure.motion, {}, "f.bvh").t_pose_frames, (std::vector<int>{0, 1}));
}

TEST(RecogniseTest, BlendedTPoseIsToldByItsLeap) {
  Figure figure(ClassicNames());
  auto& frames = figure.motion.frames;
  const RigFrame resting = figure.ArmsLowered(80);
  frames = {figure.ArmsLowered(30), figure.ArmsLowered(55)};
  frames.insert(frames.end(), 10, resting);
  RigFacts facts = Recognise(figure.motion, {}, "f.bvh");  // 2500 degrees per second
  EXPECT_EQ(facts.t_pose_frames, std::vector<int>{0});
  EXPECT_TRUE(HasNote(facts, "ClipOptions::skip_frames 2 "));
  figure.motion.frame_time = 0.1;  // the same as a movement
  EXPECT_TRUE(Recognise(figure.motion, {}, "f.bvh").t_pose_frames.empty());
}

TEST(RecogniseTest, AClipOfNothingButTPoseHasNoCalibration) {
  Figure figure(ClassicNames());
  figure.motion.frames.resize(20, figure.motion.frames.front());
  EXPECT_TRUE(Recognise(figure.motion, {}, "f.bvh").t_pose_frames.empty());
}

TEST(RecogniseTest, ShapeAloneWithoutNames) {
  const Figure named(ClassicNames());
  RigMotion motion = named.motion;
  for (int j = 0; j < motion.rig.num_joints(); ++j) motion.rig.joints[j].name = std::to_string(j);
  const RigFacts facts = Recognise(motion, {}, "f.bvh");
  const JointMap expected = Recognise(named.motion, {}, "f.bvh").map;
  EXPECT_EQ(facts.map.profile, "topology");
  EXPECT_TRUE(HasNote(facts, "shape alone"));
  EXPECT_EQ(facts.map.root, expected.root);
  EXPECT_EQ(facts.map.spine, expected.spine);
  EXPECT_EQ(facts.map.neck, expected.neck);
  EXPECT_EQ(facts.map.head, expected.head);
  for (const auto side : {&JointMap::left, &JointMap::right}) {
    EXPECT_EQ((facts.map.*side).clavicle, (expected.*side).clavicle);
    EXPECT_EQ((facts.map.*side).shoulder, (expected.*side).shoulder);
    EXPECT_EQ((facts.map.*side).wrist, (expected.*side).wrist);
    EXPECT_EQ((facts.map.*side).hip, (expected.*side).hip);
    EXPECT_EQ((facts.map.*side).ankle, (expected.*side).ankle);
  }
}

TEST(RecogniseTest, ShapeRefusesWhatItCannotTell) {
  Figure figure(ClassicNames());
  RigMotion& motion = figure.motion;
  for (RigJoint& joint : motion.rig.joints) joint.name = "j";
  for (const char* foot : {"left_ankle", "right_ankle"}) {
    // Without feet there is no left and right.
    motion.rig.joints[Figure(ClassicNames()).Index(foot)].end_site.reset();
  }
  EXPECT_NE(Message(motion), "");
}

TEST(RecogniseTest, RefusalNamesWhatIsMissing) {
  Figure figure(ClassicNames());
  figure.motion.rig.joints[figure.Index("left_knee")].name = "LeftKne";
  figure.motion.rig.joints[figure.Index("right_elbow")].parent = 0;  // nor is the shape a human's
  RecogniseOptions options;
  options.words.map_by_hand = "`draw {}`";
  EXPECT_EQ(Message(figure.motion, options),
            "f.bvh: no human figure: nothing plays left_knee (nearest convention 'classic'); the "
            "names nearest to left_knee are 'LeftKne', 'LeftAnkle', 'LeftHip'; to map it by hand: "
            "`draw f.bvh`");
}

TEST(RecogniseTest, NamesInTheWrongPlaceAreRefused) {
  Figure figure(ClassicNames());
  figure.motion.rig.joints[figure.Index("right_elbow")].parent = 0;
  EXPECT_NE(Message(figure.motion)
                .find("f.bvh: no human figure: its names follow 'classic', but 'RightElbow' does "
                      "not hang from 'RightShoulder'; to map it by hand: "),
            std::string::npos);
}

// A wrist that hangs elsewhere (the handle of a control rig) is no wrist: a virtual one is made.
TEST(RecogniseTest, WhatIsNotRequiredAndHangsElsewhereIsLeftOut) {
  Figure figure(ClassicNames());
  figure.motion.rig.joints[figure.Index("right_wrist")].parent = 0;
  const RigFacts facts = Recognise(figure.motion, {}, "f.bvh");
  EXPECT_EQ(facts.map.right.wrist, -1);
  EXPECT_EQ(facts.virtual_joints, std::vector<std::string>{"right_wrist"});
  EXPECT_TRUE(HasNote(facts, "'RightWrist' hangs where no human has it"));
  EXPECT_TRUE(HasNote(facts, "no bone plays right_wrist: virtual"));
}

TEST(RecogniseTest, EmptyAndFlatMotionsAreRefused) {
  EXPECT_NE(Message(RigMotion{}), "");
  Figure figure(ClassicNames());
  figure.Scale(0);
  EXPECT_NE(Message(figure.motion).find("one point"), std::string::npos);
}

TEST(RecogniseTest, ChestIsApartFromNeckAndRoot) {
  Figure figure(ClassicNames());
  JointMap map = Recognise(figure.motion, {}, "f.bvh").map;
  EXPECT_EQ(ChestBone(figure.motion, map), figure.Index("spine1"));
  figure.motion.frames[0].translation[figure.Index("neck")].setZero();
  EXPECT_EQ(ChestBone(figure.motion, map), figure.Index("spine0"));
  figure.motion.frames[0].translation[figure.Index("spine0")].setZero();
  EXPECT_EQ(ChestBone(figure.motion, map), -1);  // none is
  map.spine.clear();
  EXPECT_EQ(ChestBone(figure.motion, map), -1);
}

TEST(RecogniseTest, Units) {
  EXPECT_DOUBLE_EQ(*ParseUnits("m"), 1);
  EXPECT_DOUBLE_EQ(*ParseUnits("cm"), 0.01);
  EXPECT_DOUBLE_EQ(*ParseUnits("mm"), 0.001);
  EXPECT_DOUBLE_EQ(*ParseUnits("dm"), 0.1);
  EXPECT_DOUBLE_EQ(*ParseUnits("in"), 0.0254);
  EXPECT_NEAR(*ParseUnits("cmu"), 0.0564444, 1e-7);
  EXPECT_DOUBLE_EQ(*ParseUnits("1.35"), 1.35);
  for (const char* text : {"", "ft", "0", "-1", "nan", "inf", "1e999", "1 m", "cm "}) {
    EXPECT_FALSE(ParseUnits(text)) << text;
  }
}

TEST(RecogniseTest, JsonSurvivesNamesThatAreNoText) {
  Figure figure(ClassicNames());
  figure.motion.rig.joints.push_back({"\xFF\x01", 0, Vec3::Zero(), {}});
  figure.motion.frames[0].translation.push_back(Vec3::Zero());
  figure.motion.frames[0].rotation.push_back(Quat::Identity());
  const RigFacts facts = Recognise(figure.motion, {}, "f.bvh");
  const auto json = nlohmann::json::parse(MapJson(facts, figure.motion));
  EXPECT_EQ(json.at("unmapped").size(), 1u);
  EXPECT_EQ(json.at("joints").at("waist"), "Chest");
  EXPECT_EQ(json.at("units"), 0.01);
  EXPECT_EQ(json.at("fps"), 100);
  EXPECT_EQ(json.at("t_pose_frames"), nlohmann::json::array({0}));
  EXPECT_EQ(MapTable(facts, figure.motion).find('\x01'), std::string::npos);
}

// --- Conventions: the published names, as a list that this code does not read, are the oracle ---

TEST(RecogniseTest, EveryPublishedConvention) {
  const Names profiles = {{"mixamo/rpm/humanik/lafan1", "mixamo"},
                          {"cmu_cgspeed", "cmu"},
                          {"classic_bvh/xsens", "classic"},
                          {"rokoko_newton", "rokoko"},
                          {"soma", "soma"},
                          {"vrm/unity/godot", "vrm"},
                          {"vroid", "vroid"},
                          {"unreal", "unreal"},
                          {"smpl", "smpl"},
                          {"smpl_fbx", "smpl"},
                          {"biped", "biped"},
                          {"reallusion_cc", "reallusion"},
                          {"daz_poser", "daz"},
                          {"rigify", "rigify"},
                          {"auto_rig_pro", "auto_rig_pro"},
                          {"project", "project"}};
  const Names prefixes = {{"mixamo/rpm/humanik/lafan1", "mixamorig1:"},
                          {"vroid", "J_Bip_"},
                          {"smpl_fbx", "m_avg_"},
                          {"biped", "Bip01 "},
                          {"reallusion_cc", "CC_Base_"},
                          {"rigify", "DEF-"}};
  const auto list = nlohmann::json::parse(ReadWholeFile(TestDataPath("rigs/joint_names.json")));
  EXPECT_EQ(list.size(), profiles.size());
  for (const auto& [convention, entry] : list.items()) {
    for (const bool prefixed : {false, true}) {
      Names names;
      for (const auto& [key, name] : entry.at("joints").items()) {
        const std::string ours = key.starts_with("L_")   ? "left_" + key.substr(2)
                                 : key.starts_with("R_") ? "right_" + key.substr(2)
                                                         : key;
        const auto prefix = prefixes.find(convention);
        names[ours] =
            (prefixed && prefix != prefixes.end() ? prefix->second : "") + name.get<std::string>();
      }
      const Figure figure(names);
      const RigFacts facts = Recognise(figure.motion, {}, convention);
      EXPECT_EQ(facts.map.profile, profiles.at(convention));
      Names bones = BonesOf(facts, figure.motion);
      EXPECT_EQ(bones.at("waist"), names.at("spine0"));
      EXPECT_EQ(facts.map.spine.size(), names.size() - 17) << convention;
      for (const auto& [joint, bone] : names) {
        if (joint.starts_with("spine")) continue;
        EXPECT_EQ(bones[joint], bone) << convention;
      }
    }
  }
}

// --- Real files ---

struct Expected {
  const char* file;
  const char* profile;
  const char* unit;
  char up;
  double stature;
  int frames;
  double rate;
  int num_t_pose;
  const char* root;
  const char* waist;
  const char* chest;
  const char* neck;
  const char* left_shoulder;
  const char* left_hand;
  const char* left_ankle;
  const char* left_toe;
};

// clang-format off
const Expected kExpected[] = {
  {"clips/bandai_walk_normal_001.bvh", "bandai", "cm", 'y', 1.56, 195, 30, 0,
    "Hips", "Spine", "Chest", "Neck", "UpperArm_L", "", "Foot_L", "Toes_L"},
  {"clips/bandai_respond_normal_001.bvh", "bandai", "cm", 'y', 1.45, 106, 30, 0,
    "Hips", "Spine", "Chest", "Neck", "UpperArm_L", "", "Foot_L", "Toes_L"},
  {"clips/cmu_12_01_walk.bvh", "cmu", "cmu", 'y', 1.46, 524, 120, 1,
    "Hips", "LowerBack", "Spine", "Neck", "LeftArm", "LeftHandIndex1", "LeftFoot", "LeftToeBase"},
  {"clips/cmu_131_01.bvh", "cmu_3dsmax", "cmu", 'y', 1.45, 994, 120, 0,
    "Hips", "lowerback", "Chest", "lowerneck", "LeftShoulder", "LFingers", "LeftAnkle",
    "LeftToe"},
  {"clips/cmu_131_01_metres.bvh", "cmu_3dsmax", "m", 'y', 1.45, 995, 120, 0,
    "Hips", "lowerback", "Chest", "lowerneck", "LeftShoulder", "LFingers", "LeftAnkle",
    "LeftToe"},
  {"clips/cmu_16_15.bvh", "cmu_asf", "cm", 'y', 1.64, 471, 120, 0,
    "root", "lowerback", "thorax", "lowerneck", "lhumerus", "lhand", "lfoot", "ltoes"},
  {"clips/fair_dab.bvh", "mixamo", "in", 'z', 1.17, 339, 30, 42,
    "Hips", "Spine", "Spine3", "Neck", "LeftArm", "LeftHandEnd", "LeftFoot", "LeftToeBase"},
  {"clips/iclone_007_01_walk.bvh", "reallusion", "cm", 'y', 1.94, 157, 60, 0,
    "CC_Base_Hip", "CC_Base_Waist", "CC_Base_Spine02", "CC_Base_NeckTwist01",
    "CC_Base_L_Upperarm", "CC_Base_L_Mid1", "CC_Base_L_Foot", "CC_Base_L_ToeBase"},
  {"clips/lafan_dance1_subject2.bvh", "mixamo", "cm", 'y', 1.86, 3945, 30, 0,
    "Hips", "Spine", "Spine2", "Neck", "LeftArm", "", "LeftFoot", "LeftToe"},
  {"clips/mixamo_freebvh.bvh", "mixamo", "cm", 'y', 1.77, 69, 30, 0,
    "mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine2", "mixamorig:Neck",
    "mixamorig:LeftArm", "mixamorig:LeftHandMiddle1", "mixamorig:LeftFoot",
    "mixamorig:LeftToeBase"},
  {"clips/mocapbank.bvh", "classic", "cm", 'y', 1.67, 455, 30, 0,
    "Hips", "Chest", "Chest2", "Neck", "LeftShoulder", "", "LeftAnkle", ""},
  {"clips/xsens_stand.bvh", "classic", "cm", 'y', 1.80, 2752, 239, 0,
    "Hips", "Chest", "Chest4", "Neck", "LeftShoulder", "", "LeftAnkle", "LeftToe"},
  {"odd_bvh/mixed_rotation_orders.bvh", "mixamo", "in", 'z', 1.66, 75, 30, 0,
    "Hips", "Spine", "Spine3", "Neck", "LeftArm", "", "LeftFoot", "LeftToeBase"},
  {"odd_bvh/standard_skeleton_1frame.bvh", "mixamo", "in", 'z', 1.54, 1, 120, 1,
    "Hips", "Spine", "Spine3", "Neck", "LeftArm", "", "LeftFoot", "LeftToeBase"},
  {"odd_bvh/lafan_zero_frame0.bvh", "mixamo", "cm", 'y', 1.99, 1, 30, 1,
    "Hips", "Spine", "Spine2", "Neck", "LeftArm", "", "LeftFoot", "LeftToe"},
};
// clang-format on

void CheckFile(const Expected& expected, const std::string& path) {
  SCOPED_TRACE(path);
  const BvhFile file = ReadBvh(path);
  const RigFacts facts = Recognise(file.motion, {}, path);
  EXPECT_EQ(facts.map.profile, expected.profile);
  EXPECT_EQ(facts.unit_name, expected.unit);
  EXPECT_EQ(facts.up, expected.up);
  EXPECT_NEAR(facts.stature, expected.stature, 0.006);
  EXPECT_EQ(file.motion.num_frames(), expected.frames);
  EXPECT_DOUBLE_EQ(1 / file.motion.frame_time, expected.rate);
  EXPECT_EQ(static_cast<int>(facts.t_pose_frames.size()), expected.num_t_pose);
  EXPECT_FALSE(HasNote(facts, "exchanged"));
  EXPECT_FALSE(HasNote(facts, "differ"));
  EXPECT_FALSE(HasNote(facts, "seldom"));
  Names bones = BonesOf(facts, file.motion);
  EXPECT_EQ(bones["root"], expected.root);
  EXPECT_EQ(bones["waist"], expected.waist);
  EXPECT_EQ(bones["chest"], expected.chest);
  EXPECT_EQ(bones["neck"], expected.neck);
  EXPECT_EQ(bones["left_shoulder"], expected.left_shoulder);
  EXPECT_EQ(bones["left_hand"], expected.left_hand);
  EXPECT_EQ(bones["left_ankle"], expected.left_ankle);
  EXPECT_EQ(bones["left_toe"], expected.left_toe);
}

TEST(RecogniseTest, RealClips) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const Expected& expected : kExpected) {
    CheckFile(expected, SharedPath("data/") + expected.file);
  }
}

TEST(RecogniseTest, RealPairs) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const auto& [trial, frames] : {std::pair("02", 2101), std::pair("04", 1871),
                                      std::pair("05", 1678), std::pair("10", 1197)}) {
    for (const std::string subject : {"60", "61"}) {
      const Expected expected = {"",    "daz",     "m",     'y',    1.33,     frames,  120,     1,
                                 "hip", "abdomen", "chest", "neck", "lShldr", "lMid1", "lFoot", ""};
      const std::string path =
          SharedPath("data/pairs/cmu_salsa_") + trial + "/" + subject + "_" + trial + "_scaled.bvh";
      CheckFile(expected, path);
      const BvhFile file = ReadBvh(path);
      const RigFacts facts = Recognise(file.motion, {}, path);
      EXPECT_TRUE(HasNote(facts, "ClipOptions::units"));
      // Its filter swings back in frames 5 and 6 (speeds of the upper arms, read off the file).
      EXPECT_TRUE(HasNote(facts, "ClipOptions::skip_frames 7 "));
    }
  }
}

TEST(RecogniseTest, ToysAreReadButRefused) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const std::string name : {"full_precision_frame_time", "rotation_first_root",
                                 "sinusoidal_no_endsite", "test_simple"}) {
    const BvhFile file = ReadBvh(SharedPath("data/odd_bvh/") + name + ".bvh");
    EXPECT_TRUE(file.warnings.empty());
    const std::string message = Message(file.motion);
    EXPECT_NE(message.find("no human figure: it has "), std::string::npos) << message;
    EXPECT_NE(message.find(", a human at least 9; to map it by hand: "), std::string::npos);
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

// Renamed joints: the shape alone must find the same limbs as the names.
TEST(RecogniseTest, ShapeAgreesWithNamesOnRealClips) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const std::string name :
       {"bandai_walk_normal_001", "lafan_dance1_subject2", "mocapbank", "xsens_stand"}) {
    SCOPED_TRACE(name);
    RigMotion motion = ReadBvh(SharedPath("data/clips/") + name + ".bvh").motion;
    const JointMap expected = Recognise(motion, {}, name).map;
    for (RigJoint& joint : motion.rig.joints) joint.name = "bone";
    const JointMap map = Recognise(motion, {}, name).map;
    EXPECT_EQ(map.profile, "topology");
    EXPECT_EQ(map.root, expected.root);
    for (const auto side : {&JointMap::left, &JointMap::right}) {
      EXPECT_EQ((map.*side).shoulder, (expected.*side).shoulder);
      EXPECT_EQ((map.*side).elbow, (expected.*side).elbow);
      EXPECT_EQ((map.*side).wrist, (expected.*side).wrist);
      EXPECT_EQ((map.*side).hip, (expected.*side).hip);
      EXPECT_EQ((map.*side).knee, (expected.*side).knee);
      EXPECT_EQ((map.*side).ankle, (expected.*side).ankle);
    }
  }
}

// CMU's collar bones are as long as its forearms: without names either could be meant.
TEST(RecogniseTest, ShapeRefusesAmbiguousArms) {
  SKIP_WITHOUT_SHARED_DATA();
  for (const std::string name : {"cmu_12_01_walk", "cmu_131_01"}) {
    RigMotion motion = ReadBvh(SharedPath("data/clips/") + name + ".bvh").motion;
    for (RigJoint& joint : motion.rig.joints) joint.name = "bone";
    EXPECT_NE(Message(motion), "");
  }
}

}  // namespace
}  // namespace retarget::io
