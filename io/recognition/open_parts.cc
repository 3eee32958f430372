#include "io/recognition/open_parts.h"

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
    bool taken = false;
    VisitJoints(&map_, [&](const int* other) { taken = taken || *other == joint; });
    return taken;
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

std::vector<std::string> FillOpenParts(const Rig& rig, const std::vector<JointWords>& words,
                                       const std::vector<PosedRig>& poses, JointMap* map) {
  return PartFiller(rig, words, poses, map).Fill();
}

}  // namespace retarget::io
