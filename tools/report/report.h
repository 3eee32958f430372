// report.json, and what it is made of. The schema is described in docs/report.md.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/load_clip.h"
#include "io/scene/scene_motion.h"
#include "solver/metrics/diagnosis.h"
#include "solver/retarget.h"

namespace retarget::report {

using Json = nlohmann::ordered_json;

inline constexpr const char* kFigure[2] = {"a", "b"};  // names in files and messages

// report.json of a run's folder. Throws InputError.
Json ReadReport(const std::string& folder);

// A written scene as a motion to be measured.
solver::MotionView ViewOfScene(const io::SceneMotion& scene, const std::array<Body, 2>& body);

// A scene's file and what is measured of it.
class MeasuredScene {
 public:
  // Throws InputError. `name` is what messages call the bytes.
  MeasuredScene(std::string bytes, const std::string& name, const std::array<Body, 2>& body);
  MeasuredScene(const MeasuredScene&) = delete;  // the view looks at the scene
  MeasuredScene& operator=(const MeasuredScene&) = delete;
  // Fills series and metrics; `source` may be this scene itself.
  void Measure(const solver::MeasureSubject& subject, const MeasuredScene& source);

  const std::string& bytes() const { return bytes_; }
  const solver::MotionView& view() const { return view_; }
  const solver::FrameSeries& series() const { return series_; }
  const solver::Metrics& metrics() const { return metrics_; }

 private:
  std::string bytes_;
  io::SceneMotion scene_;
  solver::MotionView view_;
  solver::FrameSeries series_;
  solver::Metrics metrics_;
};

// Largest distance (m) between the joints of a written-back motion and the scene's nodes, over all
// output frames. `joints` pairs nodes with joints of `rig`, which are found in `written` by name.
struct NodeJoint {
  int node, joint;
};
double WriteBackError(const RigMotion& written, const Rig& rig, double metres_per_unit, char up,
                      const std::vector<NodeJoint>& joints, const solver::MotionView& scene,
                      int figure);
inline constexpr double kWriteBackLimit = 0.005;  // m

Json SimulationJson(const solver::SimulationResult& simulation);
// When the figures came to rest, and how far from the template.
std::string SettleSentence(const solver::SimulationResult& simulation);

Json MetricsJson(const solver::MeasureSubject& subject, const solver::Metrics& metrics);
// All three as report.json has them; `baseline` may be null.
Json ThreeMetricsJson(const solver::MeasureSubject& subject, const solver::Metrics& source,
                      const solver::Metrics* baseline, const solver::Metrics& result);
Json PassThroughsJson(const solver::MeasureSubject& subject,
                      const std::vector<solver::PassThrough>& passes);
Json SubjectJson(const solver::MeasureSubject& subject, const solver::Metrics& result);
// The subject of a report read back. Throws InputError naming `path`.
solver::MeasureSubject SubjectFromJson(const Json& report, const std::string& path);

Json ConflictsJson(const std::vector<solver::Conflict>& conflicts);
Json ChecksJson(const std::vector<solver::RequirementCheck>& checks);

}  // namespace retarget::report
