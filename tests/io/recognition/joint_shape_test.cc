// Figures without usable names: told by the shape of the tree, or refused with the reason.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/recognition/joint_profiles.h"
#include "io/recognition/recognise.h"
#include "tests/rig_figure.h"

namespace retarget::io {
namespace {

struct Bone {
  const char* name;
  int parent;
  Vec3 at;                       // in the parent's frame
  Quat turn = Quat::Identity();  // of the rest pose
};

Quat Turn(double x, double y, double z, double w) { return Quat(w, x, y, z).normalized(); }

RigMotion RestOf(const std::vector<Bone>& bones) {
  RigMotion motion;
  RigFrame frame;
  for (const Bone& bone : bones) {
    RigJoint joint;
    joint.name = bone.name;
    joint.parent = bone.parent;
    joint.offset = bone.at;
    motion.rig.joints.push_back(joint);
    frame.translation.push_back(bone.at);
    frame.rotation.push_back(bone.turn);
  }
  motion.frames = {frame};
  return motion;
}

// Khronos' sample CesiumMan, whose joints have no names (rest translations and rotations of its
// nodes, three digits): a hip with two legs and a trunk of two bones, arms without clavicles.
RigMotion CesiumMan() {
  return RestOf({{"", -1, {0, 0, 0}, Turn(-0.707, 0, 0, 0.707)},  // Z up to Y up
                 {"", 0, {0, 0.005, 0.679}, Turn(-0.027, -0.027, -0.707, -0.707)},
                 {"", 1, {0, 0, 0.145}, Turn(-0.657, 0, 0, -0.754)},
                 {"", 2, {0, 0.251, 0}, Turn(0.623, 0, 0, -0.783)},
                 {"", 3, {0, 0, 0.065}, Turn(-0.661, 0, 0, -0.751)},
                 {"", 4, {0, 0.052, 0}, Turn(0, 1, -0.025, 0)},
                 {"", 3, {0.091, 0, 0}, Turn(0.680, 0.690, -0.227, -0.104)},
                 {"", 6, {0, 0.242, 0}, Turn(-0.014, -0.129, -0.252, -0.959)},
                 {"", 7, {0, 0.188, 0}, Turn(0.006, -0.042, -0.079, -0.996)},
                 {"", 3, {-0.091, 0, 0}, Turn(0.296, 0.032, -0.652, -0.697)},
                 {"", 9, {0, 0.242, 0}, Turn(-0.189, 0.916, -0.168, -0.313)},
                 {"", 10, {0, 0.188, 0}, Turn(-0.059, 0.264, 0.052, -0.961)},
                 {"", 1, {0.068, -0.029, -0.063}, Turn(0.248, -0.578, 0.748, -0.214)},
                 {"", 12, {0, 0.266, 0}, Turn(0.209, -0.330, -0.056, -0.919)},
                 {"", 13, {0, 0.276, 0}, Turn(0.848, -0.004, -0.009, -0.530)},
                 {"", 14, {-0.002, -0.066, 0.028}},
                 {"", 1, {-0.068, -0.029, -0.063}, Turn(-0.066, -0.612, 0.785, 0.073)},
                 {"", 16, {0, 0.266, 0}, Turn(0.216, 0.124, 0.002, -0.968)},
                 {"", 17, {0, 0.276, 0}, Turn(0.847, -0.030, -0.021, -0.530)},
                 {"", 18, {-0.001, -0.066, 0.028}}});
}

// Khronos' sample Fox: four legs and a tail (rest pose of its nodes, three digits).
RigMotion Fox() {
  return RestOf({{"b_Root_00", -1, {0, 0, 0}, Turn(-0.707, 0, 0, 0.707)},
                 {"b_Hip_01", 0, {0, 26.748, 42.938}, Turn(0.128, -0.695, -0.128, 0.695)},
                 {"b_Spine01_02", 1, {12.851, 0, 0}, Turn(0, 0, -0.590, 0.807)},
                 {"b_Spine02_03", 2, {21.656, 0, 0}, Turn(0, 0, 0.017, 1)},
                 {"b_Neck_04", 3, {25.649, 0, 0}, Turn(0, 0, 0.303, 0.953)},
                 {"b_Head_05", 4, {13.377, 0, 0}, Turn(0, 0, -0.4, 0.916)},
                 {"b_RightUpperArm_06", 3, {18.678, -4.297, 6.968}, Turn(0, 0, -0.712, 0.702)},
                 {"b_RightForeArm_07", 6, {23.045, 0, 0}, Turn(0, 0, 0.037, 0.999)},
                 {"b_RightHand_08", 7, {19.35, -0.146, 0}, Turn(-0.012, -0.008, 0.461, 0.888)},
                 {"b_LeftUpperArm_09", 3, {18.678, -4.297, -6.968}, Turn(0, 0, -0.712, 0.702)},
                 {"b_LeftForeArm_010", 9, {23.045, 0, 0}, Turn(0, 0, 0.037, 0.999)},
                 {"b_LeftHand_011", 10, {19.35, -0.146, 0}, Turn(0.017, 0.014, 0.46, 0.888)},
                 {"b_Tail01_012", 1, {4.26, 15.959, 0}, Turn(0, 0, 0.982, 0.189)},
                 {"b_Tail02_013", 12, {12.412, 0, 0}, Turn(0, 0, -0.07, 0.998)},
                 {"b_Tail03_014", 13, {24.24, 0, 0}, Turn(0, 0, -0.054, 0.999)},
                 {"b_LeftLeg01_015", 1, {4.814, 5.154, -6.968}, Turn(0, 0, 0.97, -0.243)},
                 {"b_LeftLeg02_016", 15, {18.944, 0, 0}, Turn(0, 0, -0.368, 0.93)},
                 {"b_LeftFoot01_017", 16, {17.943, 0, 0}, Turn(0, 0, 0.458, 0.889)},
                 {"b_LeftFoot02_018", 17, {15.78, 0, 0}, Turn(0, 0, 0.547, 0.837)},
                 {"b_RightLeg01_019", 1, {4.814, 5.154, 6.968}, Turn(0, 0, 0.97, -0.243)},
                 {"b_RightLeg02_020", 19, {18.944, 0, 0}, Turn(0, 0, -0.368, 0.93)},
                 {"b_RightFoot01_021", 20, {17.943, 0, 0}, Turn(0, 0, 0.458, 0.889)},
                 {"b_RightFoot02_022", 21, {15.78, 0, 0}, Turn(0, 0, 0.547, 0.837)}});
}

std::string Refusal(const RigMotion& motion) {
  try {
    Recognise(motion, {}, "f.glb");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(JointShape, CesiumManWithoutNames) {
  const RigFacts facts = Recognise(CesiumMan(), {}, "f.glb");
  const JointMap& map = facts.map;
  EXPECT_EQ(map.profile, "topology");
  EXPECT_LT(facts.confidence, 0.6);
  EXPECT_EQ(map.root, 1);
  EXPECT_EQ(map.spine, (std::vector<int>{2, 3}));
  EXPECT_EQ(map.neck, std::vector<int>{4});
  EXPECT_EQ(map.head, 5);
  // Knees bend backwards, so they are ahead of hips and ankles; left = up x ahead.
  const PosedRig pose = PoseRig(CesiumMan().rig, CesiumMan().frames[0]);
  const auto at = [&](int joint) { return pose.position[static_cast<size_t>(joint)]; };
  Vec3 ahead = Vec3::Zero();
  for (const JointMap::Side* side : {&map.left, &map.right}) {
    ahead += at(side->knee) - 0.5 * (at(side->hip) + at(side->ankle));
  }
  const Vec3 left = Vec3::UnitY().cross(ahead);
  EXPECT_GT(left.dot(at(map.left.hip) - at(map.right.hip)), 0);
  EXPECT_GT(left.dot(at(map.left.shoulder) - at(map.right.shoulder)), 0);
  EXPECT_EQ(std::min(map.left.shoulder, map.right.shoulder), 6);
  EXPECT_EQ(map.left.wrist - map.left.shoulder, 2);
  EXPECT_EQ(std::min(map.left.hip, map.right.hip), 12);
  EXPECT_EQ(map.left.ankle - map.left.hip, 2);
  EXPECT_EQ(map.left.toe - map.left.hip, 3);
  EXPECT_EQ(map.left.clavicle, -1);
  EXPECT_EQ(facts.virtual_joints, (std::vector<std::string>{"left_clavicle", "right_clavicle"}));
}

TEST(JointShape, AFoxIsRefusedWithTheReasonAndTheWayOut) {
  const std::string named = Refusal(Fox());
  EXPECT_NE(named.find("as that of an animal does"), std::string::npos) << named;
  EXPECT_NE(named.find("f.glb: no human figure: "), std::string::npos) << named;
  EXPECT_NE(named.find("to map it by hand: write its map"), std::string::npos) << named;
  RigMotion unnamed = Fox();
  for (RigJoint& joint : unnamed.rig.joints) joint.name = "bone";
  EXPECT_NE(Refusal(unnamed).find("as that of an animal does"), std::string::npos)
      << Refusal(unnamed);
}

void ForgetNames(RigFigure* figure) {
  for (RigJoint& joint : figure->motion.rig.joints) joint.name = "bone";
}

void ExpectLimbs(const JointMap& map, const JointMap& expected) {
  EXPECT_EQ(map.profile, "topology");
  EXPECT_EQ(map.root, expected.root);
  EXPECT_EQ(map.spine, expected.spine);
  for (const auto side : {&JointMap::left, &JointMap::right}) {
    EXPECT_EQ((map.*side).shoulder, (expected.*side).shoulder);
    EXPECT_EQ((map.*side).elbow, (expected.*side).elbow);
    EXPECT_EQ((map.*side).wrist, (expected.*side).wrist);
    EXPECT_EQ((map.*side).hip, (expected.*side).hip);
    EXPECT_EQ((map.*side).knee, (expected.*side).knee);
    EXPECT_EQ((map.*side).ankle, (expected.*side).ankle);
  }
}

// Names and shape must agree, in any order and with a tail.
TEST(JointShape, AgreesWithNames) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const bool with_tail : {false, true}) {
      RigFigure figure(MixamoNames(3));
      if (with_tail) {
        int tail = figure.motion.rig.Find("Hips");
        for (int n = 1; n <= 3; ++n) {
          tail = figure.Add("Tail" + std::to_string(n), tail,
                            figure.Place(0) + Vec3(0, -10 * n, -25 * n));
        }
      }
      figure.Move(6, 0.2, seed);
      figure.TurnAxes(seed);
      figure.Shuffle(seed);
      const JointMap expected = Recognise(figure.motion, {}, "f").map;
      ForgetNames(&figure);
      ExpectLimbs(Recognise(figure.motion, {}, "f").map, expected);
    }
  }
}

// Reallusion's hip carries a pelvis bone with both legs, and the spine.
TEST(JointShape, LegsMayHangFromAPelvisBone) {
  RigFigure figure(MixamoNames(3));
  auto& joints = figure.motion.rig.joints;
  const int pelvis = figure.Add("Pelvis", 0, figure.Place(0));
  const Rig before = figure.motion.rig;
  for (const char* thigh : {"LeftUpLeg", "RightUpLeg"}) {
    joints[static_cast<size_t>(figure.motion.rig.Find(thigh))].parent = pelvis;
  }
  // Parents first: the pelvis goes to the second place.
  std::rotate(joints.begin() + 1, joints.end() - 1, joints.end());
  for (RigJoint& joint : joints) {
    if (joint.parent == pelvis) {
      joint.parent = 1;
    } else if (joint.parent > 0) {
      ++joint.parent;
    }
  }
  figure.Move(4, 0.2, 8);
  const JointMap expected = Recognise(figure.motion, {}, "f").map;
  EXPECT_EQ(joints[static_cast<size_t>(expected.left.hip)].name, "LeftUpLeg");
  ForgetNames(&figure);
  ExpectLimbs(Recognise(figure.motion, {}, "f").map, expected);
}

}  // namespace
}  // namespace retarget::io
