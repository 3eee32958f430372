// The terms of the spacetime problem with their weights.
#pragma once

#include <memory>
#include <vector>

#include "model/settings.h"
#include "solver/problem/term.h"

namespace retarget::solver {

struct WeightedTerm {
  std::unique_ptr<Term> term;
  double weight = 0;

  // The weight in a stage: staged terms take `contact_factor` of it.
  double StageWeight(double contact_factor) const {
    return weight * (term->staged() ? contact_factor : 1);
  }
};

// Every term of the objective but smoothness, which reads three frames and is the problem's own.
// Defined beside the terms (solver/problem/terms/term_table.cc), so that a new term is its file and
// a line there, and the problem knows none of them.
std::vector<WeightedTerm> MakeTerms(const Scene& scene, const Settings& settings);

}  // namespace retarget::solver
