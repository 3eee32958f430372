#include "solver/problem/problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/problem/parallel.h"
#include "solver/problem/terms/foot_lock.h"
#include "solver/problem/terms/ground.h"
#include "solver/problem/terms/hold.h"
#include "solver/problem/terms/joint_limit.h"
#include "solver/problem/terms/penetration.h"
#include "solver/problem/terms/rig_turn.h"
#include "solver/problem/terms/tangle.h"
#include "solver/problem/terms/tracking.h"

namespace retarget::solver {

namespace {

Settings WithUnitSmoothness(Settings settings) {
  settings.weights.smoothness = settings.weights.root_smoothness = 1;
  return settings;
}

}  // namespace

// The table of contents of the objective.
Problem::Problem(const Scene& scene, const Settings& settings)
    : scene_(&scene),
      settings_(settings),
      smoothness_(scene, settings),
      natural_smoothness_(scene, WithUnitSmoothness(settings)) {
  const Weights& w = settings.weights;
  Add(std::make_unique<PoseTracking>(scene, settings.joint_weights), w.pose_tracking);
  Add(std::make_unique<RootTracking>(scene), w.root_tracking);
  Add(std::make_unique<FootLock>(scene), w.foot_lock);
  Add(std::make_unique<HoldTerm>(), w.hold);
  Add(std::make_unique<Penetration>(), w.penetration);
  Add(std::make_unique<SelfPenetration>(scene), w.self_penetration);
  Add(std::make_unique<Ground>(scene), w.ground);
  Add(std::make_unique<TangleTerm>(scene), w.tangle);
  Add(std::make_unique<JointLimitTerm>(), w.joint_limit);
  Add(std::make_unique<RigTurn>(), w.rig_turn);
}

void Problem::Add(std::unique_ptr<Term> term, double weight) {
  terms_.push_back(std::move(term));
  weight_.push_back(weight);
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

double Problem::FrameCost(const Frame& frame, const MatX& edit, double contact_factor, Rows* rows,
                          std::vector<double>* by_term) const {
  by_term->clear();
  for (size_t k = 0; k < terms_.size(); ++k) {
    const double weight = weight_[k] * (terms_[k]->staged() ? contact_factor : 1);
    rows->Reset(frame, false);
    if (weight != 0) terms_[k]->Evaluate(frame, rows);
    by_term->push_back(weight * weight * rows->HalfSquares());
  }
  for (const bool root : {false, true}) {
    by_term->push_back(smoothness_.HalfSquares(edit, frame.t, frame.t + 1, root));
  }
  return std::accumulate(by_term->begin(), by_term->end(), 0.0);
}

std::vector<double> Problem::TermCosts(const Unknowns& unknowns, double contact_factor,
                                       int threads) const {
  std::vector<std::vector<double>> cost(static_cast<size_t>(scene_->num_frames()));
  std::vector<Frame> frame(static_cast<size_t>(threads));
  std::vector<Rows> rows(static_cast<size_t>(threads));
  ParallelFor(scene_->num_frames(), threads, [&](int t, int thread) {
    frame[thread].Set(*scene_, unknowns, t, false);
    FrameCost(frame[thread], unknowns.edit, contact_factor, &rows[thread], &cost[t]);
  });
  std::vector<double> sum(terms_.size() + 2, 0);
  for (const std::vector<double>& of_frame : cost) {
    for (size_t k = 0; k < sum.size(); ++k) sum[k] += of_frame[k];
  }
  return sum;
}

double Problem::Cost(const Unknowns& unknowns, double contact_factor, int threads) const {
  const std::vector<double> costs = TermCosts(unknowns, contact_factor, threads);
  return std::accumulate(costs.begin(), costs.end(), 0.0);
}

std::vector<TermCost> Problem::CostByTerm(const Unknowns& unknowns) const {
  std::vector<TermCost> costs;
  for (size_t k = 0; k < terms_.size(); ++k) {
    costs.push_back({terms_[k]->name(), terms_[k]->unit(), weight_[k]});
  }
  costs.push_back({"smoothness", "rad", settings_.weights.smoothness});
  costs.push_back({"root_smoothness", "m, rad", settings_.weights.root_smoothness});
  const auto enlarge = [](double r, double* largest) {
    *largest = std::max(*largest, std::abs(r));
  };
  Frame frame;
  Rows rows;
  for (int t = 0; t < scene_->num_frames(); ++t) {
    frame.Set(*scene_, unknowns, t, false);
    for (size_t k = 0; k < terms_.size(); ++k) {
      rows.Reset(frame, false);
      terms_[k]->Evaluate(frame, &rows);
      costs[k].natural_cost += rows.HalfSquares();
      for (const double r : rows.residual()) enlarge(r, &costs[k].largest);
      for (const auto& c : rows.coordinates()) enlarge(c.residual, &costs[k].largest);
    }
    for (const bool root : {false, true}) {
      TermCost& cost = costs[terms_.size() + root];
      cost.natural_cost += natural_smoothness_.HalfSquares(unknowns.edit, t, t + 1, root);
      enlarge(natural_smoothness_.Largest(unknowns.edit, t, root), &cost.largest);
    }
  }
  for (TermCost& cost : costs) cost.cost = cost.weight * cost.weight * cost.natural_cost;
  return costs;
}

}  // namespace retarget::solver
