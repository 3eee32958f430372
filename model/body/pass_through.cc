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

// Depths of the capsules of one body in those of the other, 0 where they are apart. [nodes x nodes]
MatX Depths(const std::array<Body, 2>& body, const NodePositions& node) {
  const std::vector<SegmentSpan> a = SpansOf(body[0], node[0]), b = SpansOf(body[1], node[1]);
  MatX depths = MatX::Zero(body[0].num_nodes(), body[1].num_nodes());
  for (int i = 1; i < body[0].num_nodes(); ++i) {
    for (int j = 1; j < body[1].num_nodes(); ++j) {
      const double radii = body[0].nodes[i].radius + body[1].nodes[j].radius;
      const double limit = a[i].half + b[j].half + radii;
      if ((a[i].middle - b[j].middle).squaredNorm() > limit * limit) continue;
      const double apart = ClosestPointsOfSegments(a[i].a, a[i].b, b[j].a, b[j].b).distance;
      depths(i, j) = std::max(0.0, radii - apart);
    }
  }
  return depths;
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

bool MayMeetOnTheWay(const std::array<Body, 2>& body, const NodePositions& before,
                     const NodePositions& after) {
  // The way is curved: nodes move a little further than from place to place.
  constexpr double kCurved = 1.2;
  for (int i = 1; i < body[0].num_nodes(); ++i) {
    const int pi = body[0].nodes[i].parent;
    const Vec3 &a = before[0][pi], &b = before[0][i];
    const Vec3 da = after[0][pi] - a, db = after[0][i] - b;
    for (int j = 1; j < body[1].num_nodes(); ++j) {
      const int pj = body[1].nodes[j].parent;
      const Vec3 &c = before[1][pj], &d = before[1][j];
      const Vec3 dc = after[1][pj] - c, dd = after[1][j] - d;
      // What two points of the segments move against each other is a mean of these four.
      const double move2 = std::max(std::max((da - dc).squaredNorm(), (da - dd).squaredNorm()),
                                    std::max((db - dc).squaredNorm(), (db - dd).squaredNorm()));
      // In and out again.
      if (move2 < 4 * kLargestDip * kLargestDip) continue;
      const double radii = body[0].nodes[i].radius + body[1].nodes[j].radius;
      const double reach = kCurved * std::sqrt(move2) + radii;
      const double bound = reach + 0.5 * ((b - a).norm() + (d - c).norm());
      if ((0.5 * (a + b - c - d)).squaredNorm() > bound * bound) continue;
      if (ClosestPointsOfSegments(a, b, c, d).distance < reach) return true;
    }
  }
  return false;
}

bool Way::IsClear() const { return jump.size <= kPassThroughGli && dip_m <= kLargestDip; }

Way WayBetween(const std::array<Body, 2>& body, const std::array<Pose, 2>& from,
               const std::array<Pose, 2>& to) {
  constexpr int kInstants = 4;
  Way way;
  MatX ends = MatX::Zero(body[0].num_nodes(), body[1].num_nodes());
  MatX inside = ends;
  NodePositions last;
  for (int k = 0; k <= kInstants; ++k) {
    NodePositions now;
    for (int f = 0; f < 2; ++f) {
      now[f] =
          PoseBody(body[f], Interpolate(from[f], to[f], static_cast<double>(k) / kInstants)).node;
    }
    const bool end = k == 0 || k == kInstants;
    MatX& deepest = end ? ends : inside;
    deepest = deepest.cwiseMax(Depths(body, now));
    if (k > 0) {
      const double reach = DisplacementOf(last[0], now[0]) + DisplacementOf(last[1], now[1]);
      const GliJump jump = LargestGliJump(body, last, now, reach);
      if (jump.size > way.jump.size) way.jump = jump;
    }
    last = std::move(now);
  }
  way.dip_m = std::max(0.0, (inside - ends).maxCoeff());
  return way;
}

double LargestDisplacement(const NodePositions& before, const NodePositions& after) {
  return std::max(DisplacementOf(before[0], after[0]), DisplacementOf(before[1], after[1]));
}

}  // namespace retarget
