// report.json of a run: everything measured and everything that led to it (docs/report.md).
#pragma once

#include <array>
#include <vector>

#include "solver/metrics/diagnosis.h"
#include "solver/proof/proof.h"
#include "tools/api/job.h"
#include "tools/report/measured_scene.h"
#include "tools/report/report.h"

namespace retarget::api {

// A solved motion on the rig it came from.
struct WrittenRig {
  std::vector<io::NamedBytes> files;  // the motion first
  std::vector<report::NodeJoint> joints;
  double error_m = 0;  // against the scene
};

struct RunFacts {
  const Job& job;
  const solver::RetargetResult& result;
  const solver::MetricsContext& subject;
  const std::vector<solver::RequirementCheck>& checks;
  const std::vector<solver::Diagnosis>& diagnoses;
  int exit_code;
  const std::array<WrittenRig, 2>& rig;
  const solver::Proof& proof;
};

report::Json RunReport(const RunFacts& run, const solver::Metrics& source,
                       const solver::Metrics& baseline, const solver::Metrics& metrics);

}  // namespace retarget::api
