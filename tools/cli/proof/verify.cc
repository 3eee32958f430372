// `retarget verify DIR`: every metric again and the proof, from the written files alone.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "io/clip_file.h"
#include "io/files.h"
#include "io/settings_file.h"
#include "io/text/read_file.h"
#include "tools/cli/commands.h"
#include "tools/proof/scene_proof.h"
#include "tools/report/measured_scene.h"
#include "tools/report/metrics_table.h"
#include "tools/report/requirement_json.h"
#include "tools/report/subject_json.h"

namespace retarget::cli {
namespace {

// Largest distance of the written rig to the scene (m), from the files.
double WriteBackOf(const report::Json& written, const std::string& folder, int f,
                   const solver::MotionView& scene, const Body& body) {
  io::PlayedFile file;
  file.format = written.at("format");
  file.name = folder + "/" + written.at("file").get<std::string>();
  file.bytes = io::ReadFile(file.name);
  file.folder = folder;
  file.animation = written.value("animation", "");
  file.fps = written.value("fps", io::kAcclaimFps);
  if (written.contains("skeleton")) {
    file.skeleton = io::ReadFile(folder + "/" + written.at("skeleton").get<std::string>());
  }
  file.displaced = written.value("displaced", std::vector<int>());
  file.rest_frames = std::max(0, written.value("rest_frames", 0));
  std::vector<report::NodePlayed> joints;
  for (const auto& [node, bone] : written.at("joints").items()) {
    io::PlayedJoint joint{bone.get<std::string>()};
    if (written.contains("nodes")) joint.node = written.at("nodes").value(node, -1);
    joints.push_back({body.FindNode(node), joint});
  }
  const std::string up = written.at("up");
  return report::WriteBackError(file, written.at("units"), up[0], joints, scene, f);
}

void CheckFrames(const report::MeasuredScene& scene, const std::string& path, int frames) {
  if (scene.view().num_frames == frames) return;
  throw InputError(
      fmt::format("{}: has {} frames, scene.glb {}", path, scene.view().num_frames, frames));
}

}  // namespace

int RunVerify(const std::string& folder, bool samples, bool json) {
  const std::string report_path = folder + "/report.json";
  const report::Json report = report::ReadReport(folder);
  const solver::MetricsContext subject = report::SubjectFromJson(report, report_path);
  const Settings settings = io::ReadSettings(folder + "/config.yaml");
  report::MeasuredScene scene(io::ReadFile(folder + "/scene.glb"), folder + "/scene.glb",
                              subject.body);
  const int frames = scene.view().num_frames;
  report::MeasuredScene source(io::ReadFile(folder + "/source.glb"), folder + "/source.glb",
                               subject.body);
  CheckFrames(source, folder + "/source.glb", frames);
  std::optional<report::MeasuredScene> baseline;
  if (std::filesystem::exists(folder + "/baseline.glb")) {
    baseline.emplace(io::ReadFile(folder + "/baseline.glb"), folder + "/baseline.glb",
                     subject.body);
    CheckFrames(*baseline, folder + "/baseline.glb", frames);
  }
  for (int f = 0; f < 2; ++f) {
    for (const Contact& c : subject.contacts[f]) {
      if (c.node < 0 || c.first < 0 || c.last >= frames || c.last < c.first) {
        throw InputError(report_path + ": a contact lies outside the scene's frames");
      }
    }
  }
  source.Measure(subject, source);
  scene.Measure(subject, source);
  if (baseline) baseline->Measure(subject, source);
  const solver::Metrics& metrics = scene.metrics();
  std::vector<solver::RequirementCheck> checks =
      solver::CheckRequirements(subject, metrics, settings.requirements);
  std::array<double, 2> write_back_m;
  std::array<std::string, 2> file;
  for (int f = 0; f < 2; ++f) {
    try {
      const report::Json& written = report.at("write_back").at(report::kFigure[f]);
      file[f] = written.at("file");
      write_back_m[f] = WriteBackOf(written, folder, f, scene.view(), subject.body[f]);
    } catch (const nlohmann::json::exception& error) {
      throw InputError(report_path + ": " + error.what());
    }
  }
  for (solver::RequirementCheck& check :
       solver::CheckWritten(metrics, write_back_m, settings.requirements)) {
    if (check.kind == solver::RequirementKind::kWriteBack) check.file = file[check.figure];
    checks.push_back(check);
  }
  std::optional<solver::Proof> proved;
  if (!samples) {
    proved = proof::ProveScene(scene.scene(), subject, settings.requirements);
    solver::JudgeByProof(*proved, &checks);
  }
  const bool all_met = solver::AllMet(checks);
  const solver::Metrics* baseline_metrics = baseline ? &baseline->metrics() : nullptr;
  if (json) {
    report::Json out = {{"requirements_met", all_met},
                        {"requirements", report::ChecksJson(checks, subject.body)},
                        {"metrics", report::ThreeMetricsJson(subject, source.metrics(),
                                                             baseline_metrics, metrics)}};
    if (proved) out["proof"] = proof::ProofJson(*proved, subject);
    fmt::print("{}\n", out.dump(1));
  } else {
    fmt::print("{}",
               report::MetricsTable(subject, source.metrics(), baseline_metrics, metrics, checks));
    if (proved) fmt::print("{}\n", proof::ProofSentence(*proved, subject));
    fmt::print("{}\n", all_met ? "every requirement is met" : "a requirement is MISSED, see above");
  }
  return all_met ? kDone : kMissed;
}

}  // namespace retarget::cli
