#include "solver/problem/terms/tangle_aim.h"

#include <cmath>

#include "model/body/path.h"
#include "model/geometry/polyline.h"

namespace retarget::solver {
namespace {
constexpr double kMostPull = 0.25;  // h
}

TangleAim::TangleAim(const Scene& scene) {
  for (const TangleTarget& held : scene.tangles) {
    items_.push_back({NodesOn(scene.body[0], held.tag.tangle.a),
                      NodesOn(scene.body[1], held.tag.tangle.b), held.sign, held.aim});
  }
}

void TangleAim::EvaluatePart(const Frame& frame, int part, Rows* rows) const {
  const Item& item = items_[static_cast<size_t>(part)];
  const std::vector<Vec3> p = PointsOn(frame.posed[0].node, item.nodes_a);
  const std::vector<Vec3> q = PointsOn(frame.posed[1].node, item.nodes_b);
  const double share = std::tanh((item.aim - item.sign * PolylineGli(p, q)) / kMostPull);
  const int row = rows->Add(kMostPull * share);
  if (!rows->derivatives()) return;
  const double slope = -item.sign * (1 - share * share);
  const PathGli gli = PolylineGliGradient(p, q);
  for (size_t i = 0; i < p.size(); ++i) {
    rows->AddNode(row, 0, item.nodes_a[i], slope * gli.gradient_p[i]);
  }
  for (size_t j = 0; j < q.size(); ++j) {
    rows->AddNode(row, 1, item.nodes_b[j], slope * gli.gradient_q[j]);
  }
}

}  // namespace retarget::solver
