#include "solver/problem/terms/hand_contact.h"

#include "model/geometry/capsule.h"

namespace retarget::solver {
namespace {

// A point at a share of the axis of a figure's segment.
struct AxisPoint {
  int figure, segment;
  double along;
};

int InnerNode(const Frame& frame, const AxisPoint& at) {
  return frame.body(at.figure).nodes[at.segment].parent;
}

Vec3 PlaceOf(const Frame& frame, const AxisPoint& at) {
  const std::vector<Vec3>& node = frame.posed[at.figure].node;
  return (1 - at.along) * node[InnerNode(frame, at)] + at.along * node[at.segment];
}

// d r += gradient . d point
void AddAxisPoint(const Frame& frame, const AxisPoint& at, int row, const Vec3& gradient,
                  Rows* rows) {
  rows->AddNode(row, at.figure, InnerNode(frame, at), (1 - at.along) * gradient);
  rows->AddNode(row, at.figure, at.segment, at.along * gradient);
}

// A row of what a distance has over `allowed`; `normal` points from q to p.
void AddDistanceRow(const Frame& frame, double distance, double allowed, const Vec3& normal,
                    const AxisPoint& p, const AxisPoint& q, Rows* rows) {
  if (distance <= allowed) return;
  const int row = rows->Add(distance - allowed);
  AddAxisPoint(frame, p, row, normal, rows);
  AddAxisPoint(frame, q, row, -normal, rows);
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
    AddDistanceRow(frame, closest.distance, touching, closest.normal, {f, contact.hand, closest.s},
                   {g, contact.to, closest.t}, rows);
    const AxisPoint from{f, contact.hand, contact.along}, onto{g, contact.to, contact.to_along};
    const Vec3 apart = PlaceOf(frame, from) - PlaceOf(frame, onto);
    const double distance = apart.norm();
    AddDistanceRow(frame, distance, touching + slide_, apart / distance, from, onto, rows);
  }
}

}  // namespace retarget::solver
