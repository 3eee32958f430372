// Order statistics of small samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace retarget {

// The value that a share of the others, rounded down, are no larger than; `share` in [0, 1], of at
// least one value.
inline double Quantile(std::vector<double> values, double share) {
  const auto k = static_cast<long>(std::floor(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<size_t>(k)];
}

// The middle value, of an even number the upper of both; of at least one value.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace retarget
