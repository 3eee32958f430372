#include "solver/problem/terms/tag_gli.h"

#include "model/body/path.h"
#include "model/geometry/polyline.h"

namespace retarget::solver {

TagPaths::TagPaths(const Scene& scene, const TangleTarget& held)
    : nodes{NodesOn(scene.body[0], held.tag.tangle.a), NodesOn(scene.body[1], held.tag.tangle.b)},
      sign(held.sign) {}

TagGli::TagGli(const TagPaths& paths, const Frame& frame)
    : paths_(paths),
      points_{PointsOn(frame.posed[0].node, paths.nodes[0]),
              PointsOn(frame.posed[1].node, paths.nodes[1])} {}

double TagGli::value() const { return paths_.sign * PolylineGli(points_[0], points_[1]); }

void TagGli::AddTo(Rows* rows, int row, double slope) const {
  if (!rows->derivatives()) return;
  const PathGli gli = PolylineGliGradient(points_[0], points_[1]);
  for (int f = 0; f < 2; ++f) {
    const std::vector<Vec3>& gradient = f == 0 ? gli.gradient_p : gli.gradient_q;
    for (size_t i = 0; i < gradient.size(); ++i) {
      rows->AddNode(row, f, paths_.nodes[f][i], slope * paths_.sign * gradient[i]);
    }
  }
}

}  // namespace retarget::solver
