#include "solver/problem/terms/tangle.h"

#include "model/body/path.h"
#include "model/geometry/polyline.h"

namespace retarget::solver {

TangleTerm::TangleTerm(const Scene& scene) {
  for (const TangleTarget& held : scene.tangles) {
    items_.push_back({NodesOn(scene.body[0], held.tag.tangle.a),
                      NodesOn(scene.body[1], held.tag.tangle.b), held.sign, held.target});
  }
}

void TangleTerm::EvaluatePart(const Frame& frame, int part, Rows* rows) const {
  const Item& item = items_[static_cast<size_t>(part)];
  const std::vector<Vec3> p = PointsOn(frame.posed[0].node, item.nodes_a);
  const std::vector<Vec3> q = PointsOn(frame.posed[1].node, item.nodes_b);
  const double missing = item.target - item.sign * PolylineGli(p, q);
  if (missing <= 0) return;
  const int row = rows->Add(missing);
  if (!rows->derivatives()) return;
  const PathGli gli = PolylineGliGradient(p, q);
  for (size_t i = 0; i < p.size(); ++i) {
    rows->AddNode(row, 0, item.nodes_a[i], -item.sign * gli.gradient_p[i]);
  }
  for (size_t j = 0; j < q.size(); ++j) {
    rows->AddNode(row, 1, item.nodes_b[j], -item.sign * gli.gradient_q[j]);
  }
}

}  // namespace retarget::solver
