// The table of conventions; joint_name_match.cc and joint_shape_match.cc match a rig.
#include "io/joint_profiles.h"

namespace retarget {
namespace {

// clang-format off
constexpr JointProfile kProfiles[] = {
    // Mixamo, Ready Player Me, HumanIK, MotionBuilder, LAFAN1.
    {"mixamo", "mixamorig", "left/right", "hips",
     "spine spine1 spine2 spine3 spine4", "neck neck1 neck2", "head",
     "#shoulder", "#arm", "#forearm", "#hand", "#handmiddle1 #handend #handindex1",
     "#upleg", "#leg", "#foot", "#toebase #toe", ""},
    // Classic BVH, Character Studio BVH, Xsens MVN.
    {"classic", "", "left/right", "hips",
     "chest chest2 chest3 chest4", "neck", "head",
     "#collar", "#shoulder", "#elbow", "#wrist", "#hand #fingers",
     "#hip", "#knee", "#ankle", "#toe", ""},
    // CMU's clips as B. Hahne (cgspeed) converted them, for MotionBuilder and for 3ds Max.
    {"cmu", "", "left/right", "hips",
     "lowerback spine spine1", "neck neck1", "head",
     "#shoulder", "#arm", "#forearm", "#hand", "#fingerbase #handindex1",
     "#upleg", "#leg", "#foot", "#toebase", "lhipjoint rhipjoint"},
    {"cmu_3dsmax", "", "left/right", "hips",
     "lowerback chest chest2", "lowerneck neck", "head",
     "#collar", "#shoulder", "#elbow", "#wrist", "@hand @fingers",
     "#hip", "#knee", "#ankle", "#toe", "lhipjoint rhipjoint"},
    // CMU's own ASF names.
    {"cmu_asf", "", "l/r", "root",
     "lowerback upperback thorax", "lowerneck upperneck", "head",
     "#clavicle", "#humerus", "#radius", "#wrist", "#hand #fingers",
     "#femur", "#tibia", "#foot", "#toes", "lhipjoint rhipjoint"},
    {"rokoko", "", "left/right", "hips",
     "spine1 spine2 spine3 spine4", "neck", "head",
     "#shoulder", "#arm", "#forearm", "#hand", "#handmiddle1 #finger3proximal",
     "#thigh", "#shin", "#foot", "#toe #toebase", ""},
    {"soma", "", "left/right", "hips",
     "spine1 spine2 chest", "neck1 neck2", "head",
     "#shoulder", "#arm", "#forearm", "#hand", "#handmiddle1",
     "#leg", "#shin", "#foot", "#toebase", ""},
    // VRM, Unity Humanoid, Godot.
    {"vrm", "", "left/right", "hips",
     "spine chest upperchest", "neck", "head",
     "#shoulder", "#upperarm", "#lowerarm", "#hand", "#middleproximal #middle1",
     "#upperleg", "#lowerleg", "#foot", "#toes #toebase", ""},
    {"vroid", "jbip", "l/r", "chips",
     "cspine cchest cupperchest", "cneck", "chead",
     "#shoulder", "#upperarm", "#lowerarm", "#hand", "#middle1",
     "#upperleg", "#lowerleg", "#foot", "#toebase", ""},
    {"unreal", "", "l/r", "pelvis",
     "spine01 spine02 spine03 spine04 spine05", "neck01 neck02", "head",
     "clavicle#", "upperarm#", "lowerarm#", "hand#", "middle01#",
     "thigh#", "calf#", "foot#", "ball#", ""},
    // SMPL, SMPL-H, SMPL-X and their FBX files: the foot is the toe joint.
    {"smpl", "mavg favg", "left/right l/r", "pelvis",
     "spine1 spine2 spine3", "neck", "head",
     "#collar", "#shoulder", "#elbow", "#wrist", "#middle1 #hand",
     "#hip", "#knee", "#ankle", "#foot", ""},
    {"biped", "bip", "l/r", "pelvis",
     "spine spine1 spine2 spine3", "neck neck1", "head",
     "#clavicle", "#upperarm", "#forearm", "#hand", "#finger2",
     "#thigh", "#calf", "#foot", "#toe0", ""},
    {"reallusion", "ccbase", "l/r", "hip",
     "waist spine01 spine02", "necktwist01 necktwist02", "head",
     "#clavicle", "#upperarm", "#forearm", "#hand", "#mid1",
     "#thigh", "#calf", "#foot", "#toebase", ""},
    // DAZ, Poser, CMU's clips for DAZ.
    {"daz", "", "l/r left/right", "hip",
     "abdomen abdomen2 chest", "neck", "head",
     "#collar", "#shldr", "#forearm", "#hand", "#mid1",
     "#thigh", "#shin", "#foot", "#toe", "lbuttock rbuttock"},
    {"rigify", "def org", "l/r", "spine",
     "spine001 spine002 spine003", "spine004 spine005", "spine006",
     "shoulder#", "upperarm#", "forearm#", "hand#", "fmiddle01#",
     "thigh#", "shin#", "foot#", "toe#", ""},
    {"auto_rig_pro", "", "l/r", "rootx",
     "spine01x spine02x spine03x", "neckx", "headx",
     "shoulder#", "armstretch#", "forearmstretch#", "hand#", "cmiddle1base# middle1#",
     "thighstretch#", "legstretch#", "foot#", "toes01#", ""},
    {"bandai", "", "l/r", "hips",
     "spine chest", "neck", "head",
     "shoulder#", "upperarm#", "lowerarm#", "hand#", "",
     "upperleg#", "lowerleg#", "foot#", "toes#", "jointroot"},
    // This project's own files.
    {"project", "", "left/right l/r", "root",
     "waist chest", "neck", "head",
     "#clavicle", "#shoulder", "#elbow", "#wrist", "#hand",
     "#hip", "#knee", "#ankle", "#toe", ""},
};
// clang-format on

}  // namespace

std::span<const JointProfile> JointProfiles() { return kProfiles; }

}  // namespace retarget
