#include "tools/report/measured_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/report/report.h"

namespace retarget::report {
namespace {

std::vector<std::string> NodeNames(const Body& body) {
  std::vector<std::string> names;
  for (const Node& node : body.nodes) names.push_back(node.name);
  return names;
}

}  // namespace

solver::MotionView ViewOfScene(const io::SceneMotion& scene, const std::array<Body, 2>& body) {
  std::array<std::vector<int>, 2> nodes;
  for (int f = 0; f < 2; ++f) nodes[f] = scene.FindNodes(kFigure[f], NodeNames(body[f]));
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

double WriteBackError(const RigMotion& written, const Rig& rig, double metres_per_unit, char up,
                      const std::vector<NodeJoint>& joints, const solver::MotionView& scene,
                      int figure) {
  const Quat turn = up == 'z' ? Quat(Eigen::AngleAxisd(-kPi / 2, Vec3::UnitX())) : Quat::Identity();
  double worst = 0;
  solver::PostureSample sample;
  const double end = (written.num_frames() - 1) * written.frame_time;
  for (int t = 0; t < scene.num_frames; ++t) {
    const double time = t / scene.fps;
    if (time > end + 1e-6) break;  // the rig's own rate ends within the last output frame
    scene.at(t, &sample);
    const PosedRig posed = PoseRig(written.rig, SampleRig(written, time));
    for (const NodeJoint& pair : joints) {
      const int joint = written.rig.Find(rig.joints[pair.joint].name);
      if (joint < 0) return HUGE_VAL;  // the file has lost a joint
      const Vec3 p = metres_per_unit * (turn * posed.position[joint]);
      worst = std::max(worst, (p - sample.node[figure][pair.node]).norm());
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
