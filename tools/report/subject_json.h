// What a run is measured against (bodies, contacts, tags, holds) in report.json, written and read
// back.
#pragma once

#include <string>

#include "tools/report/report.h"

namespace retarget::report {

Json SubjectJson(const solver::MetricsContext& subject, const solver::Metrics& result);
// The subject of a report read back. Throws InputError naming `path`.
solver::MetricsContext SubjectFromJson(const Json& report, const std::string& path);

}  // namespace retarget::report
