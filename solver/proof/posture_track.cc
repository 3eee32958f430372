#include "solver/proof/posture_track.h"

#include <algorithm>

namespace retarget::solver {
namespace {

// A figure's frames between two nodes of the file: the one that carries node n of the body.
int CarrierOf(const KeyedMotion& motion, int node) {
  return motion.nodes[node].parent < 0 ? node : motion.nodes[node].parent;
}

}  // namespace

PostureTrack::PostureTrack(const ProofTask& task, int num_pairs)
    : task_(task), num_pairs_(num_pairs) {
  std::vector<int> nodes = task.node[0];
  nodes.insert(nodes.end(), task.node[1].begin(), task.node[1].end());
  order_ = WithAncestors(task.motion, nodes);
}

void PostureTrack::Place(int key, double share, Instant* out) {
  PlaceNodes(task_.motion, order_, key, share, &posture_);
  out->share = share;
  for (int f = 0; f < 2; ++f) {
    out->node[f].resize(task_.node[f].size());
    for (size_t n = 0; n < task_.node[f].size(); ++n) {
      out->node[f][n] = posture_.origin[task_.node[f][n]];
    }
  }
  const auto place_of = [&](const HoldPoint& point) -> Vec3 {
    if (point.figure == kWorld) return point.offset;
    const int n = task_.node[point.figure][point.node];
    return posture_.origin[n] + posture_.linear[CarrierOf(task_.motion, n)] * point.offset;
  };
  out->held.clear();
  for (const Hold& hold : task_.subject.holds) {
    out->held.push_back({place_of(hold.from), place_of(hold.to)});
  }
  out->gli.assign(task_.subject.tangles.size(), std::numeric_limits<double>::quiet_NaN());
  out->gap.resize(num_pairs_);
  out->gap_known.assign(num_pairs_, 0);
}

void PostureTrack::Bound(int key, IntervalBounds* out) {
  const bool last = key + 1 >= task_.motion.num_keys();
  if (!last) BoundMotion(task_.motion, order_, key, &bounds_);
  for (int f = 0; f < 2; ++f) {
    const std::vector<int>& node = task_.node[f];
    out->speed[f].assign(node.size(), 0);
    out->bend[f].assign(node.size(), 0);
    for (size_t n = 0; n < node.size() && !last; ++n) {
      out->speed[f][n] = bounds_.speed[node[n]];
      out->bend[f][n] = bounds_.bend[node[n]];
      // Nodes of one figure that hang from different topmost nodes count their steps themselves.
      if (bounds_.carried[node[n]] != bounds_.carried[node[0]]) {
        out->speed[f][n] += (bounds_.carried[node[n]] - bounds_.carried[node[0]]).norm();
      }
    }
    out->carried[f] = last ? Vec3::Zero() : bounds_.carried[node[0]];
  }
  const auto bounds_of = [&](const HoldPoint& point) {
    MovingPoint bound;
    if (last || point.figure == kWorld) return bound;
    const int n = task_.node[point.figure][point.node];
    const int carrier = CarrierOf(task_.motion, n);
    const double turn = bounds_.turn[carrier];
    const double length = bounds_.stretch[carrier] * point.offset.norm();
    bound.speed = out->speed[point.figure][point.node] + turn * length;
    bound.bend = bounds_.bend[n] + turn * turn * length;
    return bound;
  };
  out->held.clear();
  for (const Hold& hold : task_.subject.holds) {
    out->held.push_back({bounds_of(hold.from), bounds_of(hold.to)});
  }
}

void FollowPoints(const Instant& i0, const Instant& i1, const IntervalBounds& bounds, double length,
                  MovingFigures* out) {
  for (int f = 0; f < 2; ++f) {
    out->node[f].resize(i0.node[f].size());
    for (size_t n = 0; n < i0.node[f].size(); ++n) {
      out->node[f][n] = {i0.node[f][n], i1.node[f][n], bounds.speed[f][n] * length,
                         bounds.bend[f][n] * length * length};
    }
  }
  out->held.resize(i0.held.size());
  for (size_t k = 0; k < i0.held.size(); ++k) {
    for (int end = 0; end < 2; ++end) {
      const MovingPoint& bound = bounds.held[k][end];
      out->held[k][end] = {i0.held[k][end], i1.held[k][end], bound.speed * length,
                           bound.bend * length * length};
    }
  }
  out->carried = bounds.carried_apart() * length;
}

}  // namespace retarget::solver
