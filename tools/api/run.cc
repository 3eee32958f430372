// Run: from clips and template to a solved, measured and written scene.
#include <algorithm>
#include <utility>

#include "io/settings_file.h"
#include "model/rig/t_pose_frame.h"
#include "model/rig/write_back.h"
#include "solver/start/clip_fit.h"
#include "tools/api/data_out.h"
#include "tools/api/job.h"
#include "tools/api/run_report.h"
#include "tools/api/version.h"
#include "tools/proof/certificate.h"
#include "tools/report/diagnosis_text.h"
#include "tools/report/measured_scene.h"
#include "tools/report/page.h"
#include "tools/report/requirement_text.h"
#include "tools/report/series.h"

namespace retarget {
namespace api {
namespace {

// The solved motion of one figure on its clip's own rig, and read back from its files.
WrittenRig WriteRig(const Job& job, const solver::RetargetResult& result, int f,
                    const solver::MotionView& scene, RigMotion* motion) {
  const io::LoadedClip& clip = job.clip[f];
  const double start = clip.options.start + job.frames.first / result.scene.fps();
  const solver::Placement& placement = result.placement[f];
  *motion = WriteBack(
      clip.file.motion, *clip.binding, start,
      [&](const Pose& pose) { return solver::Placed(pose, placement); }, result.scene.source[f],
      result.solved[f]);
  RigMotion written = *motion;
  const int rest_frames = RestFramesOf(job, f);
  if (rest_frames > 0) {
    written.frames.insert(written.frames.begin(),
                          TPoseFrame(clip.file.motion.rig, *clip.binding,
                                     result.solved[f].frames.front().root_position));
  }
  WrittenRig out;
  out.files =
      io::FormatClipFile(clip.file, written, report::kFigure[f], clip.binding->stature_ratio());
  for (int n = 0; n < job.input.body[f].num_nodes(); ++n) {
    const int joint = clip.binding->JointAtNode(n);
    if (joint >= 0) out.joints.push_back({n, joint});
  }
  std::vector<report::NodePlayed> played;
  for (const report::NodeJoint& pair : out.joints) {
    played.push_back({pair.node, io::JointInFile(clip.file, pair.joint)});
  }
  io::PlayedFile file = io::PlayedFileOf(clip.file, out.files);
  file.rest_frames = rest_frames;
  out.error_m =
      report::WriteBackError(file, clip.facts.metres_per_unit, clip.facts.up, played, scene, f);
  return out;
}

// One performer beside herself at another time. (The same time: solver::IsSameMotion.)
bool IsOneFileAtTwoTimes(const Job& job) {
  const auto source = [&](int f) {
    const io::LoadedClip& clip = job.clip[f];
    const std::string& path = clip.options.path;
    const size_t selection = path.find('#');
    return (clip.motion_facts ? clip.motion_hash : clip.hash) +
           (selection == std::string::npos ? "" : path.substr(selection));
  };
  return source(0) == source(1) && !solver::IsSameMotion(job.input.clip[0], job.input.clip[1]);
}

Status StatusOf(solver::SolveStatus status, bool all_met) {
  if (status == solver::SolveStatus::kInterrupted) return Status::kInterrupted;
  if (status != solver::SolveStatus::kConverged) return Status::kLimitReached;
  return all_met ? Status::kSolved : Status::kRequirementMissed;
}

}  // namespace

Result RunJob(const Job& job, const Progress& progress) {
  const Settings& settings = job.request.settings;
  const bool characters = job.request.show == Show::kCharacters;
  Result result;
  result.notes = RecognitionNotes(job);
  if (characters) CheckCharacters(job);

  // Fit the template, find tangles and contacts, place, start, solve.
  result.run = solver::Retarget(job.input, settings, [&](const solver::Iteration& iteration) {
    return !progress || progress(iteration);
  });
  if (IsOneFileAtTwoTimes(job)) {
    result.run.warnings.push_back("both clips are the same file, at different instants");
  }
  const solver::Scene& scene = result.run.scene;
  std::vector<std::string>& warnings = result.run.warnings;
  for (const std::string& warning : job.fit.warnings) {
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
      warnings.push_back(warning);
    }
  }
  for (const std::string& warning : warnings) {
    const std::string note = "warning: " + warning;  // those of the fit have been told
    if (std::find(result.notes.begin(), result.notes.end(), note) == result.notes.end()) {
      result.notes.push_back(note);
    }
  }

