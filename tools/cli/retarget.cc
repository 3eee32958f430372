// `retarget`: two clips and a template in, a solved and verified scene out.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "io/files.h"
#include "io/settings_file.h"
#include "model/rig/write_back.h"
#include "tools/api/job.h"
#include "tools/api/run_report.h"
#include "tools/api/version.h"
#include "tools/cli/commands.h"
#include "tools/report/diagnosis_text.h"
#include "tools/report/measured_scene.h"
#include "tools/report/metrics_table.h"
#include "tools/report/page.h"
#include "tools/report/series.h"

namespace retarget::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// One line per iteration for a program that reads along.
solver::Progress ProgressJson() {
  return [](const solver::Iteration& i) {
    const report::Json line = {{"stage", i.stage},
                               {"iteration", i.index},
                               {"cost", i.cost},
                               {"step_m", i.step_m},
                               {"smallest_gli", i.smallest_gli},
                               {"penetration_m", i.deepest_penetration_m},
                               {"hold_m", i.hold_error_m},
                               {"seconds", i.seconds}};
    fmt::print(stderr, "{}\n", line.dump());
    return !interrupted;
  };
}

// One line per iteration on a terminal, silence elsewhere.
solver::Progress ProgressLines(bool quiet) {
  const bool terminal = !quiet && isatty(STDERR_FILENO);
  if (terminal) {
    fmt::print(stderr, "{:>5} {:>4} {:>12} {:>8} {:>7} {:>8} {:>8} {:>7}\n", "stage", "it", "cost",
               "step cm", "s GLI", "depth cm", "hold cm", "s");
  }
  return [terminal](const solver::Iteration& i) {
    if (terminal) {
      fmt::print(stderr, "{:>5} {:>4} {:>12.4f} {:>8.2f} {:>7.3f} {:>8.2f} {:>8.2f} {:>7.2f}\n",
                 i.stage, i.index, i.cost, 100 * i.step_m, i.smallest_gli,
                 100 * i.deepest_penetration_m, 100 * i.hold_error_m, i.seconds);
    }
    return !interrupted;
  };
}

api::WrittenRig WriteRig(const api::Job& job, const solver::RetargetResult& result, int f,
                         const solver::MotionView& scene) {
  const io::LoadedClip& clip = job.clip[f];
  const double start = clip.options.start + job.frames.first / result.scene.fps();
  const solver::Placement& placement = result.placement[f];
  const RigMotion motion = WriteBack(
      clip.file.motion, *clip.binding, start,
      [&](const Pose& pose) { return solver::Placed(pose, placement); }, result.scene.source[f],
      result.solved[f]);
  api::WrittenRig out;
  out.files =
      io::FormatClipFile(clip.file, motion, report::kFigure[f], clip.binding->stature_ratio());
  for (int n = 0; n < job.input.body[f].num_nodes(); ++n) {
    const int joint = clip.binding->JointAtNode(n);
    if (joint >= 0) out.joints.push_back({n, joint});
  }
  out.error_m =
      report::WriteBackError(io::ReadBack(clip.file, out.files), clip.file.motion.rig,
                             clip.facts.metres_per_unit, clip.facts.up, out.joints, scene, f);
  return out;
}

int ExitCodeOf(solver::SolveStatus status, bool all_met) {
  if (status == solver::SolveStatus::kInterrupted) return kInterrupted;
  if (status != solver::SolveStatus::kConverged) return kLimit;
  return all_met ? kDone : kMissed;
}

}  // namespace

void CatchInterrupts() {
  std::signal(SIGINT, [](int) { interrupted = 1; });
}

