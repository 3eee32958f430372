// `retarget`: two clips and a template in, a solved and verified scene out.
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "io/files.h"
#include "io/settings_file.h"
#include "tools/api/job.h"
#include "tools/cli/commands.h"
#include "tools/report/metrics_table.h"

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

// "i:j"; empty: all. Whether they fit the clips is seen later.
std::optional<FrameRange> ParseFrames(const std::string& text) {
  if (text.empty()) return std::nullopt;
  FrameRange frames;
  int read = 0;
  const bool parsed = std::sscanf(text.c_str(), "%d:%d%n", &frames.first, &frames.last, &read) == 2;
  if (!parsed || read != static_cast<int>(text.size())) {
    throw InputError(fmt::format("--frames {}: expected i:j with 0 <= i < j", text));
  }
  return frames;
}

}  // namespace

void CatchInterrupts() {
  std::signal(SIGINT, [](int) { interrupted = 1; });
}

Settings SettingsOf(const SettingsOptions& options) {
  Settings settings =
      options.config_path.empty() ? Settings{} : io::ReadSettings(options.config_path);
  for (const std::string& assignment : options.set) io::SetByName(&settings, assignment, "--set");
  return settings;
}

Request RequestOf(const RetargetOptions& options) {
  Request request;
  request.words = {.frames = "--frames",
                   .template_at = "--template-at",
                   .show = "--show",
                   .rest = "--rest",
                   .also = "--also"};
  request.clip = options.clip;
  request.template_path = options.template_path;
  request.settings = SettingsOf({options.config_path, options.set});
  if (options.threads >= 0) request.settings.solve.threads = options.threads;
  request.fps = options.fps;
  request.frames = ParseFrames(options.frames);
  request.template_at = options.template_at;
  request.show = options.show == "characters" ? Show::kCharacters : Show::kFigures;
  request.page = options.page;
  request.also = options.also;
  request.rest = options.rest == "t-pose" ? Rest::kTPose : Rest::kKeep;
  return request;
}

int RunRetarget(const RetargetOptions& options) {
  // What is asked for, and whether it may be written.
  const api::Job job = api::LoadJob(RequestOf(options));
  io::OutputSet output(options.out, api::OutputNames(job), api::InputPaths(job.request),
                       options.force);
  const std::vector<std::string> recognised = api::RecognitionNotes(job);
  if (!options.quiet) PrintNotes(recognised, 0);

  CatchInterrupts();
  const Result result =
      api::RunJob(job, options.progress == "json" ? ProgressJson() : ProgressLines(options.quiet));
  PrintNotes(result.notes, recognised.size());

  for (const io::NamedBytes& file : result.files) output.Add(file.name, file.bytes);
  output.Commit();

  const int exit_code = ExitCodeOf(result.status);
  if (options.quiet) return exit_code;
  if (options.json) {
    fmt::print("{}", result.File("report.json"));
    return exit_code;
  }
  fmt::print("{}",
             report::MetricsTable(solver::MetricsContextOf(result.run.scene), result.source_metrics,
                                  &result.baseline_metrics, result.metrics, result.requirements));
  for (const solver::Diagnosis& diagnosis : result.diagnoses) {
    fmt::print("  {}\n", DiagnosisText(diagnosis, result));
  }
  const solver::SolveResult& solve = result.run.solve;
  const int frames = result.run.scene.num_frames();
  fmt::print(
      "{} frames in {:.2f} s ({:.0f} frames/s, {} iterations), start {:.2f} s; written to {}\n",
      frames, solve.seconds, frames / solve.seconds, solve.iterations, result.run.start_seconds,
      options.out);
  fmt::print("{}\n", solver::AllMet(result.requirements) ? "every requirement is met"
                                                         : "a requirement is MISSED, see above");
  return exit_code;
}

void PrintNotes(const std::vector<std::string>& notes, size_t from) {
  for (size_t k = from; k < notes.size(); ++k) fmt::print(stderr, "{}\n", notes[k]);
}

}  // namespace retarget::cli
