// Paths over a body's tree of segments, and the GLI of two paths (Ho and Komura 2007, section 4.2).
#pragma once

#include <vector>

#include "model/body/body.h"
#include "model/geometry/types.h"

namespace retarget {

// The path between two nodes. Written from the node of lower index to that of the higher.
struct Path {
  int from = 0;
  int to = 0;
  bool operator==(const Path&) const = default;
};

// The nodes that a path visits, from `from` to `to` (both included).
std::vector<int> NodesOn(const Body& body, const Path& path);

// The sign vector of a path over the body's segments, in {-1, 0, 1}^(nodes - 1): entry n - 1
// belongs to the segment that ends at node n, +1 where the path walks it away from the root.
Eigen::VectorXi SignsOf(const Body& body, const Path& path);

// GLI of every segment of one posture against every segment of another, both walked away from the
// root: entry (i, j) belongs to the segments that end at nodes i + 1 and j + 1. [(na-1) x (nb-1)]
MatX SegmentGliTable(const Body& a, const std::vector<Vec3>& nodes_a, const Body& b,
                     const std::vector<Vec3>& nodes_b);

// The points of a polyline: positions of the nodes that a path visits.
std::vector<Vec3> PointsOn(const std::vector<Vec3>& position, const std::vector<int>& nodes);

// GLI (turns) of a path over one posture against a path over another.
double GliOfPaths(const Body& a, const std::vector<Vec3>& nodes_a, const Path& path_a,
                  const Body& b, const std::vector<Vec3>& nodes_b, const Path& path_b);

}  // namespace retarget
