// Joints told by the shape of the tree alone: MatchShape of io/recognition/joint_profiles.h.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "io/recognition/joint_profiles.h"
#include "model/rig/points.h"

namespace retarget::io {
namespace {

constexpr double kEqualLengths = 0.15;  // relative

bool AboutEqual(double a, double b) { return std::abs(a - b) <= kEqualLengths * std::max(a, b); }

class ShapeMatcher {
 public:
  ShapeMatcher(const Rig& rig, const std::vector<PosedRig>& poses)
      : rig_(rig),
        poses_(poses),
        length_(rig.joints.size(), 0),
        reach_(rig.joints.size(), 0),
        children_(rig.joints.size()) {
    for (int j = rig.num_joints() - 1; j >= 0; --j) {
      const RigJoint& joint = rig.joints[j];
      if (joint.end_site) reach_[j] = std::max(reach_[j], joint.end_site->norm());
      if (joint.parent < 0) continue;
      const auto& at = poses.front().position;
      length_[j] = (at[j] - at[joint.parent]).norm();
      reach_[joint.parent] = std::max(reach_[joint.parent], Extent(j));
      children_[joint.parent].insert(children_[joint.parent].begin(), j);
    }
  }

  // Every way to read the tree as a human's, with sides not yet told: "left" is one of the two.
  // The readings of the first joint that has any.
  std::vector<JointMap> Match() {
    std::vector<JointMap> readings;
    for (int root = 0; root < rig_.num_joints() && readings.empty(); ++root) {
      const std::vector<int> limbs = LongChildren(root, kLimb * reach_[root]);
      if (limbs.size() < 2 || limbs.size() > kMostLimbs) continue;
      for (const int trunk : limbs) {
        for (const auto& [leg, other] : PairsBeside(limbs, trunk)) {
          AddReadings(root, trunk, leg, other, &readings);
        }
      }
    }
    return readings;
  }

  // Whether Match met four limbs, but a trunk that never continues the legs.
  bool met_animal() const { return met_animal_; }

 private:
  // Shares of the reach from the root that make a limb, and that make a neck.
  static constexpr double kLimb = 0.3, kNeck = 0.06;
  static constexpr size_t kMostLimbs = 8;  // of one joint

  // From the joint's parent to the farthest end below the joint.
  double Extent(int joint) const { return length_[joint] + reach_[joint]; }

  std::vector<int> LongChildren(int joint, double at_least) const {
    std::vector<int> out;
    for (int c : children_[joint]) {
      if (Extent(c) > at_least) out.push_back(c);
    }
    return out;
  }

  // Pairs of equal limbs without `left_out`: of one joint, or of the fork of a single branch (a
  // pelvis bone that carries both legs).
  std::vector<std::pair<int, int>> PairsBeside(const std::vector<int>& limbs, int left_out) const {
    std::vector<std::pair<int, int>> pairs;
    std::vector<int> others;
    for (const int limb : limbs) {
      if (limb != left_out) others.push_back(limb);
    }
    if (others.size() == 1) {
      int branch = others[0];
      const double at_least = kLimb * Extent(branch);
      while (LongChildren(branch, at_least).size() == 1) branch = LongChildren(branch, at_least)[0];
      others = LongChildren(branch, at_least);
      if (others.size() > kMostLimbs) return {};
    }
    for (size_t i = 0; i < others.size(); ++i) {
      for (size_t j = i + 1; j < others.size(); ++j) {
        if (AboutEqual(Extent(others[i]), Extent(others[j]))) {
          pairs.emplace_back(others[i], others[j]);
        }
      }
    }
    return pairs;
  }

