// report.json, and what it is made of. The schema is described in docs/report.md.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "solver/metrics/diagnosis.h"
#include "solver/retarget.h"

namespace retarget::report {

using Json = nlohmann::ordered_json;

inline constexpr const char* kFigure[2] = {"a", "b"};  // names in files and messages

// report.json of a run's folder. Throws InputError.
Json ReadReport(const std::string& folder);

Json SimulationJson(const solver::SimulationResult& simulation);
// When the figures came to rest, and how far from the template.
std::string SettleSentence(const solver::SimulationResult& simulation);

Json MetricsJson(const solver::MetricsContext& subject, const solver::Metrics& metrics);
// All three as report.json has them; `baseline` may be null.
Json ThreeMetricsJson(const solver::MetricsContext& subject, const solver::Metrics& source,
                      const solver::Metrics* baseline, const solver::Metrics& result);
Json PassThroughsJson(const solver::MetricsContext& subject,
                      const std::vector<solver::PassThrough>& passes);

Json DiagnosesJson(const std::vector<solver::Diagnosis>& diagnoses,
                   const solver::MetricsContext& subject);

}  // namespace retarget::report
