// `retarget simulate`: the forward simulation alone.
#include <fmt/format.h>

#include "io/files.h"
#include "io/settings_file.h"
#include "tools/api/job.h"
#include "tools/cli/commands.h"
#include "tools/report/metrics_table.h"

namespace retarget {

int RunSimulate(const RetargetOptions& options) {
  const Settings settings = EffectiveSettings(options);
  const Job job = LoadJob(options);
  OutputSet output(options.out, {"source.glb", "baseline.glb"}, InputPaths(options), options.force);
  TellNotes(job);
  const RetargetResult prepared = Prepare(job.input, settings);
  for (const std::string& warning : prepared.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const Scene& scene = prepared.scene;
  const SimulationResult simulation = Simulate(scene, settings.simulation);

  const MeasureSubject subject = SubjectOf(scene);
  MeasuredScene source(SceneBytes(scene, scene.source), "source.glb", subject.body);
  MeasuredScene baseline(SceneBytes(scene, simulation.motion), "baseline.glb", subject.body);
  for (MeasuredScene* motion : {&source, &baseline}) motion->Measure(subject, source);
  const Metrics& metrics = baseline.metrics();
  output.Add("source.glb", source.bytes());
  output.Add("baseline.glb", baseline.bytes());
  output.Commit();

  const std::vector<RequirementCheck> checks =
      CheckRequirements(subject, metrics, settings.requirements);
  if (options.json) {
    const Json report = {{"simulation", SimulationJson(simulation)},
                         {"metrics",
                          {{"source", MetricsJson(subject, source.metrics())},
                           {"baseline", MetricsJson(subject, metrics)}}},
                         {"requirements", ChecksJson(checks)}};
    fmt::print("{}\n", report.dump(1));
  } else {
    fmt::print("{}", MetricsTable(subject, source.metrics(), nullptr, metrics, checks, "baseline"));
    fmt::print("{}: {}\n{}; simulated {:.1f} s in {:.2f} s ({:.1f}x real time); written to {}\n",
               NameOf(simulation.status), simulation.message, SettleSentence(simulation),
               simulation.simulated, simulation.seconds, simulation.simulated / simulation.seconds,
               options.out);
  }
  return simulation.status == SimulationStatus::kCompleted && AllMet(checks) ? kDone : kMissed;
}

}  // namespace retarget
