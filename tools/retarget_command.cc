// `retarget`: two clips and a template in, a solved and verified scene out.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>

#include "io/scene_glb.h"
#include "io/settings_file.h"
#include "io/template_file.h"
#include "model/write_back.h"
#include "solver/kernels.h"
#include "solver/parallel.h"
#include "tools/commands.h"
#include "tools/files.h"
#include "tools/metrics_table.h"
#include "tools/version.h"

namespace retarget {
namespace {

volatile std::sig_atomic_t interrupted = 0;

struct FrameRange {
  int first, last;  // half-open
};

FrameRange ParseFrames(const std::string& text, int available) {
  if (text.empty()) return {0, available};
  int first = 0, last = 0, read = 0;
  const bool parsed = std::sscanf(text.c_str(), "%d:%d%n", &first, &last, &read) == 2 &&
                      read == static_cast<int>(text.size());
  if (!parsed || first < 0 || last <= first) {
    throw InputError(fmt::format("--frames {}: expected i:j with 0 <= i < j", text));
  }
  if (last > available) {
    throw InputError(fmt::format(
        "--frames {}: the clips have {} common output frames from their starts", text, available));
  }
  return {first, last};
}

Settings EffectiveSettings(const RetargetOptions& options) {
  Settings settings = options.config_path.empty() ? Settings{} : ReadSettings(options.config_path);
  for (const std::string& assignment : options.set) SetByName(&settings, assignment);
  if (options.threads >= 0) settings.solve.threads = options.threads;
  ParseStages(settings.solve.stages);
  return settings;
}

struct Job {
  std::array<LoadedClip, 2> clip;
  RetargetInput input;
  FrameRange frames;
};

Job LoadJob(const RetargetOptions& options) {
  Job job;
  job.input.posture = ReadTemplate(options.template_path);
  double common = 1e300;
  for (int f = 0; f < 2; ++f) {
    job.clip[f] = LoadClip(options.clip[f]);
    common = std::min(common, job.clip[f].duration() - options.clip[f].start);
  }
  const int available = static_cast<int>(std::floor(common * options.fps + 1e-3)) + 1;
  job.frames = ParseFrames(options.frames, available);
  for (int f = 0; f < 2; ++f) {
    job.input.body[f] = job.clip[f].binding->body();
    job.input.clip[f] = job.clip[f].Resampled(options.fps, job.frames.first, job.frames.last);
  }
  const double at = std::round(options.template_at * options.fps) - job.frames.first;
  if (at < 0 || at >= job.frames.last - job.frames.first) {
    throw InputError(fmt::format(
        "--template-at {}: lies outside the solved frames ({:.3f} to {:.3f} s)",
        options.template_at, job.frames.first / options.fps, (job.frames.last - 1) / options.fps));
  }
  job.input.template_frame = static_cast<int>(at);
  return job;
}

void TellNotes(const Job& job) {
  for (int f = 0; f < 2; ++f) {
    const RigFacts& facts = job.clip[f].facts;
    fmt::print(stderr, "clip {}: {}, profile {}, {} up {}, stature {:.2f} m\n", kFigure[f],
               job.clip[f].options.path, facts.map.profile, facts.unit_name, facts.up,
               job.input.body[f].stature);
    for (const std::string& note : facts.notes) fmt::print(stderr, "  note: {}\n", note);
  }
}

// One line per iteration on a terminal, silence elsewhere.
Progress ProgressLines() {
  const bool terminal = isatty(STDERR_FILENO);
  if (terminal) {
    fmt::print(stderr, "{:>5} {:>4} {:>12} {:>8} {:>7} {:>8} {:>8} {:>7}\n", "stage", "it", "cost",
               "step cm", "s GLI", "depth cm", "hold cm", "s");
  }
  return [terminal](const Iteration& i) {
    if (terminal) {
      fmt::print(stderr, "{:>5} {:>4} {:>12.4f} {:>8.2f} {:>7.3f} {:>8.2f} {:>8.2f} {:>7.2f}\n",
                 i.stage, i.index, i.cost, 100 * i.step_m, i.smallest_gli,
                 100 * i.deepest_penetration_m, 100 * i.hold_error_m, i.seconds);
    }
    return !interrupted;
  };
}

std::string SceneBytes(const RetargetResult& result, const std::array<Clip, 2>& clips) {
  return FormatSceneGlb({{"a", &result.scene.body[0], &clips[0], kColourA},
                         {"b", &result.scene.body[1], &clips[1], kColourB}},
                        kGenerator);
}

struct WrittenRig {
  std::string bytes;
  std::vector<NodeJoint> joints;
  double error_m = 0;  // against the scene
};

WrittenRig WriteRig(const Job& job, const RetargetResult& result, int f, const MotionView& scene) {
  const LoadedClip& clip = job.clip[f];
  const double start = clip.options.start + job.frames.first / result.scene.fps();
  const Placement& placement = result.placement[f];
  const RigMotion motion = WriteBack(
      clip.file.motion, *clip.binding, start,
      [&](const Pose& pose) { return Placed(pose, placement); }, result.scene.source[f],
      result.solved[f]);
  WrittenRig out;
  out.bytes = FormatBvh(clip.file, motion, clip.binding->stature_ratio());
  for (int n = 0; n < job.input.body[f].num_nodes(); ++n) {
    const int joint = clip.binding->JointAtNode(n);
    if (joint >= 0) out.joints.push_back({n, joint});
  }
  const std::string name = std::string(kFigure[f]) + ".bvh";
  out.error_m = WriteBackError(ParseBvh(out.bytes, name).motion, clip.facts.metres_per_unit,
                               clip.facts.up, out.joints, scene, f);
  return out;
}

int64_t PeakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<int64_t>(usage.ru_maxrss) * 1024;
}

Json InputsJson(const RetargetOptions& options, const Job& job) {
  Json inputs;
  for (int f = 0; f < 2; ++f) {
    const LoadedClip& clip = job.clip[f];
    inputs["clip_" + std::string(kFigure[f])] = {{"file", clip.options.path},
                                                 {"hash", clip.hash},
                                                 {"profile", clip.facts.map.profile},
                                                 {"units", clip.facts.metres_per_unit},
                                                 {"up", std::string(1, clip.facts.up)},
                                                 {"start_s", clip.options.start},
                                                 {"skip_frames", clip.options.skip_frames},
                                                 {"t_pose_frames", clip.facts.t_pose_frames},
                                                 {"notes", clip.facts.notes}};
  }
  inputs["template"] = {{"file", options.template_path},
                        {"hash", HashOf(ReadFile(options.template_path))},
                        {"at_s", options.template_at}};
  inputs["frames"] = {job.frames.first, job.frames.last};
  inputs["fps"] = options.fps;
  return inputs;
}

Json SolveJson(const RetargetResult& result) {
  Json history = Json::array();
  for (const Iteration& i : result.solve.history) {
    Json terms;
    for (size_t k = 0; k < i.term_cost.size(); ++k) terms[result.costs[k].name] = i.term_cost[k];
    history.push_back({{"stage", i.stage},
                       {"iteration", i.index},
                       {"cost", i.cost},
                       {"step_m", i.step_m},
                       {"smallest_gli", i.smallest_gli},
                       {"deepest_penetration_m", i.deepest_penetration_m},
                       {"hold_error_m", i.hold_error_m},
                       {"seconds", i.seconds},
                       {"terms", terms}});
  }
  Json terms = Json::array();
  for (const TermCost& c : result.costs) {
    terms.push_back({{"term", c.name},
                     {"unit", c.unit},
                     {"weight", c.weight},
                     {"cost", c.cost},
                     {"natural_cost", c.natural_cost},
                     {"largest", c.largest}});
  }
  constexpr const char* kStatus[] = {"converged", "iteration limit", "time limit", "interrupted"};
  return {
      {"backend", result.solve.backend},
      {"status", result.solve.stalled ? "stalled" : kStatus[static_cast<int>(result.solve.status)]},
      {"initial_cost", result.solve.initial_cost},
      {"cost", result.solve.cost},
      {"iterations", result.solve.iterations},
      {"linear_solves", result.solve.linear_solves},
      {"terms", terms},
      {"history", history}};
}

int ExitCodeOf(SolveStatus status, bool all_met) {
  if (status == SolveStatus::kInterrupted) return kInterrupted;
  if (status != SolveStatus::kConverged) return kLimit;
  return all_met ? kDone : kMissed;
}

Json PlacementJson(const Placement& p) {
  return {{"yaw_rad", p.yaw}, {"shift_m", {p.shift.x(), p.shift.y(), p.shift.z()}}};
}

}  // namespace

