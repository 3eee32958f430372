// Written scenes as motions that can be measured, and written rigs against them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/playback/playback.h"
#include "io/scene/scene_motion.h"
#include "model/rig/rig.h"
#include "solver/metrics/metrics.h"

namespace retarget::report {

// The nodes of a scene that are the nodes of both bodies: "a/<node>", "b/<node>".
std::array<std::vector<int>, 2> SceneNodes(const io::SceneMotion& scene,
                                           const std::array<Body, 2>& body);

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
  void Measure(const solver::MetricsContext& subject, const MeasuredScene& source);

  const std::string& bytes() const { return bytes_; }
  const io::SceneMotion& scene() const { return scene_; }
  const solver::MotionView& view() const { return view_; }
  const solver::FrameMetrics& series() const { return series_; }
  const solver::Metrics& metrics() const { return metrics_; }

 private:
  std::string bytes_;
  io::SceneMotion scene_;
  solver::MotionView view_;
  solver::FrameMetrics series_;
  solver::Metrics metrics_;
};

// A node of the body and the joint of a written file that stands there.
struct NodeJoint {
  int node, joint;  // joint: of the clip's rig
};
struct NodePlayed {
  int node;
  io::PlayedJoint joint;
};

// Largest distance (m) between the joints of a written file and the scene's nodes, over all output
// frames that the file's keys reach. The file is played by the rules of its format
// (io/playback/playback.h), not read as a clip. Throws InputError.
double WriteBackError(const io::PlayedFile& file, double metres_per_unit, char up,
                      const std::vector<NodePlayed>& joints, const solver::MotionView& scene,
                      int figure);

}  // namespace retarget::report
