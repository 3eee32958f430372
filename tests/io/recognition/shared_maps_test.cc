// Every motion file of the shared reference data: which bone plays which joint, as a person reads
// it from the file, or why the file is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "io/bvh/bvh.h"
#include "io/clip_file.h"
#include "io/recognition/recognise.h"
#include "model/rig/points.h"
#include "tests/test_data.h"

namespace retarget::io {
namespace {

// Bones between blanks; '-' where no bone plays the joint. The right side is the left with
// `left` at the beginning or end of every name exchanged for `right`.
struct Skeleton {
  const char* profile;
  const char* root;
  const char* spine;
  const char* chest;
  const char* neck;
  const char* head;
  const char* head_top;
  const char* side;  // clavicle shoulder elbow wrist hand hip knee ankle toe
  const char* left;
  const char* right;
};

// clang-format off
const Skeleton kBandai = {"bandai", "Hips", "Spine Chest", "Chest", "Neck", "Head", "-",
    "Shoulder_L UpperArm_L LowerArm_L Hand_L - UpperLeg_L LowerLeg_L Foot_L Toes_L", "_L", "_R"};
// Spine1 stands at the neck, so the chest is the bone below it.
const Skeleton kCmu = {"cmu", "Hips", "LowerBack Spine Spine1", "Spine", "Neck Neck1", "Head", "-",
    "LeftShoulder LeftArm LeftForeArm LeftHand LeftHandIndex1 LeftUpLeg LeftLeg LeftFoot "
    "LeftToeBase", "Left", "Right"};
// The hand's bones are called lhand (at the wrist) and LFingers.
const Skeleton kCmu3dsMax = {"cmu_3dsmax", "Hips", "lowerback Chest Chest2", "Chest",
    "lowerneck Neck", "Head", "-",
    "LeftCollar LeftShoulder LeftElbow LeftWrist LFingers LeftHip LeftKnee LeftAnkle LeftToe",
    "L", "R"};
const Skeleton kCmuAsf = {"cmu_asf", "root", "lowerback upperback thorax", "thorax",
    "lowerneck upperneck", "head", "-",
    "lclavicle lhumerus lradius lwrist lhand lfemur ltibia lfoot ltoes", "l", "r"};
const Skeleton kFair = {"mixamo", "Hips", "Spine Spine1 Spine2 Spine3", "Spine3", "Neck", "Head",
    "-", "LeftShoulder LeftArm LeftForeArm LeftHand LeftHandEnd LeftUpLeg LeftLeg LeftFoot "
    "LeftToeBase", "Left", "Right"};
const Skeleton kMotionBuilder = {"mixamo", "Hips", "Spine Spine1 Spine2 Spine3", "Spine3",
    "Neck Neck1", "Head", "-",
    "LeftShoulder LeftArm LeftForeArm LeftHand - LeftUpLeg LeftLeg LeftFoot LeftToeBase", "Left",
    "Right"};
const Skeleton kReallusion = {"reallusion", "CC_Base_Hip",
    "CC_Base_Waist CC_Base_Spine01 CC_Base_Spine02", "CC_Base_Spine02",
    "CC_Base_NeckTwist01 CC_Base_NeckTwist02", "CC_Base_Head", "-",
    "CC_Base_L_Clavicle CC_Base_L_Upperarm CC_Base_L_Forearm CC_Base_L_Hand CC_Base_L_Mid1 "
    "CC_Base_L_Thigh CC_Base_L_Calf CC_Base_L_Foot CC_Base_L_ToeBase", "_L_", "_R_"};
const Skeleton kLafan = {"mixamo", "Hips", "Spine Spine1 Spine2", "Spine2", "Neck", "Head", "-",
    "LeftShoulder LeftArm LeftForeArm LeftHand - LeftUpLeg LeftLeg LeftFoot LeftToe", "Left",
    "Right"};
const Skeleton kMixamo = {"mixamo", "mixamorig:Hips",
    "mixamorig:Spine mixamorig:Spine1 mixamorig:Spine2", "mixamorig:Spine2", "mixamorig:Neck",
    "mixamorig:Head", "mixamorig:HeadTop_End",
    "mixamorig:LeftShoulder mixamorig:LeftArm mixamorig:LeftForeArm mixamorig:LeftHand "
    "mixamorig:LeftHandMiddle1 mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot "
    "mixamorig:LeftToeBase", ":Left", ":Right"};
const Skeleton kMocapBank = {"classic", "Hips", "Chest Chest2", "Chest2", "Neck", "Head", "-",
    "LeftCollar LeftShoulder LeftElbow LeftWrist - LeftHip LeftKnee LeftAnkle -", "Left", "Right"};
const Skeleton kXsens = {"classic", "Hips", "Chest Chest2 Chest3 Chest4", "Chest4", "Neck", "Head",
    "-", "LeftCollar LeftShoulder LeftElbow LeftWrist - LeftHip LeftKnee LeftAnkle LeftToe",
    "Left", "Right"};
const Skeleton kDaz = {"daz", "hip", "abdomen chest", "chest", "neck", "head", "-",
    "lCollar lShldr lForeArm lHand lMid1 lThigh lShin lFoot -", "l", "r"};

const Skeleton kSoma = {"soma", "Hips", "Spine1 Spine2 Chest", "Chest", "Neck1 Neck2", "Head",
    "HeadEnd", "LeftShoulder LeftArm LeftForeArm LeftHand LeftHandMiddle1 LeftLeg LeftShin "
    "LeftFoot LeftToeBase", "Left", "Right"};
const Skeleton kUnreal = {"unreal", "pelvis", "spine_01 spine_02 spine_03", "spine_03", "neck_01",
    "head", "head_leaf", "clavicle_l upperarm_l lowerarm_l hand_l middle_01_l thigh_l calf_l foot_l "
    "ball_l", "_l", "_r"};

const std::map<std::string, const Skeleton*> kFiles = {
    {"clips/bandai_respond_normal_001.bvh", &kBandai},
    {"clips/bandai_walk_normal_001.bvh", &kBandai},
    {"clips/cmu_12_01_walk.bvh", &kCmu},
    {"clips/cmu_131_01.bvh", &kCmu3dsMax},
    {"clips/cmu_131_01_metres.bvh", &kCmu3dsMax},
    {"clips/cmu_16_15.bvh", &kCmuAsf},
    {"clips/fair_dab.bvh", &kFair},
    {"clips/iclone_007_01_walk.bvh", &kReallusion},
    {"clips/lafan_dance1_subject2.bvh", &kLafan},
    {"clips/mixamo_freebvh.bvh", &kMixamo},
    {"clips/mocapbank.bvh", &kMocapBank},
    {"clips/xsens_stand.bvh", &kXsens},
    {"odd_bvh/lafan_zero_frame0.bvh", &kLafan},
    {"odd_bvh/mixed_rotation_orders.bvh", &kMotionBuilder},
    {"odd_bvh/soma_zero_frame0.bvh", &kSoma},
    {"odd_bvh/standard_skeleton_1frame.bvh", &kMotionBuilder},
    {"pairs/cmu_salsa_02/60_02_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_02/61_02_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_04/60_04_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_04/61_04_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_05/60_05_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_05/61_05_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_10/60_10_scaled.bvh", &kDaz},
    {"pairs/cmu_salsa_10/61_10_scaled.bvh", &kDaz}};

const std::map<std::string, const char*> kRefused = {
    {"odd_bvh/full_precision_frame_time.bvh", "no human figure: it has 2 joints"},
    {"odd_bvh/rotation_first_root.bvh", "no human figure: it has 4 joints"},
    {"odd_bvh/sinusoidal_no_endsite.bvh", "no human figure: it has 4 joints"},
    {"odd_bvh/test_simple.bvh", "no human figure: it has 2 joints"}};
// clang-format on

std::vector<std::string> SplitAtBlanks(const std::string& text) {
  std::stringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

class SharedMap {
 public:
  SharedMap(const RigMotion& motion, const RigFacts& facts) : rig_(motion.rig), map_(facts.map) {}

  std::string Bone(int joint) const {
    return joint < 0 ? "-" : rig_.joints[static_cast<size_t>(joint)].name;
  }
  std::vector<std::string> Bones(const std::vector<int>& joints) const {
    std::vector<std::string> names;
    for (const int joint : joints) names.push_back(Bone(joint));
    return names;
  }
  std::vector<std::string> Bones(const JointMap::Side& s) const {
    return Bones(std::vector<int>{s.clavicle, s.shoulder, s.elbow, s.wrist, s.hand, s.hip, s.knee,
                                  s.ankle, s.toe});
  }

 private:
  const Rig& rig_;
  const JointMap& map_;
};

void ExpectSkeleton(const Skeleton& expected, const RigMotion& motion, const RigFacts& facts) {
  const SharedMap map(motion, facts);
  EXPECT_EQ(facts.map.profile, expected.profile);
  EXPECT_EQ(map.Bone(facts.map.root), expected.root);
  EXPECT_EQ(map.Bones(facts.map.spine), SplitAtBlanks(expected.spine));
  EXPECT_EQ(map.Bone(ChestBone(motion, facts.map)), expected.chest);
  EXPECT_EQ(map.Bones(facts.map.neck), SplitAtBlanks(expected.neck));
  EXPECT_EQ(map.Bone(facts.map.head), expected.head);
  EXPECT_EQ(map.Bone(facts.map.head_top), expected.head_top);
  EXPECT_EQ(map.Bones(facts.map.left), SplitAtBlanks(expected.side));
  std::vector<std::string> right = SplitAtBlanks(expected.side);
  const std::string left_word = expected.left;
  for (std::string& name : right) {
    if (name == "-") continue;
    const size_t at =
        name.ends_with(left_word) ? name.size() - left_word.size() : name.find(left_word);
    if (name == "LFingers" || left_word != "L") {
      name.replace(at, left_word.size(), expected.right);
    } else {
      name.replace(name.find("Left"), 4, "Right");
    }
  }
  EXPECT_EQ(map.Bones(facts.map.right), right);
  EXPECT_TRUE(facts.virtual_joints.empty());
  EXPECT_GE(facts.confidence, 0.9);
}

TEST(SharedMaps, EveryFileIsMappedOrRefusedAsExpected) {
  SKIP_WITHOUT_SHARED_DATA();
  std::set<std::string> seen;
  for (const char* folder : {"clips", "odd_bvh", "pairs"}) {
    const std::string data = SharedPath("data/");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data + folder)) {
      if (entry.path().extension() != ".bvh") continue;
      const std::string file = entry.path().string().substr(data.size());
      SCOPED_TRACE(file);
      seen.insert(file);
      try {
        const BvhFile bvh = ReadBvh(data + file);
        const RigFacts facts = Recognise(bvh.motion, {}, file);
        const auto expected = kFiles.find(file);
        ASSERT_NE(expected, kFiles.end());
        ExpectSkeleton(*expected->second, bvh.motion, facts);
      } catch (const InputError& error) {
        const auto expected = kRefused.find(file);
        ASSERT_NE(expected, kRefused.end()) << error.what();
        EXPECT_NE(std::string(error.what()).find(expected->second), std::string::npos)
            << error.what();
      }
    }
  }
  EXPECT_EQ(seen.size(), kFiles.size() + kRefused.size());
}

// What is not BVH. Statures are the heights of the meshes, read off the files' own bounds; the
// Acclaim clip is the BVH's.
TEST(SharedMaps, CharactersAndAcclaimAreMappedOrRefusedAsExpected) {
  SKIP_WITHOUT_SHARED_DATA();
  const std::string data = SharedPath("data/");
  const struct {
    const char* file;
    const Skeleton* skeleton;
    double stature;
  } mapped[] = {{"characters/m2m_human-male.glb", &kUnreal, 1.83},
                {"characters/m2m_mixamo-sample-rig.glb", &kMixamo, 1.81},
                {"clips/cmu_16_15.amc", &kCmuAsf, 1.64}};
  for (const auto& expected : mapped) {
    SCOPED_TRACE(expected.file);
    std::string path = data + expected.file;
    if (path.ends_with(".amc")) path = data + "clips/cmu_16_15.asf:" + path;
    const ClipFile clip = ReadClipFile(path);
    const RigFacts facts =
        Recognise(clip.motion, {clip.metres_per_unit, clip.up, clip.map}, expected.file);
    ExpectSkeleton(*expected.skeleton, clip.motion, facts);
    EXPECT_NEAR(facts.stature, expected.stature, 0.03);
  }
  const auto refusal = [&](const std::string& file) -> std::string {
    ClipPath path = ParseClipPath(data + file);
    path.select.any_animation = true;
    const ClipFile clip = ReadClipFile(path);
    try {
      Recognise(clip.motion, {clip.metres_per_unit, clip.up, clip.map}, file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal("characters/Fox.glb").find("no human figure"), std::string::npos);
  EXPECT_NE(refusal("characters/rigged_simple.gltf").find("no human figure: it has 2 joints"),
            std::string::npos);
}

// Joints without names are told by their places: which is which stands in the mesh (x ahead, y up,
// z to the right), each limb from the trunk outwards.
TEST(SharedMaps, NamelessJointsAreToldByShape) {
  SKIP_WITHOUT_SHARED_DATA();
  const ClipFile clip = ReadClipFile(SharedPath("data/characters/cesium_man.gltf"));
  const RigFacts facts = Recognise(clip.motion, {clip.metres_per_unit, clip.up, clip.map}, "c");
  const PosedRig posed = PoseRig(clip.motion.rig, clip.motion.frames[0]);
  const auto at = [&](int joint) { return posed.position[static_cast<size_t>(joint)]; };
  const JointMap& map = facts.map;
  EXPECT_EQ(map.profile, "topology");
  EXPECT_NEAR(facts.facing / kDegree, -90, 20) << "the figure looks along +x of a Y-up world";
  for (const JointMap::Side* side : {&map.left, &map.right}) {
    EXPECT_GT(at(side->hip).y(), at(side->knee).y());
    EXPECT_GT(at(side->knee).y(), at(side->ankle).y());
    EXPECT_GT(at(side->shoulder).y(), at(side->hip).y());
  }
  EXPECT_GT(at(map.head).y(), at(map.left.shoulder).y());
  EXPECT_GT((at(map.left.shoulder) - at(map.right.shoulder)).norm(), 0.1);
  EXPECT_NEAR(facts.stature, 1.507, 0.05);
}

// Where the figures face at the first frame that is motion, from the data's own description and
// the positions of the feet: CMU's added T-pose faces +Z; the dancers of a pair face one another
// when they stand straightest in a hold.
TEST(SharedMaps, Facing) {
  SKIP_WITHOUT_SHARED_DATA();
  const struct {
    const char* file;
    double degrees;
  } cases[] = {{"clips/cmu_12_01_walk.bvh", 0},
               {"clips/cmu_131_01.bvh", 0},
               {"clips/xsens_stand.bvh", 0},
               {"clips/iclone_007_01_walk.bvh", 0}};
  for (const auto& c : cases) {
    const BvhFile bvh = ReadBvh(SharedPath("data/") + c.file);
    const RigFacts facts = Recognise(bvh.motion, {}, c.file);
    EXPECT_NEAR(facts.facing / kDegree, c.degrees, 15) << c.file;
  }
}

}  // namespace
}  // namespace retarget::io
