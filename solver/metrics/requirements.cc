#include "solver/metrics/requirements.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace retarget::solver {
namespace {

using Kind = RequirementKind;

class Requiring {
 public:
  Requiring(const MetricsContext& subject, const Metrics& metrics, const Requirements& requirements)
      : subject_(subject), m_(metrics), r_(requirements) {}

  std::vector<RequirementCheck> Run() {
    for (size_t k = 0; k < m_.tangles.size(); ++k) CheckTangle(static_cast<int>(k));
    CheckBetweenBodies();
    for (int f = 0; f < 2; ++f) CheckFigure(f);
    for (size_t k = 0; k < m_.hold_m.size(); ++k) CheckHold(static_cast<int>(k));
    for (int f = 0; f < 2; ++f) CheckPlausible(f);
    return std::move(checks_);
  }

 private:
  // What is to stay at or under its limit.
  RequirementCheck& AtMost(Kind kind, double value, double limit) {
    const bool met = std::isnan(value) || value <= limit;
    checks_.push_back({.kind = kind, .value = value, .limit = limit, .met = met});
    return checks_.back();
  }

  void CheckTangle(int k) {
    const Tangle& t = subject_.tangles[k].tag.tangle;
    const TangleMetrics& m = m_.tangles[k];
    const double value = m.smallest();
    checks_.push_back({.kind = Kind::kTangle,
                       .item = k,
                       .value = value,
                       .limit = r_.gli,
                       .met = value > r_.gli,
                       .frame = m.worst_frame,
                       .limbs = {{0, t.a.from}, {0, t.a.to}, {1, t.b.from}, {1, t.b.to}}});
  }

  void CheckBetweenBodies() {
    RequirementCheck& pass =
        AtMost(Kind::kPassThroughs, static_cast<double>(m_.pass_throughs.size()), r_.pass_throughs);
    if (!m_.pass_throughs.empty()) {
      const PassThrough& p = m_.pass_throughs[0];
      pass.frame = p.frame;
      pass.limbs = {{0, p.node_a}, {1, p.node_b}};
    }
    const double deepest = m_.deepest_m();
    AtMost(Kind::kPenetration, deepest, r_.penetration_m);
    AtMost(Kind::kPenetrationOver1cm, m_.penetration_over_1cm_percent, r_.penetration_1cm_percent);
    if (deepest <= 0) return;
    for (size_t k = checks_.size() - 2; k < checks_.size(); ++k) {
      checks_[k].frame = m_.penetration_frame;
      checks_[k].limbs = {{0, m_.penetration_node_a}, {1, m_.penetration_node_b}};
    }
  }

  void CheckFigure(int f) {
    const FigureMetrics& m = m_.figure[f];
    RequirementCheck& drift = AtMost(Kind::kFootDrift, m.foot_drift_m, r_.foot_drift_m);
    drift.figure = f;
    drift.frame = m.foot_drift_frame;
    if (drift.judged()) drift.limbs = {{f, m.foot_drift_node}};
    CheckSwings(f);
    CheckEdges(f);
    RequirementCheck& floor = AtMost(Kind::kFloor, m.floor_m, r_.floor_m);
    floor.figure = f;
    floor.frame = m.floor_frame;
    floor.limbs = {{f, m.floor_node}};
  }

  // Of what is the largest multiple of what it may be: `value_of` and `limit_of` of each. `limit`
  // is said where there is nothing to judge.
  template <typename Part, typename ValueOf, typename LimitOf>
  const Part* CheckWorst(Kind kind, int figure, const std::vector<Part>& parts, double limit,
                         const ValueOf& value_of, const LimitOf& limit_of) {
    const auto less = [&](const Part& x, const Part& y) {
      return value_of(x) * limit_of(y) < value_of(y) * limit_of(x);
    };
    const auto worst = std::max_element(parts.begin(), parts.end(), less);
    const bool none = worst == parts.end();
    RequirementCheck& check = none ? AtMost(kind, kNothingMeasured, limit)
                                   : AtMost(kind, value_of(*worst), limit_of(*worst));
    check.figure = figure;
    if (none) return nullptr;
    check.limbs = {{figure, worst->node}};
    return &*worst;
  }

