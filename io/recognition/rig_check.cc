#include "io/recognition/rig_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "io/recognition/map_joints.h"
#include "io/recognition/rig_units.h"
#include "io/text/quoted.h"

namespace retarget::io {
namespace {

using Side = RigPoints::Side;

class RigCheck {
 public:
  RigCheck(const RigMeasure& figure, RigFacts* facts) : figure_(figure), facts_(facts) {}

  void Run() {
    CheckEqualSides();
    CheckMiddleJoints();
    CheckMirroring();
    CheckUpright();
    NoteVirtualJoints();
    facts_->facing = Facing();
    facts_->confidence = (facts_->confidence + static_cast<double>(passed_) / checks_) / 2;
  }

 private:
  void Count(bool passed) {
    ++checks_;
    passed_ += passed ? 1 : 0;
  }

  double Length(const RigPoint& a, const RigPoint& b) const {
    return MedianDistance(figure_.poses, a, b);
  }

  void CheckEqualSides() {
    constexpr double kUnequal = 0.15;
    const std::tuple<const char*, RigPoint Side::*, RigPoint Side::*> bones[] = {
        {"upper arms", &Side::shoulder, &Side::elbow},
        {"forearms", &Side::elbow, &Side::wrist},
        {"thighs", &Side::hip, &Side::knee},
        {"shins", &Side::knee, &Side::ankle}};
    const RigPoints& p = figure_.points;
    for (const auto& [name, from, to] : bones) {
      const double left = Length(p.left.*from, p.left.*to);
      const double right = Length(p.right.*from, p.right.*to);
      const bool equal = std::abs(left - right) <= kUnequal * std::max(left, right);
      Count(equal);
      if (equal) continue;
      facts_->notes.push_back(fmt::format("left and right {} differ: {:.3f} m and {:.3f} m", name,
                                          left * facts_->metres_per_unit,
                                          right * facts_->metres_per_unit));
    }
  }

  // A knee stands about half way between hip and ankle, an elbow between shoulder and wrist.
  void CheckMiddleJoints() {
    constexpr double kLeast = 0.3;  // share of the limb
    for (const auto& [name, side] :
         {std::pair("left", &figure_.points.left), {"right", &figure_.points.right}}) {
      const std::tuple<const char*, RigPoint, RigPoint, RigPoint> limbs[] = {
          {"elbow", side->shoulder, side->elbow, side->wrist},
          {"knee", side->hip, side->knee, side->ankle}};
      for (const auto& [joint, from, middle, to] : limbs) {
        const double upper = Length(from, middle), lower = Length(middle, to);
        const bool fits = std::min(upper, lower) >= kLeast * (upper + lower);
        Count(fits);
        if (fits) continue;
        facts_->notes.push_back(
            fmt::format("the {} {} is not half way along its limb ({:.0f} % of it)", name, joint,
                        100 * upper / (upper + lower)));
      }
    }
  }

  // Where both knees bend to, which is forwards whatever the feet do; zero where legs are straight.
  Vec3 KneesDirection(const PosedRig& pose) const {
    constexpr double kBent = 0.15;  // off the line from hip to ankle, share of the leg
    Vec3 sum = Vec3::Zero();
    for (const Side* side : {&figure_.points.left, &figure_.points.right}) {
      const Vec3 hip = At(pose, side->hip), knee = At(pose, side->knee);
      const Vec3 ankle = At(pose, side->ankle);
      const Vec3 off = knee - (hip + ankle) / 2;
      if (off.norm() > kBent * ((knee - hip).norm() + (ankle - knee).norm())) sum += off;
    }
    return sum;
  }

  // Left must be left of where the feet point, else the file may be mirrored or its names
  // exchanged.
  void CheckMirroring() {
    int right_way = 0, wrong_way = 0;
    for (const PosedRig& pose : figure_.poses) {
      const Vec3 across = At(pose, figure_.points.left.hip) - At(pose, figure_.points.right.hip);
      const Vec3 feet = FeetDirection(pose, figure_.points);
      if (feet.dot(KneesDirection(pose)) < 0) continue;  // legs drawn up, heels to the front
      const double left = UpAxis(*facts_).cross(feet).dot(across);
      if (left > 0) ++right_way;
      if (left < 0) ++wrong_way;
    }
    const bool mirrored = wrong_way > 4 * right_way;
    Count(!mirrored);
    if (mirrored) {
      facts_->notes.push_back("left and right look exchanged: the file may be mirrored");
    }
  }

  // The head above the hips and the hips above the ankles, in the pose that stands best.
  void CheckUpright() {
    const PosedRig& pose = StandingPose(figure_);
    const RigPoints& p = figure_.points;
    const Vec3 hips = (At(pose, p.left.hip) + At(pose, p.right.hip)) / 2;
    const Vec3 up = UpAxis(*facts_);
    Count((At(pose, p.head) - hips).dot(up) > 0);
    Count((hips - MidAnkle(pose, p)).dot(up) > 0);
  }

  void NoteVirtualJoints() {
    std::string list;
    for (const std::string& name : VirtualJoints(figure_)) {
      facts_->virtual_joints.push_back(name);
      list += (list.empty() ? "" : ", ") + name;
    }
    if (list.empty()) return;
    facts_->notes.push_back("no bone plays " + list +
                            ": virtual, put at tabulated places, and locked");
  }

  double Facing() const {
    const PosedRig& pose = StandingPose(figure_);
    const RigPoints& p = figure_.points;
    for (const auto& [l, r] :
         {std::pair(p.left.hip, p.right.hip), {p.left.shoulder, p.right.shoulder}}) {
      const Vec3 left = At(pose, l) - At(pose, r);
      const Vec3 ahead = left.cross(UpAxis(*facts_));
      if (ahead.norm() < 1e-6 * left.norm() || left.norm() == 0) continue;
      return facts_->up == 'y' ? std::atan2(ahead.x(), ahead.z())
                               : std::atan2(ahead.x(), -ahead.y());
    }
    return 0;
  }

  const RigMeasure& figure_;
  RigFacts* facts_;
  int checks_ = 0, passed_ = 0;
};

}  // namespace

void CheckRig(const RigMeasure& figure, RigFacts* facts) { RigCheck(figure, facts).Run(); }

void RefuseLimbsWithoutLength(const RigMeasure& figure, const std::string& file) {
  constexpr double kLeast = 1e-3;  // of the stature
  const std::tuple<const char*, RigPoint Side::*, RigPoint Side::*> limbs[] = {
      {"upper arm", &Side::shoulder, &Side::elbow},
      {"forearm", &Side::elbow, &Side::wrist},
      {"thigh", &Side::hip, &Side::knee},
      {"shin", &Side::knee, &Side::ankle}};
  const double height = FigureHeight(figure);
  if (!(height > 0)) return;  // all joints in one point
  for (const auto& [word, side] :
       {std::pair("left", &figure.points.left), {"right", &figure.points.right}}) {
    for (const auto& [limb, from, to] : limbs) {
      if (MedianDistance(figure.poses, side->*from, side->*to) > kLeast * height) continue;
      const auto name = [&](const RigPoint& point) {
        return QuotedWord(figure.rig->joints[point.joint].name);
      };
      throw InputError(
          fmt::format("{}: the {} {} has no length: {} and {} stand in one place, expected a bone "
                      "between them",
                      file, word, limb, name(side->*from), name(side->*to)));
    }
  }
}

}  // namespace retarget::io
