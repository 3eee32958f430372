#include "solver/problem/problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/problem/parallel.h"

namespace retarget::solver {

namespace {

Settings WithUnitSmoothness(Settings settings) {
  settings.weights.smoothness = settings.weights.root_smoothness = 1;
  return settings;
}

}  // namespace

Problem::Problem(const Scene& scene, const Settings& settings)
    : scene_(&scene),
      settings_(settings),
      smoothness_(scene, settings),
      natural_smoothness_(scene, WithUnitSmoothness(settings)),
      terms_(MakeTerms(scene, settings)) {}

void Problem::Add(std::unique_ptr<Term> term, double weight) {
  terms_.push_back({std::move(term), weight});
}

void Problem::EvaluateFrame(const Frame& frame, double contact_factor, bool derivatives,
                            Rows* rows) const {
  rows->Reset(frame, derivatives);
  for (const WeightedTerm& t : terms_) {
    const double weight = t.StageWeight(contact_factor);
    if (weight == 0) continue;
    const int row = rows->num_rows();
    const int coordinate = static_cast<int>(rows->coordinates().size());
    t.term->Evaluate(frame, rows);
    rows->Scale(row, coordinate, weight);
  }
}

double Problem::FrameCost(const Frame& frame, const MatX& edit, double contact_factor, Rows* rows,
                          std::vector<double>* by_term) const {
  by_term->clear();
  for (const WeightedTerm& t : terms_) {
    const double weight = t.StageWeight(contact_factor);
    rows->Reset(frame, false);
    if (weight != 0) t.term->Evaluate(frame, rows);
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
  for (const WeightedTerm& t : terms_) {
    costs.push_back({t.term->name(), t.term->unit(), t.weight});
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
      terms_[k].term->Evaluate(frame, &rows);
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
