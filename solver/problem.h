// The spacetime problem: the table of its terms and their weights, and what both back ends ask of
// it: weighted rows of a frame, and the cost.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/settings.h"
#include "solver/term.h"
#include "solver/terms/smoothness.h"

namespace retarget {

// What one term costs at a solution.
struct TermCost {
  std::string name, unit;
  double weight = 0;
  double cost = 0;     // weighted, 1/2 sum (w r)^2
  double largest = 0;  // natural unit
};

class Problem {
 public:
  Problem(const Scene& scene, const Settings& settings);

  const Scene& scene() const { return *scene_; }
  const Settings& settings() const { return settings_; }
  const Smoothness& smoothness() const { return smoothness_; }
  const std::vector<std::unique_ptr<Term>>& terms() const { return terms_; }
  double WeightOf(const Term& term) const;

  // Weighted rows of one frame; staged terms take `contact_factor` of their weight.
  void EvaluateFrame(const Frame& frame, double contact_factor, bool derivatives, Rows* rows) const;

  // Cost of all frames, worked out by `threads` threads.
  double Cost(const Unknowns& unknowns, double contact_factor, int threads) const;
  std::vector<TermCost> CostByTerm(const Unknowns& unknowns) const;

 private:
  const Scene* scene_;
  Settings settings_;
  Smoothness smoothness_;
  std::vector<std::unique_ptr<Term>> terms_;
  std::vector<double> weight_;
};

}  // namespace retarget
