#include "solver/metrics/metrics_context.h"

#include <algorithm>

namespace retarget::solver {

MotionView ViewOf(const std::array<Body, 2>& body, const std::array<Clip, 2>& clips) {
  MotionView view;
  view.num_frames = clips[0].num_frames();
  view.fps = clips[0].fps;
  view.at = [&body, &clips](double frame, PostureSample* sample) {
    for (int f = 0; f < 2; ++f) {
      const int last = clips[f].num_frames() - 1;
      const int k = std::clamp(static_cast<int>(frame), 0, last);
      const double u = frame - k;
      const PosedBody posed = PoseBody(
          body[f], u > 0 && k < last ? Interpolate(clips[f].frames[k], clips[f].frames[k + 1], u)
                                     : clips[f].frames[k]);
      sample->node[f] = posed.node;
      sample->rotation[f].clear();
      for (const Node& node : body[f].nodes) {
        sample->rotation[f].push_back(Quat(posed.rotation[node.link]));
      }
    }
  };
  return view;
}

std::vector<NodePositions> NodesOf(const MotionView& motion) {
  std::vector<NodePositions> nodes;
  PostureSample sample;
  for (int t = 0; t < motion.num_frames; ++t) {
    motion.at(t, &sample);
    nodes.push_back(sample.node);
  }
  return nodes;
}

MetricsContext MetricsContextOf(const Scene& scene) {
  MetricsContext subject{scene.body,         {}, scene.tangles, scene.holds, scene.contacts,
                         scene.hand_contacts};
  for (int f = 0; f < 2; ++f) {
    subject.length[f].push_back(0);
    for (int n = 1; n < scene.body[f].num_nodes(); ++n) {
      subject.length[f].push_back(scene.body[f].SegmentLength(n));
    }
  }
  return subject;
}

}  // namespace retarget::solver
