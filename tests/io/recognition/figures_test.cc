// Several people in one rig: below one root and on roots of their own, with props and doubles.
#include "io/recognition/figures.h"

#include <gtest/gtest.h>

#include "model/rig/tree.h"
#include "tests/rig_figure.h"

namespace retarget::io {
namespace {

JointNames Named(const std::string& mark) {
  JointNames names = {{"root", "Hips"},
                      {"spine0", "Spine"},
                      {"spine1", "Spine1"},
                      {"neck", "Neck"},
                      {"head", "Head"}};
  for (const auto& [side, word] : {std::pair("left_", "Left"), {"right_", "Right"}}) {
    for (const auto& [part, name] : {std::pair("clavicle", "Shoulder"),
                                     {"shoulder", "Arm"},
                                     {"elbow", "ForeArm"},
                                     {"wrist", "Hand"},
                                     {"hip", "UpLeg"},
                                     {"knee", "Leg"},
                                     {"ankle", "Foot"}}) {
      names[std::string(side) + part] = std::string(word) + name;
    }
  }
  for (auto& [joint, name] : names) name = mark + name;
  return names;
}

// Appends the joints of a figure, below `parent` or as a root, so far to the side.
void Append(const RigFigure& figure, int parent, double x, RigMotion* motion) {
  const int first = motion->rig.num_joints();
  for (RigJoint joint : figure.motion.rig.joints) {
    const bool top = joint.parent < 0;
    joint.parent = top ? parent : joint.parent + first;
    if (top) joint.offset.x() += x;
    motion->rig.joints.push_back(joint);
  }
}

void AddBone(const std::string& name, int parent, RigMotion* motion) {
  RigJoint joint;
  joint.name = name;
  joint.parent = parent;
  motion->rig.joints.push_back(joint);
}

void Rest(RigMotion* motion) {
  RigFrame frame;
  for (const RigJoint& joint : motion->rig.joints) {
    frame.translation.push_back(joint.offset);
    frame.rotation.push_back(joint.rest_rotation);
  }
  motion->frames = {frame};
}

std::vector<std::string> NamesOf(const std::vector<FileFigure>& figures) {
  std::vector<std::string> names;
  for (const FileFigure& figure : figures) names.push_back(figure.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Figures, StandOnRootsOrBelowOne) {
  const RigFigure one(Named("A_")), two(Named("B_"));
  for (const bool below : {false, true}) {
    RigMotion motion;
    int parent = -1;
    if (below) {
      AddBone("Reference", -1, &motion);
      parent = 0;
    }
    Append(one, parent, 0, &motion);
    AddBone("Sword", parent, &motion);
    Append(two, parent, 80, &motion);
    Rest(&motion);
    EXPECT_EQ(NamesOf(FindFigures(motion)), (Names{"A_Hips", "B_Hips"}));
    EXPECT_EQ(SelectFigure(motion, "1", "f").name, "B_Hips");
    EXPECT_EQ(SelectFigure(motion, "A_Hips", "f").joint, below ? 1 : 0);
    EXPECT_EQ(SelectFigure(motion, "B_Spine", "f").joint, motion.rig.Find("B_Spine"));
    EXPECT_THROW(SelectFigure(motion, "2", "f"), InputError);
    const auto joints = BranchOf(motion.rig, motion.rig.Find("B_Hips"));
    const RigMotion alone = MotionOfJoints(motion, joints);
    EXPECT_EQ(alone.rig.num_joints(), two.motion.rig.num_joints() + (below ? 1 : 0));
    EXPECT_EQ(NamesOf(FindFigures(alone)), (Names{below ? "Reference" : "B_Hips"}));
  }
}

TEST(Figures, OfOneNamingAreToldByNumber) {
  const RigFigure one(Named(""));
  RigMotion motion;
  Append(one, -1, 0, &motion);
  Append(one, -1, 60, &motion);
  Append(one, -1, 120, &motion);
  Rest(&motion);
  EXPECT_EQ(NamesOf(FindFigures(motion)), (Names{"Hips", "Hips", "Hips"}));
  EXPECT_EQ(SelectFigure(motion, "2", "f").joint, 2 * one.motion.rig.num_joints());
  EXPECT_EQ(SelectFigure(motion, "Hips", "f").joint, 0);
}

// The layers of a control rig are one person; two people may stand in one place.
TEST(Figures, LayersOfARigAreOne) {
  RigMotion motion;
  AddBone("root", -1, &motion);
  Append(RigFigure(Named("ORG-")), 0, 0, &motion);
  Append(RigFigure(Named("DEF-")), 0, 0, &motion);
  Rest(&motion);
  EXPECT_EQ(NamesOf(FindFigures(motion)), (Names{"root"}));
  RigMotion pair;
  AddBone("root", -1, &pair);
  Append(RigFigure(Named("A_")), 0, 0, &pair);
  Append(RigFigure(Named("B_")), 0, 0, &pair);
  Rest(&pair);
  EXPECT_EQ(NamesOf(FindFigures(pair)), (Names{"A_Hips", "B_Hips"}));
}

TEST(Figures, OneIsOne) {
  RigFigure figure(Named(""));
  EXPECT_EQ(NamesOf(FindFigures(figure.motion)), (Names{"Hips"}));
}

}  // namespace
}  // namespace retarget::io
