#include "io/recognition/loose_bones.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <set>

#include "model/rig/points.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

using Side = JointMap::Side;

// The words of a name in lower case: "IK_Foot.L" and "LeftFootIK" as "ik foot l", "left foot ik".
std::vector<std::string> WordsOf(const std::string& name) {
  std::vector<std::string> words(1);
  const auto is = [](int (*kind)(int), char c) { return kind(static_cast<unsigned char>(c)) != 0; };
  for (size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is(std::isalpha, c)) {
      words.emplace_back();
      continue;
    }
    const bool after_small = i > 0 && is(std::islower, name[i - 1]);
    const bool before_small = i + 1 < name.size() && is(std::islower, name[i + 1]);
    const bool after_capital = i > 0 && is(std::isupper, name[i - 1]);
    if (is(std::isupper, c) && (after_small || (after_capital && before_small))) {
      words.emplace_back();
    }
    words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  std::erase(words, "");
  return words;
}

bool Has(const std::vector<std::string>& words, std::initializer_list<const char*> any) {
  return std::any_of(any.begin(), any.end(), [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  });
}

// +1 left, -1 right, 0: the name does not say.
int SideOf(const std::vector<std::string>& words) {
  const bool left = Has(words, {"l", "left", "lf"}), right = Has(words, {"r", "right", "rt"});
  return left == right ? 0 : left ? 1 : -1;
}

bool IsPole(const std::vector<std::string>& words) {
  return Has(words, {"pole", "pv", "polevector", "poletarget", "pt", "hint"});
}

bool IsHandle(const std::vector<std::string>& words) {
  return IsPole(words) || Has(words, {"ik", "iks", "target", "goal", "effector", "ctrl", "ctl",
                                      "control", "controller", "handle", "iktarget"});
}

const Side& SideIn(const JointMap& map, int side) { return side > 0 ? map.left : map.right; }

// The joints that play a part.
std::set<int> UsedIn(const JointMap& map) {
  std::set<int> used = {map.root, map.head, map.head_top};
  used.insert(map.spine.begin(), map.spine.end());
  used.insert(map.neck.begin(), map.neck.end());
  for (const Side* s : {&map.left, &map.right}) {
    for (const int j : {s->clavicle, s->shoulder, s->elbow, s->wrist, s->hand, s->hip, s->knee,
                        s->ankle, s->toe}) {
      used.insert(j);
    }
  }
  used.erase(-1);
  return used;
}

PosedRig RestOf(const Rig& rig) {
  RigFrame rest;
  for (const RigJoint& joint : rig.joints) {
    rest.translation.push_back(joint.offset);
    rest.rotation.push_back(joint.rest_rotation);
  }
  return PoseRig(rig, rest);
}

// Whether `foot` stands at the end of a shin in a pose: as far below the knee as a shin is long,
// and at the shin bone's own end where it has one.
bool EndsShin(const Rig& rig, const PosedRig& pose, const Side& side, int foot) {
  constexpr double kShin = 0.246 / 0.245, kShortest = 0.7, kLongest = 1.4;  // of the thigh
  constexpr double kOff = 0.15;                                             // of the shin
  const Vec3 knee = pose.position[side.knee];
  const double thigh = (knee - pose.position[side.hip]).norm();
  const double shin = (pose.position[foot] - knee).norm();
  if (shin < kShortest * kShin * thigh || shin > kLongest * kShin * thigh) return false;
  std::vector<Vec3> ends;
  if (const auto& end = rig.joints[side.knee].end_site) {
    ends.push_back(knee + pose.rotation[side.knee] * *end);
  }
  for (const int child : rig.ChildrenOf(side.knee)) ends.push_back(pose.position[child]);
  if (ends.empty()) return true;
  return std::any_of(ends.begin(), ends.end(), [&](const Vec3& end) {
    return (end - pose.position[foot]).norm() < kOff * shin;
  });
}

