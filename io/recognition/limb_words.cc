#include "io/recognition/limb_words.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "io/recognition/figure_tree.h"
#include "model/rig/points.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

using Side = JointMap::Side;

// The joints of a limb from the trunk outwards, and how well each part of the body fits: as sure
// words count more than words of two meanings.
struct Fit {
  BodyPart part;
  double score;
};
struct Role {
  int Side::*joint;
  bool required;
  std::array<Fit, 4> fits;
};
using Limb = std::array<Role, 4>;
constexpr Fit kNoFit = {BodyPart::kNone, 0};
constexpr Limb kArm = {
    {{&Side::clavicle,
      false,
      {{{BodyPart::kClavicle, 4}, {BodyPart::kShoulder, 2}, kNoFit, kNoFit}}},
     {&Side::shoulder,
      true,
      {{{BodyPart::kUpperArm, 4}, {BodyPart::kShoulder, 2}, {BodyPart::kArm, 2}, kNoFit}}},
     {&Side::elbow, true, {{{BodyPart::kForearm, 4}, {BodyPart::kArm, 1}, kNoFit, kNoFit}}},
     {&Side::wrist, false, {{{BodyPart::kWrist, 4}, {BodyPart::kHand, 3}, kNoFit, kNoFit}}}}};
constexpr Limb kLeg = {
    {{&Side::hip,
      true,
      {{{BodyPart::kThigh, 4}, {BodyPart::kHip, 2.5}, {BodyPart::kLeg, 2}, kNoFit}}},
     {&Side::knee, true, {{{BodyPart::kShin, 4}, {BodyPart::kLeg, 2}, kNoFit, kNoFit}}},
     {&Side::ankle, false, {{{BodyPart::kAnkle, 4}, {BodyPart::kFoot, 3}, kNoFit, kNoFit}}},
     {&Side::toe, false, {{{BodyPart::kToe, 4}, {BodyPart::kFoot, 1.5}, kNoFit, kNoFit}}}}};

double FitOf(const Role& role, BodyPart part) {
  constexpr double kRequired = 3;  // a limb is found by its two long bones
  for (const Fit& fit : role.fits) {
    if (fit.score > 0 && fit.part == part) return fit.score + (role.required ? kRequired : 0);
  }
  return 0;
}

// The best assignment of a path's joints to the roles of a limb, both in order.
struct Alignment {
  double score = 0;
  std::array<int, 4> joint = {-1, -1, -1, -1};
};
Alignment Align(const Limb& limb, const std::vector<JointWords>& words,
                const std::vector<int>& path) {
  // best[r]: of the joints so far with the roles before r.
  std::array<Alignment, 5> best;
  for (const int joint : path) {
    for (size_t r = 4; r-- > 0;) {
      const double fit = FitOf(limb[r], words[joint].part);
      if (fit == 0) continue;
      // The best of all that end at an earlier role.
      const Alignment* from = &best[0];
      for (size_t e = 1; e <= r; ++e) {
        if (best[e].score > from->score) from = &best[e];
      }
      if (from->score + fit <= best[r + 1].score) continue;
      Alignment next = *from;
      next.score += fit;
      next.joint[r] = joint;
      best[r + 1] = next;
    }
  }
  return *std::max_element(best.begin(), best.end(), [](const Alignment& a, const Alignment& b) {
    return a.score < b.score;
  });
}

// The first joint of that word beyond the arms.
int HeadByWords(const Rig& rig, const std::vector<JointWords>& words, const JointMap& map) {
  const int arms = CommonAncestor(rig, map.left.shoulder, map.right.shoulder);
  for (int j = 0; arms >= 0 && j < rig.num_joints(); ++j) {
    const bool on_arm =
        DescendsFrom(rig, j, map.left.shoulder) || DescendsFrom(rig, j, map.right.shoulder);
    if (words[j].part == BodyPart::kHead && j != arms && !on_arm && DescendsFrom(rig, j, arms)) {
      return j;
    }
  }
  return -1;
}

