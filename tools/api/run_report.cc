#include "tools/api/run_report.h"

#include <sys/resource.h>

#include "io/files.h"
#include "io/text/read_file.h"
#include "solver/optimizer/kernels.h"
#include "solver/problem/parallel.h"
#include "tools/api/version.h"
#include "tools/proof/scene_proof.h"
#include "tools/report/requirement_json.h"
#include "tools/report/subject_json.h"

namespace retarget::api {
namespace {

int64_t PeakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<int64_t>(usage.ru_maxrss) * 1024;
}

report::Json InputsJson(const Job& job) {
  report::Json inputs;
  for (int f = 0; f < 2; ++f) {
    const io::LoadedClip& clip = job.clip[f];
    report::Json& input = inputs["clip_" + std::string(report::kFigure[f])];
    input = {{"file", clip.options.path},
             {"hash", clip.motion_facts ? clip.motion_hash : clip.hash},
             {"format", clip.file.format},
             {"profile", clip.facts.map.profile},
             {"units", clip.facts.metres_per_unit},
             {"up", std::string(1, clip.facts.up)},
             {"start_s", clip.options.start},
             {"skip_frames", clip.options.skip_frames},
             {"t_pose_frames", clip.facts.t_pose_frames},
             {"notes", clip.facts.notes}};
    if (!clip.options.map.empty()) input["map"] = clip.options.map;
    if (clip.motion_facts) {
      input["character"] = {{"file", clip.options.character},
                            {"hash", clip.hash},
                            {"motion_profile", clip.motion_facts->map.profile}};
    }
  }
  inputs["template"] = {{"file", job.request.template_path},
                        {"name", job.input.posture.name},
                        {"hash", io::HashOf(job.template_text)},
                        {"at_s", job.request.template_at}};
  inputs["frames"] = {job.frames.first, job.frames.last};
  inputs["fps"] = job.request.fps;
  return inputs;
}

report::Json SolveJson(const solver::RetargetResult& result) {
  report::Json history = report::Json::array();
  for (const solver::Iteration& i : result.solve.history) {
    report::Json terms;
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
  report::Json terms = report::Json::array();
  for (const solver::TermCost& c : result.costs) {
    terms.push_back({{"term", c.name},
                     {"unit", c.unit},
                     {"weight", c.weight},
                     {"cost", c.cost},
                     {"natural_cost", c.natural_cost},
                     {"largest", c.largest}});
  }
  constexpr const char* kStatus[] = {"converged", "iteration limit", "time limit", "interrupted"};
  return {
      {"backend", NameOf(result.solve.backend)},
      {"status", result.solve.stalled ? "stalled" : kStatus[static_cast<int>(result.solve.status)]},
      {"initial_cost", result.solve.initial_cost},
      {"cost", result.solve.cost},
      {"iterations", result.solve.iterations},
      {"linear_solves", result.solve.linear_solves},
      {"terms", terms},
      {"history", history}};
}

report::Json StartJson(const solver::StartChoice& start) {
  const auto cost = [](const std::optional<double>& c) {
    return c ? report::Json(*c) : report::Json(nullptr);
  };
  return {{"requested", NameOf(start.requested)},
          {"used", NameOf(start.used)},
          {"reason", start.reason},
          {"costs",
           {{"simulated", cost(start.simulated_cost)}, {"template", cost(start.template_cost)}}}};
}

report::Json PlacementJson(const solver::Placement& p) {
  return {{"yaw_rad", p.yaw}, {"shift_m", {p.shift.x(), p.shift.y(), p.shift.z()}}};
}

// Where the solved motion of one figure went, and what it was read from.
report::Json WriteBackJson(const RunFacts& run, int f) {
  const RigFacts& facts = run.job.clip[f].facts;
  const io::ClipFile& file = run.job.clip[f].file;
  report::Json written = {{"file", run.rig[f].files[0].name},
                          {"format", file.format},
                          {"units", facts.metres_per_unit},
                          {"up", std::string(1, facts.up)},
                          {"largest_error_m", run.rig[f].error_m}};
  if (file.format == "Acclaim") {
    written["skeleton"] = run.rig[f].files[1].name;
    written["fps"] = 1 / file.motion.frame_time;
  }
  if (file.format == "glTF") {
    written["animation"] = io::kAnimationName;
    if (!file.select.skin.empty()) written["skin"] = file.select.skin;
    if (!file.select.figure.empty()) written["figure"] = file.select.figure;
  }
  const std::vector<int> displaced = io::PlayedFileOf(file, run.rig[f].files).displaced;
  if (!displaced.empty()) written["displaced"] = displaced;
  if (const int rest_frames = RestFramesOf(run.job, f)) written["rest_frames"] = rest_frames;
  for (const report::NodeJoint& pair : run.rig[f].joints) {
    written["joints"][run.job.input.body[f].nodes[pair.node].name] =
        run.job.clip[f].file.motion.rig.joints[pair.joint].name;
    const int node = io::JointInFile(file, pair.joint).node;
    if (node >= 0) written["nodes"][run.job.input.body[f].nodes[pair.node].name] = node;
  }
  return written;
}

report::Json SupportsJson(const RunFacts& run, int f) {
  report::Json nodes = report::Json::array();
  for (const int n : run.result.scene.posture.supports[f]) {
    nodes.push_back(run.job.input.body[f].nodes[n].name);
  }
  return nodes;
}

}  // namespace

report::Json RunReport(const RunFacts& run, const solver::Metrics& source,
                       const solver::Metrics& baseline, const solver::Metrics& metrics) {
  const solver::RetargetResult& result = run.result;
  report::Json report = {{"generator", kGenerator},
                         {"format", 1},
                         {"exit_code", run.exit_code},
                         {"requirements_met", solver::AllMet(run.checks)}};
  report["inputs"] = InputsJson(run.job);
  report["frames"] = result.scene.num_frames();
  report["fps"] = result.scene.fps();
  report.update(report::SubjectJson(run.subject, metrics));
  for (int f = 0; f < 2; ++f) {
    report["supports"][report::kFigure[f]] = SupportsJson(run, f);
    report["placement"][report::kFigure[f]] = PlacementJson(result.placement[f]);
    report["write_back"][report::kFigure[f]] = WriteBackJson(run, f);
  }
  report["metrics"] = report::ThreeMetricsJson(run.subject, source, &baseline, metrics);
  report["requirements"] = report::ChecksJson(run.checks, run.subject.body);
  report["proof"] = proof::ProofJson(run.proof, run.subject);
  report["conflicts"] = report::DiagnosesJson(run.diagnoses, run.subject);
  report["warnings"] = result.warnings;
  report["clip_fit"] = JobFitJson(run.job.fit);
  report["literal_tangles"] = result.tangles.literal.size();
  report["solve"] = SolveJson(result);
  report["simulation"] = report::SimulationJson(result.simulation);
  report["start"] = StartJson(result.start);
  report["iterations"] = result.solve.iterations;
  report["timings"] = {{"start_s", result.start_seconds},
                       {"simulation_s", result.simulation.seconds},
                       {"solve_s", result.solve.seconds},
                       {"proof_s", run.proof.seconds},
                       {"frames_per_s", result.scene.num_frames() / result.solve.seconds}};
  report["memory"] = {{"peak_bytes", PeakBytes()}};
  report["versions"] = {{"retarget", kVersion},
                        {"kernels", solver::KernelName()},
                        {"threads", solver::NumThreads(run.job.request.settings.solve.threads)}};
  VisitSettings(run.job.request.settings,
                [&](const std::string& key, const auto& value, auto&&...) {
                  report["configuration"][key] = Written(value);
                });
  return report;
}

}  // namespace retarget::api
