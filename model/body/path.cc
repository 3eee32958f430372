#include "model/body/path.h"

#include <algorithm>

#include "model/geometry/gli.h"
#include "model/geometry/polyline.h"

namespace retarget {

std::vector<int> NodesOn(const Body& body, const Path& path) {
  std::vector<int> up = {path.from}, down = {path.to};
  while (up.back() != down.back()) {
    // Parents come before their children, so the larger index is never an ancestor of the other.
    std::vector<int>& side = up.back() > down.back() ? up : down;
    side.push_back(body.nodes[side.back()].parent);
  }
  up.insert(up.end(), down.rbegin() + 1, down.rend());
  return up;
}

Eigen::VectorXi SignsOf(const Body& body, const Path& path) {
  Eigen::VectorXi signs = Eigen::VectorXi::Zero(body.num_nodes() - 1);
  const std::vector<int> nodes = NodesOn(body, path);
  for (size_t i = 0; i + 1 < nodes.size(); ++i) {
    const bool outward = body.nodes[nodes[i + 1]].parent == nodes[i];
    signs[(outward ? nodes[i + 1] : nodes[i]) - 1] = outward ? 1 : -1;
  }
  return signs;
}

MatX SegmentGliTable(const Body& a, const std::vector<Vec3>& nodes_a, const Body& b,
                     const std::vector<Vec3>& nodes_b) {
  MatX table(a.num_nodes() - 1, b.num_nodes() - 1);
  for (int j = 1; j < b.num_nodes(); ++j) {
    const Vec3& c = nodes_b[b.nodes[j].parent];
    for (int i = 1; i < a.num_nodes(); ++i) {
      table(i - 1, j - 1) = SegmentGli(nodes_a[a.nodes[i].parent], nodes_a[i], c, nodes_b[j]);
    }
  }
  return table;
}

std::vector<Vec3> PointsOn(const std::vector<Vec3>& position, const std::vector<int>& nodes) {
  std::vector<Vec3> points;
  points.reserve(nodes.size());
  for (const int n : nodes) points.push_back(position[n]);
  return points;
}

double GliOfPaths(const Body& a, const std::vector<Vec3>& nodes_a, const Path& path_a,
                  const Body& b, const std::vector<Vec3>& nodes_b, const Path& path_b) {
  return PolylineGli(PointsOn(nodes_a, NodesOn(a, path_a)), PointsOn(nodes_b, NodesOn(b, path_b)));
}

}  // namespace retarget
