// `retarget simulate`: the forward simulation alone.
#include <fmt/format.h>

#include "io/files.h"
#include "io/settings_file.h"
#include "tools/api/job.h"
#include "tools/cli/commands.h"
#include "tools/report/measured_scene.h"
#include "tools/report/metrics_table.h"
#include "tools/report/requirement_json.h"

namespace retarget::cli {

int RunSimulate(const RetargetOptions& options) {
  const api::Job job = api::LoadJob(RequestOf(options));
  const Settings& settings = job.request.settings;
  io::OutputSet output(options.out, {"source.glb", "baseline.glb"}, api::InputPaths(job.request),
                       options.force);
  PrintNotes(api::RecognitionNotes(job), 0);
  const solver::RetargetResult prepared = solver::Prepare(job.input, settings);
  for (const std::string& warning : prepared.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const solver::Scene& scene = prepared.scene;
  const solver::SimulationResult simulation = solver::Simulate(scene, settings.simulation);

  const solver::MetricsContext subject = solver::MetricsContextOf(scene);
  report::MeasuredScene source(api::SceneBytes(scene, scene.source), "source.glb", subject.body);
  report::MeasuredScene baseline(api::SceneBytes(scene, simulation.motion), "baseline.glb",
                                 subject.body);
  for (report::MeasuredScene* motion : {&source, &baseline}) motion->Measure(subject, source);
  const solver::Metrics& metrics = baseline.metrics();
  output.Add("source.glb", source.bytes());
  output.Add("baseline.glb", baseline.bytes());
  output.Commit();

  const std::vector<solver::RequirementCheck> checks =
      solver::CheckRequirements(subject, metrics, settings.requirements);
  if (options.json) {
    const report::Json report = {{"simulation", report::SimulationJson(simulation)},
                                 {"metrics",
                                  {{"source", report::MetricsJson(subject, source.metrics())},
                                   {"baseline", report::MetricsJson(subject, metrics)}}},
                                 {"requirements", report::ChecksJson(checks, subject.body)}};
    fmt::print("{}\n", report.dump(1));
  } else {
    fmt::print("{}", report::MetricsTable(subject, source.metrics(), nullptr, metrics, checks,
                                          "baseline"));
    fmt::print("{}: {}\n{}; simulated {:.1f} s in {:.2f} s ({:.1f}x real time); written to {}\n",
               solver::NameOf(simulation.status), simulation.message,
               report::SettleSentence(simulation), simulation.simulated, simulation.seconds,
               simulation.simulated / simulation.seconds, options.out);
  }
  return simulation.status == solver::SimulationStatus::kCompleted && solver::AllMet(checks)
             ? kDone
             : kMissed;
}

}  // namespace retarget::cli
