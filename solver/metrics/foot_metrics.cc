#include "solver/metrics/foot_metrics.h"

#include <algorithm>
#include <cmath>

#include "model/body/shape.h"

namespace retarget::solver {
namespace {

// Share of a step during which a height that changes evenly from `before` to `after` is under
// kNearFloor.
double ShareNearFloor(double before, double after) {
  if (before < kNearFloor && after < kNearFloor) return 1;
  if (before >= kNearFloor && after >= kNearFloor) return 0;
  return (kNearFloor - std::min(before, after)) / std::abs(after - before);
}

// Horizontal path from frame first - 1 (where there is one) to last + 1, as far as the node's
// lowest point is near the floor. Negative: it is never near it.
double NearFloorPath(const std::vector<NodePositions>& motion, int figure, const Swing& swing,
                     double radius) {
  double path = 0;
  bool near = false;
  const int end = std::min(swing.last + 1, static_cast<int>(motion.size()) - 1);
  for (int t = std::max(swing.first, 1); t <= end; ++t) {
    const Vec3 &before = motion[t - 1][figure][swing.node], &now = motion[t][figure][swing.node];
    const double share = ShareNearFloor(before.y() - radius, now.y() - radius);
    near = near || share > 0;
    path += share * std::hypot(now.x() - before.x(), now.z() - before.z());
  }
  return near ? path : -1;
}

double LargestAcceleration(const std::vector<NodePositions>& motion, int figure, int node,
                           int frame, double fps) {
  const int last = static_cast<int>(motion.size()) - 2;
  double largest = 0;
  for (int t = std::max(1, frame - kEdgeReach); t <= std::min(last, frame + kEdgeReach); ++t) {
    const Vec3 second =
        motion[t + 1][figure][node] - 2 * motion[t][figure][node] + motion[t - 1][figure][node];
    largest = std::max(largest, second.norm() * fps * fps);
  }
  return largest;
}

}  // namespace

std::vector<Swing> MeasureSwings(const MetricsContext& subject, int figure,
                                 const std::vector<NodePositions>& motion,
                                 const std::vector<NodePositions>& source) {
  std::vector<Swing> swings;
  const int frames = static_cast<int>(std::min(motion.size(), source.size()));
  const std::vector<double> radius = NodeRadii(subject.body[figure]);
  for (const int node : FootNodes(subject.body[figure])) {
    std::vector<char> planted(static_cast<size_t>(frames), 0);
    for (const Contact& c : subject.contacts[figure]) {
      if (c.node != node) continue;
      for (int t = std::max(0, c.first); t <= std::min(c.last, frames - 1); ++t) planted[t] = 1;
    }
    for (int t = 0; t < frames; ++t) {
      if (planted[t]) continue;
      Swing swing{node, t, t};
      while (swing.last + 1 < frames && !planted[swing.last + 1]) ++swing.last;
      t = swing.last;
      const double travel = NearFloorPath(motion, figure, swing, radius[node]);
      const double own = NearFloorPath(source, figure, swing, radius[node]);
      if (travel < 0 && own < 0) continue;
      swing.travel_m = std::max(travel, 0.0);
      swing.source_m = std::max(own, 0.0);
      swings.push_back(swing);
    }
  }
  return swings;
}

std::vector<ContactEdge> MeasureEdges(const MetricsContext& subject, int figure, double fps,
                                      const std::vector<NodePositions>& motion,
                                      const std::vector<NodePositions>& source) {
  std::vector<ContactEdge> edges;
  const int frames = static_cast<int>(std::min(motion.size(), source.size()));
  for (const Contact& c : subject.contacts[figure]) {
    for (const int frame : {c.first, c.last}) {
      if (frame <= 0 || frame >= frames - 1) continue;  // the clip's ends are no landing
      edges.push_back({c.node, frame, LargestAcceleration(motion, figure, c.node, frame, fps),
                       LargestAcceleration(source, figure, c.node, frame, fps)});
    }
  }
  return edges;
}

}  // namespace retarget::solver
