// The tables that put source, baseline and result side by side.
#pragma once

#include <string>

#include "tools/report/report.h"

namespace retarget::report {

std::string MetricsTableHtml(const Json& report);
std::string TagsTableHtml(const Json& report);
std::string HoldsTableHtml(const Json& report);

}  // namespace retarget::report
