// The cause of a miss and the setting that would change it. Inner part of
// solver/metrics/diagnosis.h.
#pragma once

#include "solver/metrics/diagnosis.h"

namespace retarget::solver {

struct DiagnosisCase {
  const Problem& problem;
  const Unknowns& unknowns;
  const MetricsContext& subject;
  const Metrics& metrics;
};

// Fills cause, suggestion and what belongs to them; `diagnosis` has its check and opposition.
void FindCause(const DiagnosisCase& c, Diagnosis* diagnosis);

// What the clips and the template themselves ask for that no weight can settle: two planted feet in
// one place, or a hold out of reach of the feet. False where there is no such thing.
bool FindContradiction(const DiagnosisCase& c, Diagnosis* diagnosis);

}  // namespace retarget::solver