// ArrangeTrunk with the necks that the words tell.
bool ArrangeByWords(const Rig& rig, const std::vector<JointWords>& words, JointMap* map) {
  const auto named_necks = [&](int root) {
    std::vector<int> named;
    for (int j = 0; j < rig.num_joints(); ++j) {
      if (words[j].part == BodyPart::kNeck && DescendsFrom(rig, j, root)) named.push_back(j);
    }
    return named;
  };
  bool neck_named = false;
  return ArrangeTrunk(rig, named_necks, map, &neck_named);
}

class WordMatcher {
 public:
  WordMatcher(const Rig& rig, const std::vector<JointWords>& words,
              const std::vector<PosedRig>& poses)
      : rig_(rig), words_(words), poses_(poses) {}

  NameMatch Match() {
    NameMatch match;
    match.map.profile = "words";
    for (const auto& [side, joints] :
         {std::pair(BodySide::kLeft, &match.map.left), {BodySide::kRight, &match.map.right}}) {
      FindLimb(kArm, side, joints);
      FindLimb(kLeg, side, joints);
    }
    for (const Limb* limb : {&kArm, &kLeg}) {
      const int fork = ForkOf(*limb, match.map);
      FillGap(*limb, fork, &match.map.left);
      FillGap(*limb, fork, &match.map.right);
      MirrorPlaces(*limb, match.map.left, &match.map.right);
      MirrorPlaces(*limb, match.map.right, &match.map.left);
    }
    for (const auto& [side, name] :
         {std::pair(&match.map.left, "left_"), {&match.map.right, "right_"}}) {
      for (const auto& [part, joint] : {std::pair("shoulder", side->shoulder),
                                        {"elbow", side->elbow},
                                        {"hip", side->hip},
                                        {"knee", side->knee}}) {
        if (joint < 0) match.missing.push_back(std::string(name) + part);
      }
    }
    if (match.missing.empty()) Arrange(&match);
    return match;
  }

 private:
  void FindLimb(const Limb& limb, BodySide side, Side* joints) const {
    Alignment best;
    for (int end = 0; end < rig_.num_joints(); ++end) {
      if (words_[end].side != side) continue;
      std::vector<int> path;
      for (int j = end; j >= 0; j = rig_.joints[j].parent) {
        if (words_[j].side == side) path.push_back(j);
      }
      std::reverse(path.begin(), path.end());
      Alignment found = Align(limb, words_, path);
      if (found.score > best.score) best = found;
    }
    for (size_t r = 0; r < 4; ++r) joints->*limb[r].joint = best.joint[r];
  }

  // The joint that carries both limbs; -1 where the words tell no joint of one of them.
  int ForkOf(const Limb& limb, const JointMap& map) const {
    for (const Role& left : limb) {
      for (const Role& right : limb) {
        const int a = map.left.*left.joint, b = map.right.*right.joint;
        if (a >= 0 && b >= 0) return CommonAncestor(rig_, a, b);
      }
    }
    return -1;
  }

  double Length(int from, int to) const {
    return MedianDistance(poses_, {from, Vec3::Zero()}, {to, Vec3::Zero()});
  }

  // The two long bones of a limb between what the words tell of it: of the joints there whose words
  // say nothing, those that part it most evenly.
  void FillGap(const Limb& limb, int fork, Side* side) const {
    int &upper = side->*limb[1].joint, &lower = side->*limb[2].joint;  // of an arm
    int &above = side->*limb[0].joint, &end = side->*limb[3].joint;
    if (&limb == &kArm) {
      Part(fork, &above, &upper, &lower, end);
    } else {
      int none = -1;
      Part(fork, &none, &above, &upper, lower);
    }
  }