  // Measure what is written, as it would be read back.
  const solver::MetricsContext subject = solver::MetricsContextOf(scene);
  report::MeasuredScene source(SceneBytes(scene, result.source()), "source.glb", subject.body);
  report::MeasuredScene baseline(SceneBytes(scene, result.baseline()), "baseline.glb",
                                 subject.body);
  const std::string figures = SceneBytes(scene, result.solved());
  std::vector<std::string> left_out;
  report::MeasuredScene solved(
      characters ? CharacterScene(job, result.run, figures, &left_out) : figures, "scene.glb",
      subject.body);
  for (const std::string& note : left_out) result.notes.push_back("note: " + note);
  for (report::MeasuredScene* motion : {&source, &baseline, &solved}) {
    motion->Measure(subject, source);
  }
  result.source_metrics = source.metrics();
  result.baseline_metrics = baseline.metrics();
  result.metrics = solved.metrics();

  // Judge.
  result.requirements = solver::CheckRequirements(subject, result.metrics, settings.requirements);
  std::array<WrittenRig, 2> rig;
  for (int f = 0; f < 2; ++f) {
    rig[f] = WriteRig(job, result.run, f, solved.view(), &result.rig_motion[f]);
  }
  for (const solver::RequirementCheck& check : solver::CheckWritten(
           result.metrics, {rig[0].error_m, rig[1].error_m}, settings.requirements)) {
    result.requirements.push_back(check);
  }
  result.proof = proof::ProveScene(solved.scene(), subject, settings.requirements);
  solver::JudgeByProof(result.proof, &result.requirements);
  const bool all_met = solver::AllMet(result.requirements);
  if (!all_met) {
    result.diagnoses = solver::Diagnose(solver::Problem(scene, settings), result.run.solve.unknowns,
                                        subject, result.metrics, result.requirements);
  }
  result.status = StatusOf(result.run.solve.status, all_met);

  // Report.
  const report::Json report =
      RunReport({job, result.run, subject, result.requirements, result.diagnoses,
                 ExitCodeOf(result.status), rig, result.proof},
                result.source_metrics, result.baseline_metrics, result.metrics);
  result.files = {{"scene.glb", solved.bytes()},
                  {"source.glb", source.bytes()},
                  {"baseline.glb", baseline.bytes()}};
  for (WrittenRig& written : rig) {
    for (io::NamedBytes& file : written.files) result.files.push_back(std::move(file));
  }
  result.files.push_back({"report.json", report.dump(1) + "\n"});
  if (job.request.page) {
    const report::Json series =
        report::SeriesJson(subject, source.series(), &baseline.series(), solved.series());
    result.files.push_back({"report.html", report::FormatReportPage({report, series, source.bytes(),
                                                                     baseline.bytes(), figures})});
  }
  result.files.push_back({"config.yaml", io::FormatSettings(settings)});
  for (const std::string& kind : job.request.also) {
    result.files.push_back({"scene." + kind, kind == "npz"
                                                 ? FormatSceneNpz(result.run, solved.series())
                                                 : FormatSceneCsv(result.run, solved.series())});
  }
  result.files.push_back(
      {proof::kCertificate,
       proof::FormatCertificate(result.proof, subject, solved.bytes(), kGenerator)});
  return result;
}

}  // namespace api

int ExitCodeOf(Status status) {
  switch (status) {
    case Status::kSolved:
      return 0;
    case Status::kRequirementMissed:
      return 3;
    case Status::kLimitReached:
      return 4;
    case Status::kInterrupted:
      break;
  }
  return 130;
}

const std::string& Result::File(const std::string& name) const {
  static const std::string kNone;
  for (const io::NamedBytes& file : files) {
    if (file.name == name) return file.bytes;
  }
  return kNone;
}

Result Run(const Request& request, const Progress& progress) {
  return api::RunJob(api::LoadJob(request), progress);
}

std::string RequirementName(const solver::RequirementCheck& requirement) {
  return report::NameOf(requirement);
}

std::string DiagnosisText(const solver::Diagnosis& diagnosis, const Result& result) {
  return report::DiagnosisSentence(diagnosis, solver::MetricsContextOf(result.run.scene));
}

const char* Version() { return api::kVersion; }

}  // namespace retarget
