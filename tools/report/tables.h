// The parts of the report page that are text: the verdict on top, and the tables. Both pages, with
// players and without, hold the same.
#pragma once

#include <string>

#include "tools/report/report.h"

namespace retarget::report {

std::string VerdictHtml(const Json& report);
std::string TablesHtml(const Json& report);

}  // namespace retarget::report
