#include "solver/terms/ground.h"

#include <algorithm>

namespace retarget {

std::vector<double> NodeRadii(const Body& body) {
  std::vector<double> radius(body.nodes.size(), 0);
  for (int n = 1; n < body.num_nodes(); ++n) {
    const int parent = body.nodes[n].parent;
    radius[n] = std::max(radius[n], body.nodes[n].radius);
    radius[parent] = std::max(radius[parent], body.nodes[n].radius);
  }
  return radius;
}

void Ground::Evaluate(const Frame& frame, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    for (int n = 0; n < frame.body(f).num_nodes(); ++n) {
      const double depth = radius_[f][n] - frame.posed[f].node[n].y();
      if (depth <= 0) continue;
      rows->AddNode(rows->Add(depth), f, n, -Vec3::UnitY());
    }
  }
}

}  // namespace retarget