  void Part(int fork, int* collar, int* upper, int* lower, int end) const {
    if (end < 0 || (*upper >= 0 && *lower >= 0)) return;
    const int top = *upper >= 0 ? *upper : *collar >= 0 ? *collar : fork;
    if (top < 0 || !DescendsFrom(rig_, end, top)) return;
    std::vector<int> between;
    for (const int j : Between(rig_, top, end)) {
      if (words_[j].part == BodyPart::kNone || j == *lower) between.push_back(j);
    }
    // A "shoulder" with two joints before the hand was the collar bone.
    if (*upper >= 0 && *collar < 0 && words_[*upper].part == BodyPart::kShoulder &&
        between.size() >= 2) {
      *collar = std::exchange(*upper, -1);
    }
    double most = -1;
    int best_upper = -1, best_lower = -1;
    std::vector<int> uppers = between;
    if (*upper >= 0) uppers = {*upper};
    for (const int u : uppers) {
      for (const int l : between) {
        if (!DescendsFrom(rig_, l, u) || l == u || (*lower >= 0 && l != *lower)) continue;
        const double first = Length(u, l), second = Length(l, end);
        const double alike = std::min(first, second);
        if (alike <= most) continue;
        most = alike;
        best_upper = u;
        best_lower = l;
      }
    }
    if (best_upper < 0) return;
    *upper = best_upper;
    *lower = best_lower;
  }

  // The child with most joints below it, -1 at a leaf.
  int MainChild(int joint) const {
    int best = -1, most = 0;
    for (const int child : rig_.ChildrenOf(joint)) {
      int below = 0;
      for (int j = child; j < rig_.num_joints(); ++j) below += DescendsFrom(rig_, j, child) ? 1 : 0;
      if (words_[child].part == BodyPart::kHelper || below <= most) continue;
      best = child;
      most = below;
    }
    return best;
  }

  int StepsBetween(int ancestor, int joint) const {
    return static_cast<int>(Between(rig_, ancestor, joint).size()) + 1;
  }

  // Joints that `from` has and `to` has not: as many steps from a neighbour that both have.
  void MirrorPlaces(const Limb& limb, const Side& from, Side* to) const {
    for (size_t r = 0; r < 4; ++r) {
      const int there = from.*limb[r].joint;
      int& here = to->*limb[r].joint;
      if (there < 0 || here >= 0) continue;
      for (size_t n = r; n-- > 0 && here < 0;) {
        const int base = from.*limb[n].joint, own = to->*limb[n].joint;
        if (base < 0 || own < 0) continue;
        here = own;
        for (int step = StepsBetween(base, there); step > 0 && here >= 0; --step) {
          here = MainChild(here);
        }
      }
      for (size_t n = r + 1; n < 4 && here < 0; ++n) {
        const int base = from.*limb[n].joint, own = to->*limb[n].joint;
        if (base < 0 || own < 0) continue;
        here = own;
        for (int step = StepsBetween(there, base); step > 0 && here >= 0; --step) {
          here = rig_.joints[here].parent;
        }
      }
      if (here >= 0 && !MayBe(limb[r], here, there)) here = -1;
    }
  }

  // Whether a joint may be what `there` is on the other side: its words do not speak against it,
  // and it carries neither the other limb nor hangs from it.
  bool MayBe(const Role& role, int joint, int there) const {
    const BodyPart part = words_[joint].part;
    if (part != BodyPart::kNone && FitOf(role, part) == 0) return false;
    return words_[joint].side != words_[there].side && !DescendsFrom(rig_, there, joint) &&
           !DescendsFrom(rig_, joint, there);
  }

  void Arrange(NameMatch* match) {
    JointMap& map = match->map;
    map.head = HeadByWords(rig_, words_, map);
    if (!ArrangeByWords(rig_, words_, &map)) {
      match->misplaced.push_back("arms and legs share no root");
      return;
    }
    for (const int joint : {map.left.hip, map.right.hip}) {
      if (joint == map.root) {
        match->misplaced.push_back("'" + rig_.joints[joint].name + "' carries the other limbs");
      }
    }
    int found = 1 + (map.head >= 0) + !map.spine.empty() + !map.neck.empty();
    for (const Side* side : {&map.left, &map.right}) {
      for (const int joint : {side->clavicle, side->shoulder, side->elbow, side->wrist, side->hip,
                              side->knee, side->ankle}) {
        found += joint >= 0 ? 1 : 0;
      }
    }
    match->share = found / 18.0;
    match->score = found;
  }

  const Rig& rig_;
  const std::vector<JointWords>& words_;
  const std::vector<PosedRig>& poses_;
};

