#include "solver/metrics/plausibility.h"

#include <algorithm>
#include <cmath>

#include "model/body/path.h"
#include "model/body/shape.h"
#include "model/geometry/so3.h"

namespace retarget::solver {
namespace {

void Include(double value, int frame, int node, WorstAt* worst) {
  if (!(std::isnan(worst->value) || value > worst->value)) return;
  *worst = {value, frame, node};
}

struct Lowest {
  double height;
  int node;
};
Lowest LowestPoint(const std::vector<Vec3>& node, const std::vector<double>& radius) {
  Lowest lowest{std::numeric_limits<double>::infinity(), 0};
  for (size_t n = 0; n < node.size(); ++n) {
    const double height = node[n].y() - radius[n];
    if (height < lowest.height) lowest = {height, static_cast<int>(n)};
  }
  return lowest;
}

void IncludePoseError(const std::vector<int>& nodes, const std::vector<Vec3>& p,
                      const std::vector<Vec3>& q, const Quat& yaw, int t, WorstAt* worst) {
  double sum = 0;
  WorstAt furthest;
  for (const int n : nodes) {
    const double away = ((p[n] - p[0]) - yaw * (q[n] - q[0])).norm();
    sum += away;
    Include(away, t, n, &furthest);
  }
  if (!nodes.empty()) Include(sum / static_cast<double>(nodes.size()), t, furthest.node, worst);
}

Vec3 ThirdDifference(const std::vector<NodePositions>& frames, int f, size_t t, size_t n) {
  return frames[t + 3][f][n] - 3 * frames[t + 2][f][n] + 3 * frames[t + 1][f][n] - frames[t][f][n];
}

void MeasureJerk(const FrameMetrics& series, const std::vector<NodePositions>& source, int f,
                 WorstAt* out) {
  const double own = MeanJerk(source, f, series.fps);
  const double jerk = MeanJerk(series.node, f, series.fps);
  if (std::isnan(own) || std::isnan(jerk)) return;
  WorstAt largest;
  for (size_t t = 0; t + 3 < series.node.size(); ++t) {
    for (size_t n = 0; n < series.node[t][f].size(); ++n) {
      Include(ThirdDifference(series.node, f, t, n).norm(), static_cast<int>(t) + 1,
              static_cast<int>(n), &largest);
    }
  }
  *out = {jerk / std::max(own, kStillJerk), largest.frame, largest.node};
}

}  // namespace

std::vector<int> UntaggedNodes(const MetricsContext& subject, int figure) {
  const Body& body = subject.body[figure];
  std::vector<char> tagged(body.nodes.size(), 0);
  for (const TangleTarget& held : subject.tangles) {
    const Path& path = figure == 0 ? held.tag.tangle.a : held.tag.tangle.b;
    for (const int n : NodesOn(body, path)) tagged[n] = 1;
  }
  const bool none = std::all_of(tagged.begin() + 1, tagged.end(), [](char c) { return c != 0; });
  std::vector<int> nodes;
  for (int n = 1; n < body.num_nodes(); ++n) {
    if (none || !tagged[n]) nodes.push_back(n);
  }
  return nodes;
}

double MeanJerk(const std::vector<NodePositions>& frames, int figure, double fps) {
  double sum = 0;
  int count = 0;
  for (size_t t = 0; t + 3 < frames.size(); ++t) {
    for (size_t n = 0; n < frames[t][figure].size(); ++n) {
      sum += ThirdDifference(frames, figure, t, n).norm();
      ++count;
    }
  }
  return count > 0 ? sum / count * fps * fps * fps : std::numeric_limits<double>::quiet_NaN();
}

Plausibility MeasurePlausibility(const MetricsContext& subject, int figure,
                                 const FrameMetrics& series,
                                 const std::vector<NodePositions>& source) {
  Plausibility out;
  const Body& body = subject.body[figure];
  const std::vector<double> radius = NodeRadii(body);
  const std::vector<int> nodes = UntaggedNodes(subject, figure);
  const int neck = body.FindNode("neck");  // -1: the figure has no trunk to judge
  const size_t frames = std::min(series.node.size(), source.size());
  for (size_t k = 0; k < frames; ++k) {
    const int t = static_cast<int>(k);
    const std::vector<Vec3>&p = series.node[k][figure], &q = source[k][figure];
    const Quat yaw = YawRotation(BestYaw(q, p));
    IncludePoseError(nodes, p, q, yaw, t, &out.pose_error_m);
    const BeyondLimit& beyond = series.beyond_limit[figure][k];
    Include(beyond.deg, t, beyond.node, &out.joint_limit_deg);
    if (subject.carried[figure]) continue;
    if (neck >= 0) {
      const Vec3 up = yaw * (q[neck] - q[0]), now = p[neck] - p[0];
      const double tilt = std::atan2(up.cross(now).norm(), up.dot(now)) / kDegree;
      Include(tilt, t, neck, &out.trunk_tilt_deg);
    }
    const Lowest lowest = LowestPoint(p, radius);
    const double before = std::max(0.0, LowestPoint(q, radius).height);
    Include(std::max(0.0, lowest.height - before), t, lowest.node, &out.floating_m);
  }
  MeasureJerk(series, source, figure, &out.jerk_ratio);
  return out;
}

}  // namespace retarget::solver
