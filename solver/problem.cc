#include "solver/problem.h"

#include <cmath>

#include "solver/parallel.h"
#include "solver/terms/foot_lock.h"
#include "solver/terms/ground.h"
#include "solver/terms/hold.h"
#include "solver/terms/joint_limit.h"
#include "solver/terms/penetration.h"
#include "solver/terms/tangle.h"
#include "solver/terms/tracking.h"

namespace retarget {

// The table of contents of the objective.
Problem::Problem(const Scene& scene, const Settings& settings)
    : scene_(&scene), settings_(settings), smoothness_(scene, settings) {
  const Weights& w = settings.weights;
  const auto add = [&](std::unique_ptr<Term> term, double weight) {
    terms_.push_back(std::move(term));
    weight_.push_back(weight);
  };
  add(std::make_unique<PoseTracking>(scene, settings.joint_weights), w.pose_tracking);
  add(std::make_unique<RootTracking>(scene), w.root_tracking);
  add(std::make_unique<FootLock>(scene), w.foot_lock);
  add(std::make_unique<HoldTerm>(), w.hold);
  add(std::make_unique<Penetration>(), w.penetration);
  add(std::make_unique<SelfPenetration>(scene), w.self_penetration);
  add(std::make_unique<Ground>(scene), w.ground);
  add(std::make_unique<TangleTerm>(scene), w.tangle);
  add(std::make_unique<JointLimitTerm>(), w.joint_limit);
}

double Problem::WeightOf(const Term& term) const {
  for (size_t k = 0; k < terms_.size(); ++k) {
    if (terms_[k].get() == &term) return weight_[k];
  }
  return 0;
}

void Problem::EvaluateFrame(const Frame& frame, double contact_factor, bool derivatives,
                            Rows* rows) const {
  rows->Reset(frame, derivatives);
  for (size_t k = 0; k < terms_.size(); ++k) {
    const double weight = weight_[k] * (terms_[k]->staged() ? contact_factor : 1);
    if (weight == 0) continue;
    const int row = rows->num_rows();
    const int coordinate = static_cast<int>(rows->coordinates().size());
    terms_[k]->Evaluate(frame, rows);
    rows->Scale(row, coordinate, weight);
  }
}

double Problem::Cost(const Unknowns& unknowns, double contact_factor, int threads) const {
  const int n = scene_->num_frames();
  std::vector<double> cost(static_cast<size_t>(n));
  std::vector<Frame> frame(static_cast<size_t>(threads));
  std::vector<Rows> rows(static_cast<size_t>(threads));
  ParallelFor(n, threads, [&](int t, int thread) {
    frame[thread].Set(*scene_, unknowns, t, false);
    EvaluateFrame(frame[thread], contact_factor, false, &rows[thread]);
    cost[t] = rows[thread].HalfSquares() + smoothness_.HalfSquares(unknowns.edit, t, t + 1, false) +
              smoothness_.HalfSquares(unknowns.edit, t, t + 1, true);
  });
  double sum = 0;
  for (const double c : cost) sum += c;
  return sum;
}

std::vector<TermCost> Problem::CostByTerm(const Unknowns& unknowns) const {
  std::vector<TermCost> costs;
  Frame frame;
  Rows rows;
  for (size_t k = 0; k < terms_.size(); ++k) {
    TermCost cost{terms_[k]->name(), terms_[k]->unit(), weight_[k], 0, 0};
    for (int t = 0; t < scene_->num_frames(); ++t) {
      frame.Set(*scene_, unknowns, t, false);
      rows.Reset(frame, false);
      terms_[k]->Evaluate(frame, &rows);
      cost.cost += weight_[k] * weight_[k] * rows.HalfSquares();
      for (const double r : rows.residual()) cost.largest = std::max(cost.largest, std::abs(r));
      for (const auto& c : rows.coordinates())
        cost.largest = std::max(cost.largest, std::abs(c.residual));
    }
    costs.push_back(cost);
  }
  const int n = scene_->num_frames();
  const Weights& w = settings_.weights;
  costs.push_back(
      {"smoothness", "rad", w.smoothness, smoothness_.HalfSquares(unknowns.edit, 0, n, false), 0});
  costs.push_back({"root_smoothness", "m, rad", w.root_smoothness,
                   smoothness_.HalfSquares(unknowns.edit, 0, n, true), 0});
  return costs;
}

}  // namespace retarget
