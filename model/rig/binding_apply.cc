// The way back: a posture of the body onto the bones of a rig.
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "model/geometry/so3.h"
#include "model/rig/binding.h"
#include "model/rig/standard_links.h"
#include "model/rig/tree.h"

namespace retarget {
namespace {

// The turn of `upper` that brings the end of lower + upper to `distance` from its beginning, in the
// plane of the two (about `axis` where they are in line); as near as their lengths allow.
Quat BendToDistance(const Vec3& lower, const Vec3& upper, double distance, const Vec3& axis) {
  const double a = lower.norm(), b = upper.norm();
  if (a < 1e-6 || b < 1e-6) return Quat::Identity();
  const Vec3 normal = lower.cross(upper);
  const Vec3 about = normal.norm() > 1e-6 * a * b ? Vec3(normal.normalized()) : axis;
  // Angle between the two directions: |lower + upper|^2 = a^2 + b^2 + 2 a b cos(angle).
  const double cosine = (distance * distance - a * a - b * b) / (2 * a * b);
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  const double now = std::acos(std::clamp(lower.dot(upper) / (a * b), -1.0, 1.0));
  return Quat(Eigen::AngleAxisd(angle - now, about));
}

// Moves `mover` so that `joint`, itself or below it, stands at `place` (file units and axes).
void MoveJoint(const Rig& rig, int mover, int joint, const Vec3& place, RigFrame* frame) {
  const PosedRig posed = PoseRig(rig, *frame);
  const Vec3 apart = place - posed.position[joint];
  const int above = rig.joints[mover].parent;
  if (above < 0) {
    frame->translation[mover] += apart;
  } else if (posed.linear.empty()) {
    frame->translation[mover] += posed.rotation[above].conjugate() * apart;
  } else if (const Eigen::FullPivLU<Mat3> lu(posed.linear[above]); lu.isInvertible()) {
    frame->translation[mover] += lu.solve(apart);
  }
}

}  // namespace

Pose RigBinding::PoseOf(const RigFrame& frame) const {
  const World world = ToWorld(frame);
  const std::vector<Quat> rotation = LinkRotations(world);
  Pose pose;
  pose.root_position = world.position[map_.root];
  pose.rotation.resize(kNumLinks);
  pose.rotation[0] = rotation[0];
  for (int l = 1; l < kNumLinks; ++l) {
    pose.rotation[l] = (rotation[body_.links[l].parent].conjugate() * rotation[l]).normalized();
  }
  return pose;
}

std::vector<Vec3> RigBinding::JointPositions(const RigFrame& frame) const {
  return ToWorld(frame).position;
}

// The spine bones carry the chest to where the waist link has it. The first of them need not stand
// at the root, so turning them all by the waist's edit leaves the chest a little off: a turn about
// the first one brings it into line, and a bend at the second takes up the difference in distance,
// as far as it exceeds what is not worth bending a spine for.
void RigBinding::SpreadOverSpine(const World& captured, const std::vector<Quat>& edit,
                                 const Vec3& root_position, std::vector<Quat>* rotation) const {
  const Vec3& root = captured.position[map_.root];
  const Vec3& first = captured.position[spine_group_.front()];
  const Vec3 chest = PointIn(captured, points_.chest);
  const Vec3 pivot = root_position + edit[kRoot] * (first - root);
  const Vec3 target = root_position + edit[kWaist] * (chest - root);
  Vec3 reached = edit[kWaist] * (chest - first);  // from the pivot
  Quat bend = Quat::Identity();
  if (spine_group_.size() > 1) {
    const Vec3 lower = edit[kWaist] * (captured.position[spine_group_[1]] - first);
    const Vec3 upper = reached - lower;
    const double distance = std::clamp((target - pivot).norm(), reached.norm() - kSpineSlack,
                                       reached.norm() + kSpineSlack);
    const double excess = (target - pivot).norm() - distance;
    if (excess != 0) {
      bend = BendToDistance(lower, upper, reached.norm() + excess, edit[kRoot] * Vec3::UnitX());
      reached = lower + bend * upper;
    }
  }
  Quat turn = Quat::Identity();
  if (reached.norm() > 1e-6 && (target - pivot).norm() > 1e-6) {
    turn = RotationBetween(reached.normalized(), (target - pivot).normalized());
  }
  for (size_t k = 0; k < spine_group_.size(); ++k) {
    const int bone = spine_group_[k];
    (*rotation)[bone] =
        turn * (k > 0 ? bend : Quat::Identity()) * edit[kWaist] * captured.rotation[bone];
  }
}

// Which joints a fit may turn and move, and which have to be moved at all.
void RigBinding::FindFreedom() {
  const int count = rig_.num_joints();
  freedom_.turns.assign(count, 0);
  freedom_.shifts.assign(count, 0);
  for (int j = 0; j < count; ++j) {
    freedom_.turns[j] = DescendsFrom(rig_, j, map_.root) || link_of_bone_[j] >= 0;
    freedom_.shifts[j] = rig_.joints[j].translates && DescendsFrom(rig_, j, map_.root);
  }
  freedom_.shifts[Mover()] = 1;
  for (int j = 0; j < count; ++j) {
    const bool loose = !DescendsFrom(rig_, j, map_.root) && !DescendsFrom(rig_, map_.root, j);
    has_loose_joints_ = has_loose_joints_ || (loose && !IsOthers(TopOf(rig_, j)));
  }
  detached_.assign(joint_at_node_.size(), 0);
  for (int n = 1; n < body_.num_nodes(); ++n) {
    if (joint_at_node_[n] < 0) continue;
    // The limbs hang from the trunk in more ways than one.
    const int link = body_.nodes[n].link;
    const bool of_limb = link > kHead && body_.nodes[body_.nodes[n].parent].link > kHead;
    int above = of_limb ? joint_at_node_[body_.nodes[n].parent] : map_.root;
    if (above < 0) above = map_.root;
    detached_[n] = rig_.joints[joint_at_node_[n]].can_translate &&
                   !DescendsFrom(rig_, joint_at_node_[n], above);
    if (detached_[n]) freedom_.shifts[joint_at_node_[n]] = 1;
  }
}

// Whether a tree of joints that the root does not hang from is another figure's.
bool RigBinding::IsOthers(int top) const {
  if (DescendsFrom(rig_, map_.root, top)) return false;
  int own = 0, others = 0;
  const int tree = TopOf(rig_, map_.root);
  for (int j = 0; j < rig_.num_joints(); ++j) {
    own += DescendsFrom(rig_, j, tree) ? 1 : 0;
    others += DescendsFrom(rig_, j, top) ? 1 : 0;
  }
  return 2 * others > own;
}

int RigBinding::Mover() const {
  int mover = map_.root;
  while (!rig_.joints[mover].translates && rig_.joints[mover].parent >= 0) {
    mover = rig_.joints[mover].parent;
  }
  return mover;
}

RigFrame RigBinding::TurnBones(const RigFrame& captured, const Pose& solved) const {
  const World world = ToWorld(captured);
  const std::vector<Quat> before = LinkRotations(world);
  std::vector<Quat> edit(kNumLinks), after(kNumLinks);
  for (int l = 0; l < kNumLinks; ++l) {
    after[l] = l == 0 ? solved.rotation[0] : after[body_.links[l].parent] * solved.rotation[l];
    edit[l] = after[l] * before[l].conjugate();
  }
  std::vector<Quat> rotation(rig_.joints.size());
  RigFrame out = captured;
  for (size_t j = 0; j < rig_.joints.size(); ++j) {
    const int parent = rig_.joints[j].parent;
    const Quat above = parent < 0 ? up_ : rotation[parent];
    const int link = link_of_bone_[j];
    if (link == kWaist) {
      if (static_cast<int>(j) == spine_group_.front()) {
        SpreadOverSpine(world, edit, solved.root_position, &rotation);
      }
    } else {
      rotation[j] = link >= 0 ? edit[link] * world.rotation[j] : above * captured.rotation[j];
    }
    rotation[j].normalize();
    out.rotation[j] = (above.conjugate() * rotation[j]).normalized();
    out.translation[j] = ratio_ * captured.translation[j];
  }
  TurnTwistHelpers(captured, &out);
  return out;
}

RigFrame RigBinding::Placed(const RigFrame& frame, const Quat& turn, const Vec3& shift) const {
  if (!has_loose_joints_) return frame;  // the root takes all along
  const Quat turn_file = up_.conjugate() * turn * up_;
  const Vec3 shift_file = up_.conjugate() * shift / scale_;
  RigFrame out = frame;
  const PosedRig posed = PoseRig(rig_, frame);
  std::vector<char> placed(rig_.joints.size(), 0);  // itself, or with what it hangs from
  for (int j = 0; j < rig_.num_joints(); ++j) {
    const int parent = rig_.joints[j].parent;
    placed[j] = parent >= 0 ? placed[parent] : IsOthers(j);
    if (placed[j] || !rig_.joints[j].can_translate || (parent >= 0 && !posed.linear.empty())) {
      continue;
    }
    placed[j] = 1;
    const Quat above = parent < 0 ? Quat::Identity() : posed.rotation[parent];
    const Vec3 origin = parent < 0 ? Vec3::Zero() : posed.position[parent];
    out.rotation[j] = above.conjugate() * turn_file * posed.rotation[j];
    out.translation[j] = above.conjugate() * (turn_file * posed.position[j] + shift_file - origin);
  }
  return out;
}

// Joints that go with a bone they do not hang from: the bone takes them along.
void RigBinding::Follow(const RigFrame& captured, RigFrame* out) const {
  if (followers_.empty()) return;
  const PosedRig before = PoseRig(rig_, captured);
  for (const auto& [joint, bone] : followers_) {
    const PosedRig posed = PoseRig(rig_, *out);
    const Quat turn = posed.rotation[bone] * before.rotation[bone].conjugate();
    const int parent = rig_.joints[joint].parent;
    const Quat above = parent < 0 ? Quat::Identity() : posed.rotation[parent];
    out->rotation[joint] = (above.conjugate() * turn * before.rotation[joint]).normalized();
    if (!rig_.joints[joint].can_translate) continue;
    const Vec3 arm = ratio_ * (before.position[joint] - before.position[bone]);
    MoveJoint(rig_, joint, joint, posed.position[bone] + turn * arm, out);
  }
}

RigFrame RigBinding::Apply(const RigFrame& captured, const Pose& solved) const {
  RigFrame out = Bend(captured, solved);
  Follow(captured, &out);
  return out;
}

RigFrame RigBinding::Bend(const RigFrame& captured, const Pose& solved) const {
  RigFrame out = TurnBones(captured, solved);
  const double own_scale = scale_ / ratio_;
  const auto to_file = [&](const Vec3& p) -> Vec3 { return up_.conjugate() * p / own_scale; };
  // The root goes where it was solved to, moved by the joint that the file moves.
  MoveJoint(rig_, Mover(), map_.root, to_file(solved.root_position), &out);
  if (std::find(detached_.begin(), detached_.end(), 1) == detached_.end()) return out;
  const PosedBody posed = PoseBody(body_, solved);
  for (size_t n = 0; n < detached_.size(); ++n) {
    const int joint = joint_at_node_[n];
    if (detached_[n]) MoveJoint(rig_, joint, joint, to_file(posed.node[n]), &out);
  }
  return out;
}

RigFrame RigBinding::Fitted(const RigFrame& captured, const Pose& solved) const {
  const double own_scale = scale_ / ratio_;
  const PosedBody posed = PoseBody(body_, solved);
  std::vector<RigTarget> targets;
  for (size_t n = 0; n < joint_at_node_.size(); ++n) {
    if (joint_at_node_[n] < 0) continue;
    targets.push_back({joint_at_node_[n], up_.conjugate() * posed.node[n] / own_scale});
  }
  RigFreedom freedom = freedom_;
  for (int j = 0; !captured.scale.empty() && j < rig_.num_joints(); ++j) {
    // Where bones change their lengths as they turn, turns alone cannot reach.
    if (rig_.joints[j].can_translate && DescendsFrom(rig_, j, map_.root)) freedom.shifts[j] = 1;
  }
  RigFrame out = FitFrame(rig_, freedom, targets, own_scale, Bend(captured, solved));
  Follow(captured, &out);
  return out;
}

std::vector<LockedAxis> RigBinding::LockedAxesOf(const RigFrame& frame) const {
  std::vector<LockedAxis> locked_axes;
  for (int l = 1; l < body_.num_links(); ++l) {
    const int bone = link_[l].bone;
    const bool shared =
        std::find(spine_group_.begin(), spine_group_.end(), bone) != spine_group_.end();
    if (bone < 0 || shared || body_.links[l].locked || rig_.joints[bone].turns_freely) continue;
    // R exp(w) = A_1 ... A_n exp(w): the last axis stays as it is, the one before it has been
    // turned by the last, and so on; with two axes, A_2^T a_1 = R^T a_1.
    const std::vector<Vec3>& axes = rig_.joints[bone].turn_axes;
    std::vector<Vec3> free;
    if (!axes.empty()) free.push_back(axes.back());
    if (axes.size() == 2) free.push_back(frame.rotation[bone].conjugate() * axes[0]);
    Eigen::Matrix<double, 3, Eigen::Dynamic> span(3, std::max<size_t>(free.size(), 1));
    span.setZero();
    for (size_t k = 0; k < free.size(); ++k) span.col(static_cast<long>(k)) = free[k];
    const Eigen::JacobiSVD<MatX> svd(span, Eigen::ComputeFullU);
    for (long k = static_cast<long>(free.size()); k < 3; ++k) {
      locked_axes.push_back({l, link_[l].turn.conjugate() * Vec3(svd.matrixU().col(k))});
    }
  }
  return locked_axes;
}

}  // namespace retarget