void CatchInterrupts() {
  std::signal(SIGINT, [](int) { interrupted = 1; });
}

int RunRetarget(const RetargetOptions& options) {
  // Read, map onto the body, resample.
  const Settings settings = EffectiveSettings(options);
  const Job job = LoadJob(options);
  OutputSet output(
      options.out, {"scene.glb", "source.glb", "a.bvh", "b.bvh", "report.json", "config.yaml"},
      {options.clip[0].path, options.clip[1].path, options.template_path}, options.force);
  TellNotes(job);

  // Fit the template, find tangles and contacts, place, start, solve.
  CatchInterrupts();
  const RetargetResult result = Retarget(job.input, settings, ProgressLines());
  for (const std::string& warning : result.warnings) fmt::print(stderr, "warning: {}\n", warning);

  // Measure what is written, as it would be read back.
  const MeasureSubject subject = SubjectOf(result.scene);
  MeasuredScene source(SceneBytes(result, result.scene.source), "source.glb", subject.body);
  MeasuredScene scene(SceneBytes(result, result.solved), "scene.glb", subject.body);
  source.Measure(subject, source);
  scene.Measure(subject, source);
  const Metrics* baseline = nullptr;  // of the simulated run, where there is one
  const Metrics& metrics = scene.metrics();
  std::vector<RequirementCheck> checks = CheckRequirements(subject, metrics, settings.requirements);
  std::array<WrittenRig, 2> rig;
  for (int f = 0; f < 2; ++f) {
    rig[f] = WriteRig(job, result, f, scene.view());
    checks.push_back({std::string("write-back ") + kFigure[f], rig[f].error_m, kWriteBackLimit, "m",
                      rig[f].error_m <= kWriteBackLimit, ""});
  }
  const bool all_met = AllMet(checks);
  std::vector<Conflict> conflicts;
  if (!all_met) {
    conflicts = FindConflicts(Problem(result.scene, settings), result.solve.unknowns, subject,
                              metrics, checks);
  }
  const int exit_code = ExitCodeOf(result.solve.status, all_met);

  // Report and write.
  Json report = {{"generator", kGenerator},
                 {"format", 1},
                 {"exit_code", exit_code},
                 {"requirements_met", all_met}};
  report["inputs"] = InputsJson(options, job);
  report["frames"] = result.scene.num_frames();
  report["fps"] = result.scene.fps();
  report.update(SubjectJson(subject, metrics));
  for (int f = 0; f < 2; ++f) {
    report["supports"][kFigure[f]] = Json::array();
    for (const int n : result.scene.posture.supports[f]) {
      report["supports"][kFigure[f]].push_back(job.input.body[f].nodes[n].name);
    }
    report["placement"][kFigure[f]] = PlacementJson(result.placement[f]);
    Json& written = report["write_back"][kFigure[f]];
    written = {{"file", std::string(kFigure[f]) + ".bvh"},
               {"units", job.clip[f].facts.metres_per_unit},
               {"up", std::string(1, job.clip[f].facts.up)},
               {"largest_error_m", rig[f].error_m}};
    for (const NodeJoint& pair : rig[f].joints) {
      written["joints"][job.input.body[f].nodes[pair.node].name] =
          job.clip[f].file.motion.rig.joints[pair.joint].name;
    }
  }
  report["metrics"] = ThreeMetricsJson(subject, source.metrics(), baseline, metrics);
  report["requirements"] = ChecksJson(checks);
  report["conflicts"] = ConflictsJson(conflicts);
  report["warnings"] = result.warnings;
  report["literal_tangles"] = result.tangles.literal.size();
  report["solve"] = SolveJson(result);
  report["iterations"] = result.solve.iterations;
  report["timings"] = {{"start_s", result.start_seconds},
                       {"solve_s", result.solve.seconds},
                       {"frames_per_s", result.scene.num_frames() / result.solve.seconds}};
  report["memory"] = {{"peak_bytes", PeakBytes()}};
  report["versions"] = {{"retarget", kVersion},
                        {"kernels", KernelName()},
                        {"threads", NumThreads(settings.solve.threads)}};
  VisitSettings(settings, [&](const std::string& key, const auto& value, auto&&...) {
    report["configuration"][key] = value;
  });

  output.Add("scene.glb", scene.bytes());
  output.Add("source.glb", source.bytes());
  for (int f = 0; f < 2; ++f) output.Add(std::string(kFigure[f]) + ".bvh", rig[f].bytes);
  output.Add("report.json", report.dump(1) + "\n");
  output.Add("config.yaml", FormatSettings(settings));
  output.Commit();

  if (options.json) {
    fmt::print("{}\n", report.dump(1));
    return exit_code;
  }
  fmt::print("{}", MetricsTable(subject, source.metrics(), baseline, metrics, checks));
  for (const Conflict& conflict : conflicts) fmt::print("  {}\n", conflict.sentence);
  fmt::print(
      "{} frames in {:.2f} s ({:.0f} frames/s, {} iterations), start {:.2f} s; written to {}\n",
      result.scene.num_frames(), result.solve.seconds,
      result.scene.num_frames() / result.solve.seconds, result.solve.iterations,
      result.start_seconds, options.out);
  fmt::print("{}\n", all_met ? "every requirement is met" : "a requirement is MISSED, see above");
  return exit_code;
}

}  // namespace retarget
