// Assemble of io/acclaim/skeleton.h.
#include <fmt/format.h>

#include <algorithm>

#include "io/acclaim/skeleton.h"
#include "io/text/cursor.h"
#include "io/text/quoted.h"
#include "model/geometry/euler_angles.h"

namespace retarget::io::acclaim {
namespace {

// A bound that no real file reaches.
constexpr int kMaxDepth = 256;

RigJoint JointOf(const std::vector<BoneBlock>& blocks, const BoneBlock& bone, int parent) {
  RigJoint joint;
  joint.name = bone.name;
  joint.parent = parent;
  if (bone.parent < 0) {
    joint.offset = bone.direction;
  } else if (bone.parent > 0) {
    const BoneBlock& above = blocks[static_cast<size_t>(bone.parent)];
    joint.offset = above.length * above.direction;
  }
  if (bone.children.empty() && parent >= 0) joint.end_site = bone.length * bone.direction;
  const auto moves = [](int kind) { return kind < kFirstRotationDof; };
  joint.translates = std::ranges::count_if(bone.dofs, moves) == 3;
  joint.can_translate = joint.translates;
  return joint;
}

AcclaimBone BoneOf(const BoneBlock& block, bool degrees) {
  AcclaimBone bone;
  bone.dofs = block.dofs;
  for (const int axis : block.axis_order) {
    bone.axes = AxisTurn(axis, block.axis_angles[axis] * (degrees ? kDegree : 1)) * bone.axes;
  }
  return bone;
}

// A bone with fewer than three turns; the last one is leftmost in the product.
void LimitTurns(const AcclaimBone& bone, RigJoint* joint) {
  for (auto dof = bone.dofs.rbegin(); dof != bone.dofs.rend(); ++dof) {
    if (*dof < kFirstRotationDof) continue;
    joint->turn_axes.push_back(bone.axes * Vec3::Unit(*dof - kFirstRotationDof));
  }
  joint->turns_freely = joint->turn_axes.size() == 3;
  if (joint->turns_freely) joint->turn_axes.clear();
}

}  // namespace

void Assemble(const std::vector<BoneBlock>& blocks, const LineReader& lines, Skeleton* skeleton) {
  std::vector<int> joint_of_block(blocks.size(), -1);
  std::vector<std::pair<int, int>> open = {{0, 0}};  // block and its depth
  while (!open.empty()) {
    const auto [b, depth] = open.back();
    open.pop_back();
    const BoneBlock& block = blocks[static_cast<size_t>(b)];
    if (depth > kMaxDepth) {
      lines.Fail("bones nested too deeply", fmt::format("at most {} levels", kMaxDepth));
    }
    const int parent = block.parent < 0 ? -1 : joint_of_block[static_cast<size_t>(block.parent)];
    joint_of_block[static_cast<size_t>(b)] = skeleton->rig.num_joints();
    skeleton->rig.joints.push_back(JointOf(blocks, block, parent));
    skeleton->bones.push_back(BoneOf(block, skeleton->degrees));
    LimitTurns(skeleton->bones.back(), &skeleton->rig.joints.back());
    for (size_t k = block.children.size(); k-- > 0;) {
      open.emplace_back(block.children[k], depth + 1);
    }
  }
  for (size_t b = 0; b < blocks.size(); ++b) {
    if (joint_of_block[b] < 0) {
      lines.Fail("bone " + QuotedWord(blocks[b].name) + " apart from the root", "it in :hierarchy");
    }
    skeleton->joint_of_name[LowerCase(blocks[b].name)] = joint_of_block[b];
  }
}

}  // namespace retarget::io::acclaim
