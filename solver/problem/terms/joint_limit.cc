#include "solver/problem/terms/joint_limit.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

constexpr double kM = kSoftMargin;

struct Joint {
  int figure, link, parent;
};

void AddRow(const LimitExcess& excess, double residual, double slope, const Joint& at, Rows* rows) {
  const int row = rows->Add(residual);
  rows->AddJointTurn(row, at.figure, at.link, slope * excess.gradient);
  if (!excess.by_parent.isZero(0)) {
    rows->AddJointTurn(row, at.figure, at.parent, slope * excess.by_parent);
  }
}

double Soft(double x) { return x > kM ? x : (x + kM) * (x + kM) / (4 * kM); }
double SoftSlope(double x) { return x > kM ? 1 : (x + kM) / (2 * kM); }

// Beyond the limits themselves.
void AddStrictly(const Frame& frame, int f, int l, Rows* rows) {
  for (const LimitExcess& e : LimitExcesses(frame.body(f), l, frame.pose[f])) {
    if (e.beyond > 0) AddRow(e, e.beyond, 1, {f, l, frame.body(f).links[l].parent}, rows);
  }
}

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
    AddRow(now[k], Soft(x), SoftSlope(x), {f, l, body.links[l].parent}, rows);
  }
}

}  // namespace

void JointLimitTerm::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    for (int l = 1; l < frame.body(f).num_links(); ++l) {
      if (frame.scene->source_widens_limits) {
        AddLink(frame, f, l, rows);
      } else {
        AddStrictly(frame, f, l, rows);
      }
    }
  }
}

}  // namespace retarget::solver