namespace {

std::vector<std::string> OutputNames(const api::Job& job) {
  std::vector<std::string> names = {"scene.glb",   "source.glb",  "baseline.glb",
                                    "report.json", "report.html", "config.yaml"};
  for (int f = 0; f < 2; ++f) {
    for (const std::string& name : io::NamesOfClipFile(job.clip[f].file, report::kFigure[f])) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

}  // namespace

int RunRetarget(const api::RetargetOptions& options) {
  // Read, map onto the body, resample.
  const Settings settings = api::EffectiveSettings(options);
  const api::Job job = api::LoadJob(options);
  io::OutputSet output(options.out, OutputNames(job), api::InputPaths(options), options.force);
  if (!options.quiet) api::TellNotes(job);
  if (options.show == "characters") api::CheckCharacters(job);

  // Fit the template, find tangles and contacts, place, start, solve.
  CatchInterrupts();
  const solver::RetargetResult result =
      solver::Retarget(job.input, settings,
                       options.progress == "json" ? ProgressJson() : ProgressLines(options.quiet));
  for (const std::string& warning : result.warnings) fmt::print(stderr, "warning: {}\n", warning);

  // Measure what is written, as it would be read back.
  const solver::MeasureSubject subject = solver::SubjectOf(result.scene);
  report::MeasuredScene source(api::SceneBytes(result.scene, result.scene.source), "source.glb",
                               subject.body);
  report::MeasuredScene baseline(api::SceneBytes(result.scene, result.simulation.motion),
                                 "baseline.glb", subject.body);
  const std::string figures = api::SceneBytes(result.scene, result.solved);
  report::MeasuredScene scene(
      options.show == "characters" ? api::CharacterScene(job, result, figures) : figures,
      "scene.glb", subject.body);
  for (report::MeasuredScene* motion : {&source, &baseline, &scene})
    motion->Measure(subject, source);
  const solver::Metrics& metrics = scene.metrics();
  std::vector<solver::RequirementCheck> checks =
      solver::CheckRequirements(subject, metrics, settings.requirements);
  std::array<api::WrittenRig, 2> rig;
  for (int f = 0; f < 2; ++f) {
    rig[f] = WriteRig(job, result, f, scene.view());
  }
  for (const solver::RequirementCheck& check :
       solver::CheckWritten(metrics, {rig[0].error_m, rig[1].error_m}, settings.requirements)) {
    checks.push_back(check);
  }
  const bool all_met = solver::AllMet(checks);
  std::vector<solver::Conflict> conflicts;
  if (!all_met) {
    conflicts = solver::FindConflicts(solver::Problem(result.scene, settings),
                                      result.solve.unknowns, subject, metrics, checks);
  }
  const int exit_code = ExitCodeOf(result.solve.status, all_met);

  // Report and write.
  const report::Json report =
      api::RunReport({options, settings, job, result, subject, checks, conflicts, exit_code, rig},
                     source.metrics(), baseline.metrics(), metrics);
  output.Add("scene.glb", scene.bytes());
  output.Add("source.glb", source.bytes());
  output.Add("baseline.glb", baseline.bytes());
  for (const api::WrittenRig& written : rig) {
    for (const io::NamedBytes& file : written.files) output.Add(file.name, file.bytes);
  }
  output.Add("report.json", report.dump(1) + "\n");
  const report::Json series =
      report::SeriesJson(subject, source.series(), &baseline.series(), scene.series());
  output.Add("report.html",
             report::FormatReportPage({report, series, source.bytes(), baseline.bytes(), figures}));
  output.Add("config.yaml", io::FormatSettings(settings));
  output.Commit();

  if (options.quiet) return exit_code;
  if (options.json) {
    fmt::print("{}\n", report.dump(1));
    return exit_code;
  }
  fmt::print("{}",
             report::MetricsTable(subject, source.metrics(), &baseline.metrics(), metrics, checks));
  for (const solver::Conflict& conflict : conflicts)
    fmt::print("  {}\n", report::ConflictSentence(conflict, subject));
  fmt::print(
      "{} frames in {:.2f} s ({:.0f} frames/s, {} iterations), start {:.2f} s; written to {}\n",
      result.scene.num_frames(), result.solve.seconds,
      result.scene.num_frames() / result.solve.seconds, result.solve.iterations,
      result.start_seconds, options.out);
  fmt::print("{}\n", all_met ? "every requirement is met" : "a requirement is MISSED, see above");
  return exit_code;
}

}  // namespace retarget::cli