  void CheckSwings(int f) {
    const Swing* worst = CheckWorst(
        Kind::kFootTravel, f, m_.figure[f].swings, r_.foot_travel_m,
        [](const Swing& s) { return s.travel_m; },
        [&](const Swing& s) {
          return std::max(r_.foot_travel_ratio * s.source_m, r_.foot_travel_m) +
                 kStrideNearFloor * s.stride_m;
        });
    if (worst) checks_.back().frame = worst->first;
  }

  void CheckEdges(int f) {
    const ContactEdge* worst = CheckWorst(
        Kind::kFootAcceleration, f, m_.figure[f].edges, r_.foot_acceleration,
        [](const ContactEdge& e) { return e.acceleration; },
        [&](const ContactEdge& e) {
          const double least =
              (e.swing_s > 0 ? kStrideAcceleration * e.stride_m / (e.swing_s * e.swing_s) : 0) +
              kLedAcceleration * e.led_m_s;
          return std::max(r_.foot_acceleration_ratio * e.source, r_.foot_acceleration) + least;
        });
    if (worst) checks_.back().frame = worst->frame;
  }

  void CheckPlausible(int f) {
    const Plausibility& p = m_.figure[f].plausible;
    const Requirements::Plausible& r = r_.plausible;
    const auto check = [&](Kind kind, const WorstAt& worst, double limit) {
      RequirementCheck& c = AtMost(kind, worst.value, limit);
      c.figure = f;
      c.frame = worst.frame;
      if (c.judged()) c.limbs = {{f, worst.node}};
    };
    check(Kind::kPoseError, p.pose_error_m, r.pose_error_m);
    check(Kind::kTrunkTilt, p.trunk_tilt_deg, r.trunk_tilt_deg);
    check(Kind::kFloating, p.floating_m, r.floating_m);
    check(Kind::kJointLimit, p.joint_limit_deg, r.joint_limit_deg);
    check(Kind::kJerk, p.jerk_ratio, r.jerk_ratio);
  }

  void CheckHold(int k) {
    RequirementCheck& check = AtMost(Kind::kHold, m_.hold_m[k], r_.hold_m);
    check.item = k;
    check.frame = m_.hold_frame[k];
    const Hold& hold = subject_.holds[k];
    for (const HoldPoint& point : {hold.from, hold.to}) {
      if (point.figure != kWorld) check.limbs.push_back({point.figure, point.node});
    }
  }

  const MetricsContext& subject_;
  const Metrics& m_;
  const Requirements& r_;
  std::vector<RequirementCheck> checks_;
};

}  // namespace

std::string TermOf(RequirementKind kind) {
  switch (kind) {
    case Kind::kTangle:
      return "tangle";
    case Kind::kPenetration:
    case Kind::kPenetrationOver1cm:
      return "penetration";
    case Kind::kFootDrift:
      return "foot_lock";
    case Kind::kFloor:
      return "ground";
    case Kind::kHold:
      return "hold";
    case Kind::kFootTravel:
    case Kind::kFootAcceleration:
      return "foot_swing";
    case Kind::kJointLimit:
      return "joint_limit";
    case Kind::kJerk:
      return "smoothness";
    case Kind::kPoseError:
    case Kind::kTrunkTilt:
    case Kind::kFloating:
    case Kind::kPassThroughs:
    case Kind::kSegmentLength:
    case Kind::kWriteBack:
      return "";
  }
  return "";
}

bool AllMet(const std::vector<RequirementCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const RequirementCheck& c) { return c.met; });
}

std::vector<RequirementCheck> CheckRequirements(const MetricsContext& subject,
                                                const Metrics& metrics,
                                                const Requirements& requirements) {
  return Requiring(subject, metrics, requirements).Run();
}

std::vector<RequirementCheck> CheckWritten(const Metrics& metrics,
                                           const std::array<double, 2>& write_back_m,
                                           const Requirements& requirements) {
  std::vector<RequirementCheck> checks;
  for (int f = 0; f < 2; ++f) {
    const double length = metrics.figure[f].length_error_percent;
    checks.push_back({.kind = Kind::kWriteBack,
                      .figure = f,
                      .value = write_back_m[f],
                      .limit = requirements.write_back_m,
                      .met = write_back_m[f] <= requirements.write_back_m});
    checks.push_back({.kind = Kind::kSegmentLength,
                      .figure = f,
                      .value = length,
                      .limit = requirements.segment_length_percent,
                      .met = length <= requirements.segment_length_percent});
  }
  return checks;
}

}  // namespace retarget::solver