  void AddReadings(int root, int trunk, int leg, int other_leg, std::vector<JointMap>* readings) {
    JointMap map;
    map.profile = "topology";
    map.root = root;
    std::vector<int> limbs;
    for (int branch = trunk;;) {
      map.spine.push_back(branch);
      limbs = LongChildren(branch, kNeck * reach_[root]);
      if (limbs.size() != 1) break;
      branch = limbs[0];
    }
    if (limbs.size() < 3 || limbs.size() > kMostLimbs) return;
    if (!StandsUpright(root, map.spine.back(), leg, other_leg)) {
      for (const int neck : limbs) met_animal_ = met_animal_ || !PairsBeside(limbs, neck).empty();
      return;
    }
    if (!FillLeg(leg, &map.left) || !FillLeg(other_leg, &map.right)) return;
    for (const int neck : limbs) {
      for (const auto& [arm, other_arm] : PairsBeside(limbs, neck)) {
        // The neck is shorter than the arms.
        const double arms = std::min(Extent(arm), Extent(other_arm));
        if (Extent(neck) > arms || AboutEqual(Extent(neck), arms)) continue;
        JointMap reading = map;
        if (!FillArm(arm, &reading.left) || !FillArm(other_arm, &reading.right)) continue;
        const std::vector<int> path = LongestPath(neck);
        if (path.size() > 1) reading.neck = {path[0]};
        reading.head = path[std::min<size_t>(1, path.size() - 1)];
        readings->push_back(reading);
      }
    }
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

  // Whether the trunk ever continues the legs, as a human's does.
  bool StandsUpright(int root, int top, int leg, int other_leg) const {
    constexpr double kCosine = 0.5;
    const int foot = LongestPath(leg).back(), other_foot = LongestPath(other_leg).back();
    return std::any_of(poses_.begin(), poses_.end(), [&](const PosedRig& pose) {
      const auto& p = pose.position;
      const Vec3 trunk = p[top] - p[root];
      const Vec3 legs = p[leg] + p[other_leg] - p[foot] - p[other_foot];
      return trunk.dot(legs) > kCosine * trunk.norm() * legs.norm();
    });
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
  const std::vector<PosedRig>& poses_;
  bool met_animal_ = false;
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

// Arms and trunk against legs, wide enough for children, giants and cartoons.
bool HasHumanLimbs(const std::vector<PosedRig>& poses, const RigPoints& p) {
  const auto length = [&](const RigPoint& a, const RigPoint& b) {
    return MedianDistance(poses, a, b);
  };
  const double leg = length(p.left.hip, p.left.knee) + length(p.left.knee, p.left.ankle);
  const double arm = length(p.left.shoulder, p.left.elbow) + length(p.left.elbow, p.left.wrist);
  const double trunk = length(p.root, p.neck);
  return arm > 0.35 * leg && arm < 1.3 * leg && trunk > 0.25 * leg && trunk < 1.5 * leg;
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

// Whether the trunk continues the legs, as a human's does and an animal's does not: at rest, or
// nearly straight in most poses, since a galloping animal stretches its legs. Legs end at the toes,
// on which animals stand.
bool TrunkContinuesLegs(const Rig& rig, const std::vector<PosedRig>& poses, const RigPoints& p) {
  constexpr double kAtRest = 0.5, kStraight = 0.8;  // cosines
  const auto foot = [](const RigPoints::Side& side) {
    return side.toe.known() ? side.toe : side.ankle;
  };
  const auto continues = [&](const PosedRig& pose, double cosine) {
    const Vec3 trunk = At(pose, p.neck) - At(pose, p.root);
    const Vec3 legs = At(pose, p.left.hip) + At(pose, p.right.hip) - At(pose, foot(p.left)) -
                      At(pose, foot(p.right));
    return trunk.dot(legs) > cosine * trunk.norm() * legs.norm();
  };
  RigFrame rest;
  for (const RigJoint& joint : rig.joints) {
    rest.translation.push_back(joint.offset);
    rest.rotation.push_back(joint.rest_rotation);
  }
  const auto straight = std::ranges::count_if(
      poses, [&](const PosedRig& pose) { return continues(pose, kStraight); });
  return continues(PoseRig(rig, rest), kAtRest) || 2 * static_cast<size_t>(straight) > poses.size();
}

}  // namespace

std::string ShapeFault(const Rig& rig, const std::vector<PosedRig>& poses, const JointMap& map) {
  const RigPoints points = FindPoints(rig, poses, map, FindChestBone(rig, poses, map));
  if (!TrunkContinuesLegs(rig, poses, points)) {
    return "the trunk lies across the legs, as that of an animal does";
  }
  if (!HasHumanLimbs(poses, points))
    return "arms, legs and trunk have not the lengths of a human's";
  return "";
}

ShapeMatch MatchShape(const Rig& rig, const std::vector<PosedRig>& poses) {
  if (rig.joints.empty() || poses.empty()) return {};
  ShapeMatch match;
  int humans = 0;
  ShapeMatcher matcher(rig, poses);
  for (JointMap& map : matcher.Match()) {
    const RigPoints points = FindPoints(rig, poses, map, FindChestBone(rig, poses, map));
    if (!HasHumanLimbs(poses, points) || !TellSides(rig, poses, &map)) continue;
    ++humans;
    match.map = std::move(map);
  }
  if (humans == 0 && matcher.met_animal()) {
    match.refusal = "the trunk lies across the legs in every frame, as that of an animal does";
  }
  if (humans != 1) match.map.reset();
  if (humans > 1) match.refusal = "the shape of its tree can be read in more than one way";
  return match;
}

}  // namespace retarget::io
