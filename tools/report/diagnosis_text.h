// A diagnosis in words: what is missed where, what pulls against it, and what to do about it. The
// only place that names the command line's options for it.
#pragma once

#include <string>

#include "solver/metrics/diagnosis.h"

namespace retarget::report {

// "flat_tangle": as report.json has it.
const char* CauseName(solver::Cause cause);
std::string DiagnosisSentence(const solver::Diagnosis& diagnosis,
                              const solver::MetricsContext& subject);

}  // namespace retarget::report
