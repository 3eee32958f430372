// Joints told by the shape of the tree alone: MatchShape of io/joint_profiles.h.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "io/joint_profiles.h"

namespace retarget {
namespace {

constexpr double kEqualLengths = 0.15;  // relative

bool AboutEqual(double a, double b) { return std::abs(a - b) <= kEqualLengths * std::max(a, b); }

class ShapeMatcher {
 public:
  ShapeMatcher(const Rig& rig, const PosedRig& pose)
      : rig_(rig),
        length_(rig.joints.size(), 0),
        reach_(rig.joints.size(), 0),
        children_(rig.joints.size()) {
    for (int j = rig.num_joints() - 1; j >= 0; --j) {
      const RigJoint& joint = rig.joints[j];
      if (joint.end_site) reach_[j] = std::max(reach_[j], joint.end_site->norm());
      if (joint.parent < 0) continue;
      length_[j] = (pose.position[j] - pose.position[joint.parent]).norm();
      reach_[joint.parent] = std::max(reach_[joint.parent], Extent(j));
      children_[joint.parent].insert(children_[joint.parent].begin(), j);
    }
  }

  // The map with sides not yet told: "left" is one of the two.
  std::optional<JointMap> Match() const {
    for (int root = 0; root < rig_.num_joints(); ++root) {
      const std::vector<int> limbs = LongChildren(root, kLimb * reach_[root]);
      if (limbs.size() < 2) continue;
      if (limbs.size() != 3) return std::nullopt;
      return MatchAt(root, limbs);
    }
    return std::nullopt;
  }

 private:
  // Shares of the reach from the root that make a limb, and that make a neck.
  static constexpr double kLimb = 0.3, kNeck = 0.06;

  // From the joint's parent to the farthest end below the joint.
  double Extent(int joint) const { return length_[joint] + reach_[joint]; }

  std::vector<int> LongChildren(int joint, double at_least) const {
    std::vector<int> out;
    for (int c : children_[joint]) {
      if (Extent(c) > at_least) out.push_back(c);
    }
    return out;
  }

  std::optional<JointMap> MatchAt(int root, const std::vector<int>& limbs) const {
    std::optional<JointMap> only;
    for (size_t trunk = 0; trunk < 3; ++trunk) {
      auto map = WithTrunk(root, limbs[trunk], limbs[(trunk + 1) % 3], limbs[(trunk + 2) % 3]);
      if (!map) continue;
      if (only) return std::nullopt;  // ambiguous
      only = std::move(map);
    }
    return only;
  }

  std::optional<JointMap> WithTrunk(int root, int trunk, int leg, int other_leg) const {
    if (!AboutEqual(Extent(leg), Extent(other_leg))) return std::nullopt;
    JointMap map;
    map.profile = "topology";
    map.root = root;
    int branch = trunk;
    std::vector<int> limbs;
    for (;;) {
      map.spine.push_back(branch);
      limbs = LongChildren(branch, kNeck * reach_[root]);
      if (limbs.size() != 1) break;
      branch = limbs[0];
    }
    if (limbs.size() != 3) return std::nullopt;
    // The neck is the shortest of the three.
    std::sort(limbs.begin(), limbs.end(), [&](int a, int b) { return Extent(a) < Extent(b); });
    if (!AboutEqual(Extent(limbs[1]), Extent(limbs[2])) ||
        AboutEqual(Extent(limbs[0]), Extent(limbs[1]))) {
      return std::nullopt;
    }
    const bool limbs_found = FillArm(limbs[1], &map.left) && FillArm(limbs[2], &map.right) &&
                             FillLeg(leg, &map.left) && FillLeg(other_leg, &map.right);
    if (!limbs_found) return std::nullopt;
    const std::vector<int> path = LongestPath(limbs[0]);
    if (path.size() > 1) map.neck = {path[0]};
    map.head = path[std::min<size_t>(1, path.size() - 1)];
    return map;
  }

  // From `joint` down to the farthest leaf.
  std::vector<int> LongestPath(int joint) const {
    std::vector<int> path = {joint};
    while (!children_[path.back()].empty()) {
      const auto& next = children_[path.back()];
      path.push_back(*std::max_element(next.begin(), next.end(),
                                       [&](int a, int b) { return Extent(a) < Extent(b); }));
    }
    return path;
  }

