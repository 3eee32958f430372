#include "solver/metrics/requirements.h"

#include <algorithm>
#include <utility>

namespace retarget::solver {

bool AllMet(const std::vector<RequirementCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const RequirementCheck& c) { return c.met; });
}

namespace {

class Requiring {
 public:
  Requiring(const MeasureSubject& subject, const Metrics& metrics, const Requirements& requirements)
      : subject_(subject), m_(metrics), r_(requirements) {}

  std::vector<RequirementCheck> Run() {
    for (size_t k = 0; k < m_.tangles.size(); ++k) CheckTangle(static_cast<int>(k));
    CheckBetweenBodies();
    for (int f = 0; f < 2; ++f) CheckFigure(f);
    for (size_t k = 0; k < m_.hold_m.size(); ++k) CheckHold(static_cast<int>(k));
    return std::move(checks_);
  }

 private:
  std::string NameOf(int f, int n) const { return subject_.body[f].nodes[n].name; }
  static std::string FrameName(int t) { return "frame " + std::to_string(t); }

  void CheckTangle(int k) {
    const Tangle& t = subject_.tangles[k].tag.tangle;
    const TangleMetrics& m = m_.tangles[k];
    const double value = std::min(m.min_signed_gli, m.min_signed_gli_between);
    checks_.push_back({"tangle " + std::to_string(k + 1),
                       value,
                       r_.gli,
                       "turns",
                       value > r_.gli,
                       "a (" + NameOf(0, t.a.from) + ", " + NameOf(0, t.a.to) + ") x b (" +
                           NameOf(1, t.b.from) + ", " + NameOf(1, t.b.to) + "), " +
                           FrameName(m.worst_frame),
                       "tangle",
                       k,
                       m.worst_frame,
                       {{0, t.a.from}, {0, t.a.to}, {1, t.b.from}, {1, t.b.to}}});
  }

  void CheckBetweenBodies() {
    const double passes = static_cast<double>(m_.pass_throughs.size());
    RequirementCheck pass{"pass-throughs",
                          passes,
                          static_cast<double>(r_.pass_throughs),
                          "",
                          passes <= r_.pass_throughs,
                          ""};
    if (!m_.pass_throughs.empty()) {
      const PassThrough& p = m_.pass_throughs[0];
      pass.where =
          FrameName(p.frame) + ", a " + NameOf(0, p.node_a) + " through b " + NameOf(1, p.node_b);
      pass.frame = p.frame;
      pass.limbs = {{0, p.node_a}, {1, p.node_b}};
    }
    checks_.push_back(pass);
    const double deepest = std::max(m_.penetration_m, m_.penetration_between_m);
    RequirementCheck depth{
        "penetration", deepest, r_.penetration_m, "m", deepest <= r_.penetration_m, "",
        "penetration"};
    if (deepest > 0) {
      depth.where = FrameName(m_.penetration_frame) + ", a " + NameOf(0, m_.penetration_node_a) +
                    " in b " + NameOf(1, m_.penetration_node_b);
      depth.frame = m_.penetration_frame;
      depth.limbs = {{0, m_.penetration_node_a}, {1, m_.penetration_node_b}};
    }
    checks_.push_back(depth);
    checks_.push_back({kDeepFrames, m_.penetration_over_1cm_percent, r_.penetration_1cm_percent,
                       "% of frames", m_.penetration_over_1cm_percent <= r_.penetration_1cm_percent,
                       "", depth.term, -1, depth.frame, depth.limbs});
  }

  void CheckFigure(int f) {
    const std::string who = f == 0 ? "a" : "b";
    const FigureMetrics& m = m_.figure[f];
    checks_.push_back({"foot drift " + who,
                       m.foot_drift_m,
                       r_.foot_drift_m,
                       "m",
                       m.foot_drift_m <= r_.foot_drift_m,
                       FrameName(m.foot_drift_frame),
                       "foot_lock",
                       -1,
                       m.foot_drift_frame,
                       {{f, m.foot_drift_node}}});
    checks_.push_back({"floor " + who,
                       m.floor_m,
                       r_.floor_m,
                       "m",
                       m.floor_m <= r_.floor_m,
                       "",
                       "ground",
                       -1,
                       m.floor_frame,
                       {{f, m.floor_node}}});
  }

  void CheckHold(int k) {
    std::vector<LimbNode> limbs;
    const Hold& hold = subject_.holds[k];
    for (const HoldPoint& point : {hold.from, hold.to}) {
      if (point.figure != kWorld) limbs.push_back({point.figure, point.node});
    }
    checks_.push_back({"hold " + std::to_string(k + 1), m_.hold_m[k], r_.hold_m, "m",
                       m_.hold_m[k] <= r_.hold_m, FrameName(m_.hold_frame[k]), "hold", k,
                       m_.hold_frame[k], limbs});
  }

  const MeasureSubject& subject_;
  const Metrics& m_;
  const Requirements& r_;
  std::vector<RequirementCheck> checks_;
};

}  // namespace

std::vector<RequirementCheck> CheckRequirements(const MeasureSubject& subject,
                                                const Metrics& metrics,
                                                const Requirements& requirements) {
  return Requiring(subject, metrics, requirements).Run();
}

}  // namespace retarget::solver