class PartFiller {
 public:
  PartFiller(const Rig& rig, const std::vector<JointWords>& words,
             const std::vector<PosedRig>& poses, JointMap* map)
      : rig_(rig), words_(words), poses_(poses), map_(*map) {}

  std::vector<std::string> Fill() {
    FillHead();
    for (const auto& [name, side, left] :
         {std::tuple("left_", &map_.left, true), {"right_", &map_.right, false}}) {
      name_ = name;
      side_ = left ? BodySide::kLeft : BodySide::kRight;
      FillEnd(side->shoulder, side->elbow, {BodyPart::kWrist, BodyPart::kHand}, "wrist",
              &side->wrist);
      FillEnd(side->hip, side->knee, {BodyPart::kAnkle, BodyPart::kFoot}, "ankle", &side->ankle);
      FillByWords(side->ankle, {BodyPart::kToe, BodyPart::kFoot}, &side->toe);
      FillToe(side->knee, side->ankle, &side->toe);
      FillByWords(side->wrist, {BodyPart::kMiddleFinger, BodyPart::kMiddleFinger}, &side->hand);
    }
    FillClavicles();
    return std::move(filled_);
  }

 private:
  using Parts = std::array<BodyPart, 2>;

  double Length(int from, int to) const {
    return MedianDistance(poses_, {from, Vec3::Zero()}, {to, Vec3::Zero()});
  }

  bool IsTaken(int joint) const {
    for (const Side* side : {&map_.left, &map_.right}) {
      for (const int taken : {side->clavicle, side->shoulder, side->elbow, side->wrist, side->hand,
                              side->hip, side->knee, side->ankle, side->toe}) {
        if (taken == joint) return true;
      }
    }
    return joint == map_.root || joint == map_.head || joint == map_.head_top ||
           std::ranges::count(map_.spine, joint) > 0 || std::ranges::count(map_.neck, joint) > 0;
  }

  // The first joint below `above` of the first of the parts that has one there, apart from it.
  int FindBelow(int above, const Parts& parts) const {
    for (const BodyPart part : parts) {
      for (int j = above + 1; j < rig_.num_joints(); ++j) {
        const bool fits = words_[j].part == part &&
                          (words_[j].side == side_ || words_[j].side == BodySide::kNone);
        if (fits && !IsTaken(j) && DescendsFrom(rig_, j, above) && Length(above, j) > 0) return j;
      }
    }
    return -1;
  }

  void FillByWords(int above, const Parts& parts, int* joint) const {
    if (*joint < 0 && above >= 0) *joint = FindBelow(above, parts);
  }

  // Wrist or ankle: by its words, else the only bone that goes on from the elbow or knee, passing
  // bones that split the forearm or shin.
  void FillEnd(int upper, int lower, const Parts& parts, const char* part, int* joint) {
    if (*joint >= 0) return;
    const double length = Length(upper, lower);
    const auto is_end = [&](int j) {
      constexpr double kShortest = 0.5, kLongest = 1.8;  // of the bone above
      const double is = Length(lower, j);
      return is > kShortest * length && is < kLongest * length;
    };
    const int named = FindBelow(lower, parts);
    if (named >= 0 && is_end(named)) {
      *joint = named;
      return;
    }
    for (int at = OnlyChild(lower); at >= 0; at = OnlyChild(at)) {
      if (!is_end(at)) continue;
      *joint = at;
      Note(part, at);
      return;
    }
  }

  // The one bone that goes on from the ankle, if it is as long as a foot may be.
  void FillToe(int knee, int ankle, int* toe) {
    constexpr double kShortest = 0.1, kLongest = 0.7;  // of the shin
    if (*toe >= 0 || ankle < 0) return;
    const int only = OnlyChild(ankle);
    if (only < 0) return;
    const double shin = Length(knee, ankle), is = Length(ankle, only);
    if (is < kShortest * shin || is > kLongest * shin) return;
    *toe = only;
    Note("toe", only);
  }

  // The one child that may be a joint of the body; -1 where there are none or several.
  int OnlyChild(int joint) const {
    int only = -1;
    for (const int child : rig_.ChildrenOf(joint)) {
      if (words_[child].part == BodyPart::kHelper || IsTaken(child)) continue;
      if (only >= 0) return -1;
      only = child;
    }
    return only;
  }

