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

}  // namespace

NameMatch MatchWords(const Rig& rig, const std::vector<JointWords>& words,
                     const std::vector<PosedRig>& poses) {
  return WordMatcher(rig, words, poses).Match();
}

}  // namespace retarget::io
