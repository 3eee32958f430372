// Updates per second of a drag in the shipped template: both figures, holds, limits, penetration
// and floor on; b's head and a's elbow go round a loop in 200 small steps, each warm started.
// Usage: pose_bench [steps]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/template_file.h"
#include "solver/optimizer/pose_solve.h"

namespace retarget {
namespace {

struct Drag {
  std::vector<double> ms;  // per update, sorted
  double error_m = 0, pin_m = 0, iterations = 0;

  double Percentile(double share) const {
    return ms[std::min(ms.size() - 1, static_cast<size_t>(share * static_cast<double>(ms.size())))];
  }
};

Drag DragRound(const TemplatePosture& posture, Backend backend, int figure, const char* node,
               double radius, int steps) {
  solver::PoseSettings settings = solver::DefaultPoseSettings();
  settings.settings.solve.backend = backend;
  settings.max_iterations = 12;
  solver::PoseTask task;
  task.body = posture.body;
  task.before = posture.pose;
  task.holds = posture.holds;
  const int n = task.body[figure].FindNode(node);
  const auto at = [&](int f, int k) { return PoseBody(task.body[f], task.before[f]).node[k]; };
  for (int f = 0; f < 2; ++f) {
    for (const int k : posture.supports[f]) task.pins.push_back({f, k, at(f, k)});
  }
  Drag drag;
  std::array<Pose, 2> pose = task.before;
  for (int k = 1; k <= steps; ++k) {
    const double turn = 2 * kPi * k / steps;
    const Vec3 round(std::sin(turn), -0.5 * std::abs(std::sin(2 * turn)), 1 - std::cos(turn));
    task.drags = {{figure, n, at(figure, n) + radius * round}};
    const solver::PoseResult result = solver::SolvePose(task, pose, settings);
    pose = result.pose;
    drag.ms.push_back(1e3 * result.seconds);
    drag.error_m = std::max(drag.error_m, result.drag_error_m);
    drag.pin_m = std::max(drag.pin_m, result.pin_error_m);
    drag.iterations += static_cast<double>(result.iterations) / steps;
  }
  std::sort(drag.ms.begin(), drag.ms.end());
  return drag;
}

int Run(int steps) {
  const TemplatePosture posture =
      io::ReadTemplate(std::string(RETARGET_EXAMPLE_DIR) + "/template.yaml");
  const struct {
    int figure;
    const char* node;
    double radius;  // m
  } paths[] = {
      {1, "head_top", 0.1}, {0, "left_elbow", 0.05}, {0, "head_top", 0.1}, {1, "root", 0.05}};
  fmt::print("{} steps; per update: median and 99th percentile\n", steps);
  for (const Backend backend : {Backend::kBanded, Backend::kCeres}) {
    for (const auto& path : paths) {
      const Drag drag = DragRound(posture, backend, path.figure, path.node, path.radius, steps);
      fmt::print(
          "{:<7} {}/{:<11} {:6.2f} ms {:6.2f} ms  {:4.1f} iterations  largest error {:.1f} cm, "
          "pins {:.1f} mm\n",
          NameOf(backend), path.figure == 0 ? "a" : "b", path.node, drag.Percentile(0.5),
          drag.Percentile(0.99), drag.iterations, 100 * drag.error_m, 1000 * drag.pin_m);
    }
  }
  return 0;
}

}  // namespace
}  // namespace retarget

int main(int argc, char** argv) { return retarget::Run(argc > 1 ? std::atoi(argv[1]) : 200); }
