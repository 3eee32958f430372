// Twist helpers: leaf bones along a limb (Unreal's upperarm_twist_01_l, Reallusion's ForearmTwist)
// that share the turn of the next joint among the skin. They follow the edit of that turn.
#include <cmath>

#include "model/geometry/so3.h"
#include "model/rig/binding.h"

namespace retarget {
namespace {

// Where a joint stands along the segment from `bone` to `child`, as a share; nothing off the axis.
std::optional<double> ShareAlong(const PosedRig& pose, int bone, int child, int joint) {
  constexpr double kOffAxis = 0.03, kBeyond = 0.01;  // of the segment's length
  const Vec3 along = pose.position[child] - pose.position[bone];
  const Vec3 at = pose.position[joint] - pose.position[bone];
  if (along.norm() == 0) return std::nullopt;
  const double share = at.dot(along) / along.squaredNorm();
  if ((at - share * along).norm() > kOffAxis * along.norm()) return std::nullopt;
  if (share < -kBeyond || share > 1 + kBeyond) return std::nullopt;
  return share;
}

}  // namespace

void RigBinding::FindTwistHelpers(const PosedRig& pose) {
  for (const JointMap::Side* side : {&map_.left, &map_.right}) {
    const std::pair<int, int> bones[] = {{side->shoulder, side->elbow},
                                         {side->elbow, side->wrist},
                                         {side->hip, side->knee},
                                         {side->knee, side->ankle}};
    for (const auto& [bone, child] : bones) {
      if (bone < 0 || child < 0) continue;
      // A helper's whole branch lies on the axis: otherwise it is something that the limb carries.
      std::vector<char> below(rig_.joints.size(), 0), onwards(rig_.joints.size(), 0);
      for (int j = child; j > bone; j = rig_.joints[j].parent) onwards[j] = 1;
      std::vector<std::optional<double>> share(rig_.joints.size());
      for (int j = bone + 1; j < rig_.num_joints(); ++j) {
        const int parent = rig_.joints[j].parent;
        below[j] = !onwards[j] && (parent == bone || (parent > bone && below[parent]));
        if (below[j]) share[j] = ShareAlong(pose, bone, child, j);
      }
      for (int j = rig_.num_joints() - 1; j > bone; --j) {
        if (below[j] && !share[j]) share[rig_.joints[j].parent].reset();
      }
      const Vec3 axis =
          (pose.rotation[bone].conjugate() * (pose.position[child] - pose.position[bone]))
              .normalized();
      for (int j = bone + 1; j < rig_.num_joints(); ++j) {
        const int parent = rig_.joints[j].parent;
        if (!share[j] || (parent != bone && !share[parent])) continue;
        const double above = parent == bone ? 0 : *share[parent];
        twist_helpers_.push_back({j, bone, child, axis, *share[j] - above});
      }
    }
  }
}

void RigBinding::TurnTwistHelpers(const RigFrame& captured, RigFrame* out) const {
  if (twist_helpers_.empty()) return;
  const auto relative = [&](const RigFrame& frame, int joint, int ancestor) {
    Quat turn = frame.rotation[joint];
    for (int j = rig_.joints[joint].parent; j > ancestor; j = rig_.joints[j].parent) {
      turn = frame.rotation[j] * turn;
    }
    return turn;
  };
  for (const TwistHelper& helper : twist_helpers_) {
    const Quat before = relative(captured, helper.child, helper.bone);
    const Quat after = relative(*out, helper.child, helper.bone);
    const Vec3 turn = LogSo3(TwistAbout((after * before.conjugate()).normalized(), helper.axis));
    const int parent = rig_.joints[helper.joint].parent;
    const Quat frame =
        parent == helper.bone ? Quat::Identity() : relative(captured, parent, helper.bone);
    const Quat added = ExpSo3(frame.conjugate() * Vec3(helper.share * turn));
    out->rotation[helper.joint] = (added * captured.rotation[helper.joint]).normalized();
  }
}

}  // namespace retarget
