// What a swept setting does: small multiples, one for each metric.
#pragma once

#include <string>
#include <vector>

#include "tools/batch/index.h"

namespace retarget::batch {

// NaN where there is none.
double NumberIn(const report::Json& numbers, const std::string& key);

// Of one swept column: a plot for each metric that it changes, with a curve over its values for
// each row of the manifest (and each value of what else is swept), the limit dashed; then, in
// words, what it does not change.
std::string SweepHtml(const std::vector<IndexRow>& rows, const std::string& column);

}  // namespace retarget::batch
