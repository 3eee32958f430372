// The spacetime problem: its terms (solver/problem/term_table.h) and smoothness with their weights,
// and what both back ends ask of it: weighted rows of a frame, and the cost.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/settings.h"
#include "solver/problem/smoothness.h"
#include "solver/problem/term_table.h"

namespace retarget::solver {

// What one term costs at a solution.
struct TermCost {
  std::string name, unit;
  double weight = 0;
  double cost = 0;          // weighted, 1/2 sum (w r)^2
  double largest = 0;       // natural unit
  double natural_cost = 0;  // 1/2 sum r^2
};

class Problem {
 public:
  Problem(const Scene& scene, const Settings& settings);
  // One more term, after those of the table.
  void Add(std::unique_ptr<Term> term, double weight);

  const Scene& scene() const { return *scene_; }
  const Settings& settings() const { return settings_; }
  const Smoothness& smoothness() const { return smoothness_; }
  const std::vector<WeightedTerm>& terms() const { return terms_; }

  // Weighted rows of one frame; staged terms take `contact_factor` of their weight.
  void EvaluateFrame(const Frame& frame, double contact_factor, bool derivatives, Rows* rows) const;

  // The same without derivatives, as costs: [terms, smoothness, root_smoothness], the order of
  // CostByTerm; smoothness is that centred on the frame. Returns their sum.
  double FrameCost(const Frame& frame, const MatX& edit, double contact_factor, Rows* rows,
                   std::vector<double>* by_term) const;

  // Cost of all frames, worked out by `threads` threads.
  double Cost(const Unknowns& unknowns, double contact_factor, int threads) const;
  // The same in that order of terms.
  std::vector<double> TermCosts(const Unknowns& unknowns, double contact_factor, int threads) const;
  // What the report says of every term.
  std::vector<TermCost> CostByTerm(const Unknowns& unknowns) const;

 private:
  const Scene* scene_;
  Settings settings_;
  Smoothness smoothness_, natural_smoothness_;  // weighted, and with weights of one
  std::vector<WeightedTerm> terms_;
};

}  // namespace retarget::solver
