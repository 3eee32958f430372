#include "model/body/pass_through.h"

#include <algorithm>
#include <cmath>

#include "model/geometry/capsule.h"
#include "model/geometry/gli.h"

namespace retarget {
namespace {

struct SegmentSpan {
  Vec3 a, b, middle;
  double half;
};

std::vector<SegmentSpan> SpansOf(const Body& body, const std::vector<Vec3>& node) {
  std::vector<SegmentSpan> spans(node.size());
  for (int n = 1; n < body.num_nodes(); ++n) {
    SegmentSpan& s = spans[n];
    s.a = node[body.nodes[n].parent];
    s.b = node[n];
    s.middle = 0.5 * (s.a + s.b);
    s.half = 0.5 * (s.b - s.a).norm();
  }
  return spans;
}

double DisplacementOf(const std::vector<Vec3>& before, const std::vector<Vec3>& after) {
  double largest2 = 0;
  for (size_t n = 0; n < before.size(); ++n) {
    largest2 = std::max(largest2, (after[n] - before[n]).squaredNorm());
  }
  return std::sqrt(largest2);
}

}  // namespace

GliJump LargestGliJump(const std::array<Body, 2>& body, const NodePositions& before,
                       const NodePositions& after, double reach) {
  const std::vector<SegmentSpan> a0 = SpansOf(body[0], before[0]), b0 = SpansOf(body[1], before[1]);
  const int na = body[0].num_nodes(), nb = body[1].num_nodes();
  MatX change = MatX::Zero(na, nb);
  bool any = false;
  for (int i = 1; i < na; ++i) {
    for (int j = 1; j < nb; ++j) {
      const double limit = a0[i].half + b0[j].half + reach;
      if ((a0[i].middle - b0[j].middle).squaredNorm() > limit * limit) continue;
      if (ClosestPointsOfSegments(a0[i].a, a0[i].b, b0[j].a, b0[j].b).distance > reach) continue;
      change(i, j) = SegmentGli(after[0][body[0].nodes[i].parent], after[0][i],
                                after[1][body[1].nodes[j].parent], after[1][j]) -
                     SegmentGli(a0[i].a, a0[i].b, b0[j].a, b0[j].b);
      any = true;
    }
  }
  GliJump largest;
  if (!any) return largest;
  const auto consider = [&](double jump, int i, int j) {
    if (std::abs(jump) > largest.size) largest = {std::abs(jump), i, j};
  };
  for (int i = 1; i < na; ++i) {
    const int pi = body[0].nodes[i].parent;
    for (int j = 1; j < nb; ++j) {
      const int pj = body[1].nodes[j].parent;
      consider(change(i, j), i, j);
      if (pi > 0) consider(change(i, j) + change(pi, j), i, j);
      if (pj > 0) consider(change(i, j) + change(i, pj), i, j);
    }
  }
  return largest;
}

GliJump LargestGliJumpOnTheWay(const std::array<Body, 2>& body, const NodePositions& before,
                               const NodePositions& after) {
  return LargestGliJump(body, before, after,
                        DisplacementOf(before[0], after[0]) + DisplacementOf(before[1], after[1]));
}

GliJump LargestGliJumpBetween(const std::array<Body, 2>& body, const std::array<Pose, 2>& from,
                              const std::array<Pose, 2>& to) {
  constexpr int kInstants = 4;
  const auto nodes_at = [&](int k) {
    NodePositions nodes;
    for (int f = 0; f < 2; ++f) {
      nodes[f] =
          PoseBody(body[f], Interpolate(from[f], to[f], static_cast<double>(k) / kInstants)).node;
    }
    return nodes;
  };
  GliJump largest;
  NodePositions before = nodes_at(0);
  for (int k = 1; k <= kInstants; ++k) {
    NodePositions after = nodes_at(k);
    const GliJump jump = LargestGliJumpOnTheWay(body, before, after);
    if (jump.size > largest.size) largest = jump;
    before = std::move(after);
  }
  return largest;
}

double LargestDisplacement(const NodePositions& before, const NodePositions& after) {
  return std::max(DisplacementOf(before[0], after[0]), DisplacementOf(before[1], after[1]));
}

}  // namespace retarget
