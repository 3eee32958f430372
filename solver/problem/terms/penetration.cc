#include "solver/problem/terms/penetration.h"

#include "model/body/shape.h"
#include "model/geometry/capsule.h"

namespace retarget::solver {
namespace {

// The capsule round the segment that ends at a node, with a bounding sphere.
struct Capsule {
  Vec3 a, b, middle;
  double radius, reach;
};

Capsule CapsuleOf(const Body& body, const PosedBody& posed, int node) {
  Capsule c;
  c.a = posed.node[body.nodes[node].parent];
  c.b = posed.node[node];
  c.middle = 0.5 * (c.a + c.b);
  c.radius = body.nodes[node].radius;
  c.reach = 0.5 * (c.b - c.a).norm() + c.radius;
  return c;
}

std::vector<Capsule> CapsulesOf(const Body& body, const PosedBody& posed) {
  std::vector<Capsule> capsules(body.nodes.size());
  for (int n = 1; n < body.num_nodes(); ++n) capsules[n] = CapsuleOf(body, posed, n);
  return capsules;
}

bool MayTouch(const Capsule& c, const Capsule& d) {
  const double reach = c.reach + d.reach;
  return (c.middle - d.middle).squaredNorm() < reach * reach;
}

void AddDepthRow(double depth, const ClosestPoints& closest, int figure_1, int node_1, int figure_2,
                 int node_2, Rows* rows) {
  const int row = rows->Add(depth);
  rows->AddSegmentPoint(row, figure_1, node_1, closest.s, -closest.normal);
  rows->AddSegmentPoint(row, figure_2, node_2, closest.t, closest.normal);
}

}  // namespace

void Penetration::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  const std::vector<Capsule> a = CapsulesOf(frame.body(0), frame.posed[0]);
  const std::vector<Capsule> b = CapsulesOf(frame.body(1), frame.posed[1]);
  for (size_t i = 1; i < a.size(); ++i) {
    for (size_t j = 1; j < b.size(); ++j) {
      if (!MayTouch(a[i], b[j])) continue;
      const ClosestPoints closest = ClosestPointsOfSegments(a[i].a, a[i].b, b[j].a, b[j].b);
      const double depth = CapsuleDepth(closest, a[i].radius, b[j].radius);
      if (depth <= 0) continue;
      AddDepthRow(depth, closest, 0, static_cast<int>(i), 1, static_cast<int>(j), rows);
    }
  }
}

SelfPenetration::SelfPenetration(const Scene& scene)
    : pairs_{SelfPairs(scene.body[0]), SelfPairs(scene.body[1])}, allowance_(scene.num_frames()) {
  for (int t = 0; t < scene.num_frames(); ++t) {
    for (int f = 0; f < 2; ++f) {
      const PosedBody posed = PoseBody(scene.body[f], scene.source[f].frames[t]);
      const std::vector<Capsule> c = CapsulesOf(scene.body[f], posed);
      for (size_t k = 0; k < pairs_[f].size(); ++k) {
        const auto [i, j] = pairs_[f][k];
        if (!MayTouch(c[i], c[j])) continue;
        const double depth = CapsuleDepth(ClosestPointsOfSegments(c[i].a, c[i].b, c[j].a, c[j].b),
                                          c[i].radius, c[j].radius);
        if (depth > 0) allowance_[t].push_back({f, static_cast<int>(k), depth});
      }
    }
  }
}

void SelfPenetration::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    const std::vector<Capsule> c = CapsulesOf(frame.body(f), frame.posed[f]);
    for (size_t k = 0; k < pairs_[f].size(); ++k) {
      const auto [i, j] = pairs_[f][k];
      if (!MayTouch(c[i], c[j])) continue;
      const ClosestPoints closest = ClosestPointsOfSegments(c[i].a, c[i].b, c[j].a, c[j].b);
      double depth = CapsuleDepth(closest, c[i].radius, c[j].radius);
      if (depth <= 0) continue;
      for (const Allowance& allowance : allowance_[frame.t]) {
        if (allowance.figure == f && allowance.pair == static_cast<int>(k))
          depth -= allowance.depth;
      }
      if (depth > 0) AddDepthRow(depth, closest, f, i, f, j, rows);
    }
  }
}

}  // namespace retarget::solver
