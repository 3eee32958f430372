#include "solver/problem/terms/hand_contact.h"

#include "model/geometry/capsule.h"

namespace retarget::solver {
namespace {

// A point at a share of the axis of a figure's segment.
struct AxisPoint {
  int figure, segment;
  double along;
};

Vec3 PlaceOf(const Frame& frame, const AxisPoint& at) {
  const std::vector<Vec3>& node = frame.posed[at.figure].node;
  const int inner = frame.body(at.figure).nodes[at.segment].parent;
  return (1 - at.along) * node[inner] + at.along * node[at.segment];
}

// A row of what a distance has over `allowed`; `normal` points from q to p.
void AddDistanceRow(double distance, double allowed, const Vec3& normal, const AxisPoint& p,
                    const AxisPoint& q, Rows* rows) {
  if (distance <= allowed) return;
  const int row = rows->Add(distance - allowed);
  rows->AddSegmentPoint(row, p.figure, p.segment, p.along, normal);
  rows->AddSegmentPoint(row, q.figure, q.segment, q.along, -normal);
}

}  // namespace

void HandContactTerm::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (const HandContact& contact : frame.scene->hand_contacts) {
    const int f = contact.figure, g = 1 - f;
    const std::vector<Vec3>&p = frame.posed[f].node, &q = frame.posed[g].node;
    const Node &hand = frame.body(f).nodes[contact.hand], &to = frame.body(g).nodes[contact.to];
    const double touching = hand.radius + to.radius;
    const ClosestPoints closest =
        ClosestPointsOfSegments(p[hand.parent], p[contact.hand], q[to.parent], q[contact.to]);
    AddDistanceRow(closest.distance, touching, closest.normal, {f, contact.hand, closest.s},
                   {g, contact.to, closest.t}, rows);
    const AxisPoint from{f, contact.hand, contact.along}, onto{g, contact.to, contact.to_along};
    const Vec3 apart = PlaceOf(frame, from) - PlaceOf(frame, onto);
    const double distance = apart.norm();
    AddDistanceRow(distance, touching + slide_, apart / distance, from, onto, rows);
  }
}

}  // namespace retarget::solver
