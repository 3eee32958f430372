// Reading reports leniently: an older report lacks keys, and a page should say less rather than
// nothing.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "tools/report/report.h"

namespace retarget::report {

// The value at a pointer such as "/metrics/result/hold_m/0", or null where there is none.
inline const Json& At(const Json& json, const std::string& pointer) {
  static const Json kNull;
  const Json::json_pointer p(pointer);
  return json.contains(p) ? json.at(p) : kNull;
}

// NaN where there is no number.
inline double NumberAt(const Json& json, const std::string& pointer) {
  const Json& value = At(json, pointer);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

inline std::string TextAt(const Json& json, const std::string& pointer) {
  const Json& value = At(json, pointer);
  return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace retarget::report
