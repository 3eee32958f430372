#include "tools/report/measured_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/report/report.h"

namespace retarget::report {
std::array<std::vector<int>, 2> SceneNodes(const io::SceneMotion& scene,
                                           const std::array<Body, 2>& body) {
  std::array<std::vector<int>, 2> nodes;
  for (int f = 0; f < 2; ++f) {
    std::vector<std::string> names;
    for (const Node& node : body[f].nodes) names.push_back(node.name);
    nodes[f] = scene.FindNodes(kFigure[f], names);
  }
  return nodes;
}

solver::MotionView ViewOfScene(const io::SceneMotion& scene, const std::array<Body, 2>& body) {
  const std::array<std::vector<int>, 2> nodes = SceneNodes(scene, body);
  solver::MotionView view;
  const std::vector<double>& keys = scene.key_times;
  view.num_frames = static_cast<int>(keys.size());
  view.fps =
      keys.size() > 1 ? (static_cast<double>(keys.size()) - 1) / (keys.back() - keys.front()) : 30;
  view.at = [&scene, nodes, keys](double frame, solver::PostureSample* sample) {
    const size_t k = std::min(static_cast<size_t>(frame), keys.size() - 1);
    const double next = keys[std::min(k + 1, keys.size() - 1)];
    const double time = keys[k] + (frame - static_cast<double>(k)) * (next - keys[k]);
    for (int f = 0; f < 2; ++f) {
      scene.NodeFrames(time, nodes[f], &sample->node[f], &sample->rotation[f]);
    }
  };
  return view;
}

double WriteBackError(const io::PlayedFile& file, double metres_per_unit, char up,
                      const std::vector<NodePlayed>& joints, const solver::MotionView& scene,
                      int figure) {
  const Quat turn = up == 'z' ? Quat(Eigen::AngleAxisd(-kPi / 2, Vec3::UnitX())) : Quat::Identity();
  std::vector<io::PlayedJoint> played_joints;
  for (const NodePlayed& pair : joints) played_joints.push_back(pair.joint);
  std::vector<double> times;
  for (int t = 0; t < scene.num_frames; ++t) times.push_back(t / scene.fps);
  const io::Played played = io::Play(file, played_joints, times);
  double worst = 0;
  solver::PostureSample sample;
  for (int t = 0; t < scene.num_frames; ++t) {
    // The rig's own rate ends within the last output frame.
    if (times[static_cast<size_t>(t)] > played.seconds + 1e-6) break;
    scene.at(t, &sample);
    for (size_t k = 0; k < joints.size(); ++k) {
      const Vec3 p = metres_per_unit * (turn * played.position[static_cast<size_t>(t)][k]);
      const double apart = (p - sample.node[figure][joints[k].node]).norm();
      worst = std::isfinite(apart) ? std::max(worst, apart) : HUGE_VAL;
    }
  }
  return worst;
}

MeasuredScene::MeasuredScene(std::string bytes, const std::string& name,
                             const std::array<Body, 2>& body)
    : bytes_(std::move(bytes)),
      scene_(io::ParseSceneGlb(bytes_, name)),
      view_(ViewOfScene(scene_, body)) {}

void MeasuredScene::Measure(const solver::MetricsContext& subject, const MeasuredScene& source) {
  series_ = solver::MeasureFrames(subject, view_, source.view_);
  metrics_ = solver::MetricsOf(subject, series_, solver::NodesOf(source.view_));
}

}  // namespace retarget::report