// A handle stays where it is when the limb moves away.
bool KeepsItsDistance(const std::vector<PosedRig>& poses, int knee, int foot) {
  constexpr double kPlay = 0.1;  // of the length
  const double length = MedianDistance(poses, {knee, Vec3::Zero()}, {foot, Vec3::Zero()});
  return std::all_of(poses.begin(), poses.end(), [&](const PosedRig& pose) {
    return std::abs((pose.position[foot] - pose.position[knee]).norm() - length) < kPlay * length;
  });
}

class FollowerFinder {
 public:
  FollowerFinder(const RigMotion& motion, const JointMap& map, double size)
      : rig_(motion.rig), map_(map), size_(size), poses_(SamplePoses(motion)), used_(UsedIn(map)) {}

  std::vector<RigFollower> Find() const {
    std::vector<RigFollower> out;
    const int tree = TopOf(rig_, map_.root);
    for (int j = 0; j < rig_.num_joints(); ++j) {
      if (used_.contains(j) || DescendsFrom(rig_, map_.root, j)) continue;
      // What a used bone hangs from is part of the figure.
      if (std::any_of(used_.begin(), used_.end(),
                      [&](int u) { return DescendsFrom(rig_, u, j); })) {
        continue;
      }
      int target = ByName(j);
      const bool apart = !DescendsFrom(rig_, j, map_.root);
      if (target < 0) target = ByLimb(j);
      if (target < 0 && apart && (TopOf(rig_, j) == tree || IsSmall(TopOf(rig_, j))))
        target = ByPlace(j);
      if (target >= 0 && !DescendsFrom(rig_, j, target)) out.push_back({j, target});
    }
    return out;
  }

 private:
  // Another figure's bones are its own.
  bool IsSmall(int top) const {
    constexpr int kFewest = 9;  // joints of a human
    int count = 0;
    for (int j = top; j < rig_.num_joints(); ++j) count += DescendsFrom(rig_, j, top) ? 1 : 0;
    return count < kFewest;
  }

  // The bone that a target's name speaks of, -1 where it is none.
  int ByName(int joint) const {
    const std::vector<std::string> words = WordsOf(rig_.joints[joint].name);
    // A target's parent ("ik_foot_root") stays.
    if (!IsHandle(words) || Has(words, {"root", "master", "parent"})) return -1;
    int side = SideOf(words);
    const bool leg = Has(words, {"foot", "ankle", "leg", "heel", "knee", "toe", "shin"});
    const bool arm = Has(words, {"hand", "wrist", "arm", "elbow", "forearm"});
    if (leg == arm) return -1;
    if (side == 0 && Has(words, {"gun", "weapon"})) side = -1;  // held in the right hand
    if (side == 0) side = Nearer(joint, leg);
    const Side& s = SideIn(map_, side);
    const bool pole = IsPole(words) || Has(words, {"knee", "elbow"});
    if (pole) return leg ? s.hip : s.shoulder;
    if (leg) return Has(words, {"toe"}) && s.toe >= 0 ? s.toe : s.ankle >= 0 ? s.ankle : s.knee;
    return s.wrist >= 0 ? s.wrist : s.elbow;
  }

  // The forearm or shin that has no hand or foot, of one that hangs elsewhere.
  int ByLimb(int joint) const {
    const std::vector<std::string> words = WordsOf(rig_.joints[joint].name);
    const int side = SideOf(words);
    if (side == 0 || IsHandle(words)) return -1;
    const bool leg = Has(words, {"foot", "ankle"}), arm = Has(words, {"hand", "wrist"});
    if (leg == arm) return -1;
    const Side& s = SideIn(map_, side);
    const int upper = leg ? s.hip : s.shoulder, lower = leg ? s.knee : s.elbow;
    if ((leg ? s.ankle : s.wrist) >= 0 || DescendsFrom(rig_, joint, lower)) return -1;
    constexpr double kForearm = 0.146 / 0.186, kShin = 0.246 / 0.245, kShort = 0.6, kLong = 1.6;
    const double length = (leg ? kShin : kForearm) *
                          MedianDistance(poses_, {upper, Vec3::Zero()}, {lower, Vec3::Zero()});
    const double is = MedianDistance(poses_, {lower, Vec3::Zero()}, {joint, Vec3::Zero()});
    const bool fits = is > kShort * length && is < kLong * length;
    // One that stays behind in the clip belongs to the limb all the same if it does so at rest.
    const bool at_rest = leg && EndsShin(rig_, RestOf(rig_), s, joint);
    return at_rest || (fits && KeepsItsDistance(poses_, lower, joint)) ? lower : -1;
  }

