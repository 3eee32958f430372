// report.json of a run: everything measured and everything that led to it (docs/report.md).
#pragma once

#include <array>
#include <vector>

#include "solver/metrics/diagnosis.h"
#include "tools/api/job.h"
#include "tools/report/report.h"

namespace retarget {

// A solved motion on the rig it came from.
struct WrittenRig {
  std::vector<NamedBytes> files;  // the motion first
  std::vector<NodeJoint> joints;
  double error_m = 0;  // against the scene
};

struct RunFacts {
  const RetargetOptions& options;
  const Settings& settings;
  const Job& job;
  const RetargetResult& result;
  const MeasureSubject& subject;
  const std::vector<RequirementCheck>& checks;
  const std::vector<Conflict>& conflicts;
  int exit_code;
  const std::array<WrittenRig, 2>& rig;
};

Json RunReport(const RunFacts& run, const Metrics& source, const Metrics& baseline,
               const Metrics& metrics);

}  // namespace retarget