  // Where the two longest neighbouring bones of a path begin. They must be alike, and no other
  // pair may come near them: a long collar bone can pass for an upper arm.
  std::optional<size_t> LongBones(const std::vector<int>& path) const {
    constexpr double kAlike = 0.5, kNear = 0.8, kLessAlike = 0.2;
    const auto length = [&](size_t n) { return length_[path[n + 1]] + length_[path[n + 2]]; };
    const auto likeness = [&](size_t n) {
      const auto [a, b] = std::minmax(length_[path[n + 1]], length_[path[n + 2]]);
      return b > 0 ? a / b : 0;
    };
    std::optional<size_t> best;
    for (size_t n = 0; n + 2 < path.size(); ++n) {
      if (likeness(n) >= kAlike && (!best || length(n) > length(*best))) best = n;
    }
    for (size_t n = 0; n + 2 < path.size() && best; ++n) {
      if (n == *best || likeness(n) < kAlike || length(n) < kNear * length(*best)) continue;
      if (n > *best || likeness(n) > likeness(*best) - kLessAlike) return std::nullopt;
    }
    return best;
  }

  bool FillArm(int joint, JointMap::Side* side) const {
    const std::vector<int> path = LongestPath(joint);
    const auto at = LongBones(path);
    if (!at) return false;
    side->clavicle = *at > 0 ? path[0] : -1;
    side->shoulder = path[*at];
    side->elbow = path[*at + 1];
    side->wrist = path[*at + 2];
    return true;
  }

  bool FillLeg(int joint, JointMap::Side* side) const {
    const std::vector<int> path = LongestPath(joint);
    const auto at = LongBones(path);
    if (!at) return false;
    side->hip = path[*at];
    side->knee = path[*at + 1];
    side->ankle = path[*at + 2];
    side->toe = *at + 3 < path.size() ? path[*at + 3] : -1;
    return true;
  }

  const Rig& rig_;
  std::vector<double> length_;  // from the parent
  std::vector<double> reach_;   // to the farthest end below
  std::vector<std::vector<int>> children_;
};

void SwapArms(JointMap* map) {
  for (auto part : {&JointMap::Side::clavicle, &JointMap::Side::shoulder, &JointMap::Side::elbow,
                    &JointMap::Side::wrist, &JointMap::Side::hand}) {
    std::swap(map->left.*part, map->right.*part);
  }
}

// Puts arms and legs on their sides: feet point forwards, left = up x forward. False where the
// frames do not agree on it.
bool TellSides(const Rig& rig, const std::vector<PosedRig>& poses, JointMap* map) {
  int legs = 0, arms = 0;  // votes for "left is left"
  for (const PosedRig& pose : poses) {
    const auto& p = pose.position;
    const auto foot = [&](const JointMap::Side& side) -> Vec3 {
      if (side.toe >= 0) return p[side.toe] - p[side.ankle];
      return pose.rotation[side.ankle] * rig.joints[side.ankle].end_site.value_or(Vec3::Zero());
    };
    const Vec3 forward = foot(map->left) + foot(map->right);
    const Vec3 up = p[map->head] - (p[map->left.ankle] + p[map->right.ankle]) / 2;
    const Vec3 left = up.cross(forward);
    if (left.norm() < 1e-9 * up.squaredNorm()) continue;
    legs += left.dot(p[map->left.hip] - p[map->right.hip]) > 0 ? 1 : -1;
    arms += left.dot(p[map->left.shoulder] - p[map->right.shoulder]) > 0 ? 1 : -1;
  }
  const int majority = static_cast<int>(poses.size() + 1) / 2;
  if (std::min(std::abs(legs), std::abs(arms)) < majority) return false;
  if (legs < 0) std::swap(map->left, map->right);
  if ((legs < 0) != (arms < 0)) SwapArms(map);
  return true;
}

}  // namespace

std::optional<JointMap> MatchShape(const Rig& rig, const std::vector<PosedRig>& poses) {
  if (rig.joints.empty() || poses.empty()) return std::nullopt;
  auto map = ShapeMatcher(rig, poses.front()).Match();
  if (map && !TellSides(rig, poses, &*map)) return std::nullopt;
  return map;
}

}  // namespace retarget