  int Nearer(int joint, bool leg) const {
    const auto distance = [&](const Side& s) {
      return MedianDistance(poses_, {joint, Vec3::Zero()}, {leg ? s.knee : s.elbow, Vec3::Zero()});
    };
    return distance(map_.left) <= distance(map_.right) ? 1 : -1;
  }

  // The bone at whose joint, or in whose frame, the joint stands throughout; -1 where there is
  // none.
  int ByPlace(int joint) const {
    constexpr double kAt = 0.03, kSteady = 0.005, kMoves = 0.03;  // of the figure
    const bool moves = Spread(joint, rig_.joints[joint].parent) > kMoves * size_;
    double least = HUGE_VAL;
    int best = -1;
    for (const int bone : used_) {
      const double far = Farthest(joint, bone), spread = Spread(joint, bone);
      const bool with = far < kAt * size_ || (moves && spread < kSteady * size_);
      // Of several the one nearest by: what is carried turns with the hand, not with the elbow.
      if (with && far < least) {
        least = far;
        best = bone;
      }
    }
    return best;
  }

  double Farthest(int joint, int bone) const {
    double far = 0;
    for (const PosedRig& pose : poses_) {
      far = std::max(far, (pose.position[joint] - pose.position[bone]).norm());
    }
    return far;
  }

  // How far the joint strays in the frame of a bone (-1: the file's).
  double Spread(int joint, int bone) const {
    const auto local = [&](const PosedRig& pose) -> Vec3 {
      if (bone < 0) return pose.position[joint];
      return pose.rotation[bone].conjugate() * (pose.position[joint] - pose.position[bone]);
    };
    double spread = 0;
    for (const PosedRig& pose : poses_) {
      spread = std::max(spread, (local(pose) - local(poses_.front())).norm());
    }
    return spread;
  }

  const Rig& rig_;
  const JointMap& map_;
  double size_;  // stature, file units
  std::vector<PosedRig> poses_;
  std::set<int> used_;
};

}  // namespace

std::vector<std::string> FindLooseFeet(const RigMotion& motion, JointMap* map) {
  const Rig& rig = motion.rig;
  std::vector<std::string> names;
  std::vector<PosedRig> poses;
  for (const int sign : {1, -1}) {
    Side& side = sign > 0 ? map->left : map->right;
    if (side.ankle >= 0 || side.knee < 0 || side.hip < 0) continue;
    if (poses.empty()) poses = SamplePoses(motion);
    const std::set<int> used = UsedIn(*map);
    for (int j = 0; j < rig.num_joints() && side.ankle < 0; ++j) {
      const std::vector<std::string> words = WordsOf(rig.joints[j].name);
      if (used.contains(j) || IsHandle(words) || SideOf(words) != sign) continue;
      if (!Has(words, {"foot", "ankle"}) || DescendsFrom(rig, j, side.knee)) continue;
      if (std::any_of(used.begin(), used.end(), [&](int u) { return DescendsFrom(rig, u, j); })) {
        continue;
      }
      const bool ends = EndsShin(rig, RestOf(rig), side, j) || EndsShin(rig, poses[0], side, j);
      if (!ends || !KeepsItsDistance(poses, side.knee, j)) continue;
      side.ankle = j;
      names.push_back(rig.joints[j].name);
      for (const int child : rig.ChildrenOf(j)) {
        if (side.toe < 0 && rig.joints[child].offset.norm() > 0) side.toe = child;
      }
    }
  }
  return names;
}

std::vector<RigFollower> FindFollowers(const RigMotion& motion, const JointMap& map,
                                       double metres_per_unit, double stature) {
  return FollowerFinder(motion, map, stature / metres_per_unit).Find();
}

}  // namespace retarget::io