  // A bone between the trunk and each shoulder; of both sides or of none.
  void FillClavicles() {
    if (map_.left.clavicle >= 0 || map_.right.clavicle >= 0) return;
    const int fork = CommonAncestor(rig_, map_.left.shoulder, map_.right.shoulder);
    if (fork < 0) return;
    int found[2] = {-1, -1};
    for (int s = 0; s < 2; ++s) {
      for (const int j : Between(rig_, fork, (s == 0 ? map_.left : map_.right).shoulder)) {
        const bool helper = words_[j].part == BodyPart::kHelper;
        if (found[s] < 0 && !helper && !IsTaken(j)) found[s] = j;
      }
    }
    if (found[0] < 0 || found[1] < 0) return;
    map_.left.clavicle = found[0];
    map_.right.clavicle = found[1];
    name_ = "left_";
    Note("clavicle", found[0]);
    name_ = "right_";
    Note("clavicle", found[1]);
  }

  // By its word, and the neck with it; else the only bones that go on above the arms or the neck.
  void FillHead() {
    if (map_.head >= 0) return;
    JointMap by_words = map_;
    by_words.head = HeadByWords(rig_, words_, map_);
    if (ArrangeByWords(rig_, words_, &by_words) && (by_words.head >= 0 || map_.neck.empty())) {
      map_ = by_words;
    }
    if (map_.head >= 0) return;
    name_ = "";
    if (!map_.neck.empty()) {
      map_.head = OnlyChild(map_.neck.back());
      if (map_.head >= 0) Note("head", map_.head);
      return;
    }
    const int arms = CommonAncestor(rig_, map_.left.shoulder, map_.right.shoulder);
    const int first = OnlyAbove(arms);
    if (first < 0) return;
    const int second = OnlyChild(first);
    map_.head = second >= 0 ? second : first;
    if (second >= 0) map_.neck = {first};
    if (second >= 0) Note("neck", first);
    Note("head", map_.head);
  }

  // The one child of the bone that carries the arms that carries none of them and continues the
  // trunk.
  int OnlyAbove(int arms) const {
    constexpr double kCosine = 0.5;
    int only = -1;
    for (const int child : rig_.ChildrenOf(arms)) {
      const bool carries = DescendsFrom(rig_, map_.left.shoulder, child) ||
                           DescendsFrom(rig_, map_.right.shoulder, child) ||
                           DescendsFrom(rig_, map_.left.hip, child) ||
                           DescendsFrom(rig_, map_.right.hip, child);
      if (carries || words_[child].part == BodyPart::kHelper || IsTaken(child)) continue;
      const bool continues = std::ranges::any_of(poses_, [&](const PosedRig& pose) {
        const auto& p = pose.position;
        const Vec3 hips = (p[map_.left.hip] + p[map_.right.hip]) / 2;
        const Vec3 trunk = p[arms] - hips, on = p[child] - p[arms];
        return on.dot(trunk) > kCosine * on.norm() * trunk.norm();
      });
      if (!continues) continue;
      if (only >= 0) return -1;
      only = child;
    }
    return only;
  }

  void Note(const char* part, int joint) {
    filled_.push_back(name_ + part + " ('" + rig_.joints[joint].name + "')");
  }

  const Rig& rig_;
  const std::vector<JointWords>& words_;
  const std::vector<PosedRig>& poses_;
  JointMap& map_;
  std::string name_;
  BodySide side_ = BodySide::kNone;
  std::vector<std::string> filled_;
};

}  // namespace

NameMatch MatchWords(const Rig& rig, const std::vector<JointWords>& words,
                     const std::vector<PosedRig>& poses) {
  return WordMatcher(rig, words, poses).Match();
}

std::vector<std::string> FillOpenParts(const Rig& rig, const std::vector<JointWords>& words,
                                       const std::vector<PosedRig>& poses, JointMap* map) {
  return PartFiller(rig, words, poses, map).Fill();
}

}  // namespace retarget::io
