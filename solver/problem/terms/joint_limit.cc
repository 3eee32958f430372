#include "solver/problem/terms/joint_limit.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

constexpr double kM = kSoftMargin;

double Soft(double x) { return x > kM ? x : (x + kM) * (x + kM) / (4 * kM); }
double SoftSlope(double x) { return x > kM ? 1 : (x + kM) / (2 * kM); }

void AddLink(const Frame& frame, int f, int l, Rows* rows) {
  const Body& body = frame.body(f);
  const std::vector<LimitExcess> now = LimitExcesses(body, l, frame.pose[f]);
  const bool any =
      std::any_of(now.begin(), now.end(), [](const LimitExcess& e) { return e.beyond > -kM; });
  if (!any) return;
  const std::vector<LimitExcess> source =
      LimitExcesses(body, l, frame.scene->source[f].frames[frame.t]);
  for (size_t k = 0; k < now.size(); ++k) {
    const double x = now[k].beyond - std::max(0.0, source[k].beyond + kM);
    if (x <= -kM) continue;
    const int row = rows->Add(Soft(x));
    rows->AddJointTurn(row, f, l, SoftSlope(x) * now[k].gradient);
    const int parent = body.links[l].parent;
    if (parent > 0 && body.links[l].limit.turns_with_parent) {
      rows->AddJointTurn(row, f, parent, SoftSlope(x) * now[k].by_parent);
    }
  }
}

}  // namespace

void JointLimitTerm::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    for (int l = 1; l < frame.body(f).num_links(); ++l) AddLink(frame, f, l, rows);
  }
}

}  // namespace retarget::solver
