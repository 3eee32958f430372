#include "solver/metrics/frame_metrics.h"

#include <algorithm>
#include <cmath>

#include "model/body/joint_limit.h"
#include "model/body/path.h"
#include "model/body/shape.h"
#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"
#include "model/geometry/so3.h"
#include "solver/problem/parallel.h"

namespace retarget::solver {
namespace {

constexpr int kSubSamples = 4;  // instants per frame interval (docs/metrics.md)

double DepthOf(const Body& body_1, const std::vector<Vec3>& p, int i, const Body& body_2,
               const std::vector<Vec3>& q, int j) {
  const double reach = body_1.nodes[i].radius + body_2.nodes[j].radius;
  const Vec3 &a = p[body_1.nodes[i].parent], &b = p[i], &c = q[body_2.nodes[j].parent], &d = q[j];
  const double bound = 0.5 * ((b - a).norm() + (d - c).norm()) + reach;
  if ((0.5 * (a + b - c - d)).squaredNorm() > bound * bound) return -1;
  return CapsuleDepth(ClosestPointsOfSegments(a, b, c, d), body_1.nodes[i].radius,
                      body_2.nodes[j].radius);
}

Overlap DeepestBetween(const std::array<Body, 2>& body, const NodePositions& node) {
  Overlap deepest;
  for (int i = 1; i < body[0].num_nodes(); ++i) {
    for (int j = 1; j < body[1].num_nodes(); ++j) {
      const double depth = DepthOf(body[0], node[0], i, body[1], node[1], j);
      if (depth > deepest.depth_m) deepest = {depth, i, j};
    }
  }
  return deepest;
}

Overlap DeepestWithin(const Body& body, const std::vector<std::pair<int, int>>& pairs,
                      const std::vector<Vec3>& node) {
  Overlap deepest;
  for (const auto& [i, j] : pairs) {
    const double depth = DepthOf(body, node, i, body, node, j);
    if (depth > deepest.depth_m) deepest = {depth, i, j};
  }
  return deepest;
}

// Measures single instants; what depends on the subject alone is worked out once.
class InstantMeter {
 public:
  explicit InstantMeter(const MetricsContext& subject) : subject_(subject) {
    for (const TangleTarget& held : subject.tangles) {
      paths_.push_back({NodesOn(subject.body[0], held.tag.tangle.a),
                        NodesOn(subject.body[1], held.tag.tangle.b)});
    }
    for (int f = 0; f < 2; ++f) {
      self_pairs_[f] = SelfPairs(subject.body[f]);
      radius_[f] = NodeRadii(subject.body[f]);
    }
  }

  InstantMetrics Measure(const PostureSample& now, bool on_frame) const {
    InstantMetrics out;
    for (size_t k = 0; k < paths_.size(); ++k) {
      out.gli.push_back(
          subject_.tangles[k].sign *
          PolylineGli(PointsOn(now.node[0], paths_[k][0]), PointsOn(now.node[1], paths_[k][1])));
    }
    out.penetration = DeepestBetween(subject_.body, now.node);
    for (const Hold& hold : subject_.holds) {
      out.hold_m.push_back((HeldPoint(now, hold.from) - HeldPoint(now, hold.to)).norm());
    }
    for (int f = 0; f < 2; ++f) {
      MeasureFigure(now.node[f], f, &out.figure[f]);
      if (!on_frame) continue;
      out.figure[f].self_penetration = DeepestWithin(subject_.body[f], self_pairs_[f], now.node[f]);
    }
    return out;
  }

 private:
  static Vec3 HeldPoint(const PostureSample& now, const HoldPoint& p) {
    if (p.figure == kWorld) return p.offset;
    return now.node[p.figure][p.node] + now.rotation[p.figure][p.node] * p.offset;
  }

  void MeasureFigure(const std::vector<Vec3>& node, int f, FigureValues* out) const {
    const Body& body = subject_.body[f];
    for (int n = 0; n < body.num_nodes(); ++n) {
      const double depth = radius_[f][n] - node[n].y();
      if (depth <= out->floor_m) continue;
      out->floor_m = depth;
      out->floor_node = n;
    }
    for (int n = 1; n < body.num_nodes(); ++n) {
      if (body.nodes[n].name.find("shoulder") != std::string::npos) continue;
      const double is = (node[n] - node[body.nodes[n].parent]).norm();
      out->length_error_percent =
          std::max(out->length_error_percent, 100 * std::abs(is / subject_.length[f][n] - 1));
    }
  }

  const MetricsContext& subject_;
  std::vector<std::array<std::vector<int>, 2>> paths_;
  std::array<std::vector<std::pair<int, int>>, 2> self_pairs_;
  std::array<std::vector<double>, 2> radius_;
};

void KeepWorst(const InstantMetrics& other, InstantMetrics* worst) {
  for (size_t k = 0; k < other.gli.size(); ++k) {
    worst->gli[k] = std::min(worst->gli[k], other.gli[k]);
  }
  for (size_t k = 0; k < other.hold_m.size(); ++k) {
    worst->hold_m[k] = std::max(worst->hold_m[k], other.hold_m[k]);
  }
  if (other.penetration.depth_m > worst->penetration.depth_m) {
    worst->penetration = other.penetration;
  }
  for (int f = 0; f < 2; ++f) {
    FigureValues& w = worst->figure[f];
    const FigureValues& o = other.figure[f];
    w.length_error_percent = std::max(w.length_error_percent, o.length_error_percent);
    if (o.floor_m <= w.floor_m) continue;
    w.floor_m = o.floor_m;
    w.floor_node = o.floor_node;
  }
}

// Turn of the joint at node n, by the rotations of the links that carry the nodes (deg).
double JointTurn(const Body& body, const std::vector<Quat>& p, const std::vector<Quat>& q, int n) {
  const int parent = body.nodes[n].parent;
  const Quat local_p = p[parent].conjugate() * p[n];
  const Quat local_q = q[parent].conjugate() * q[n];
  return LogSo3(local_q.conjugate() * local_p).norm() / kDegree;
}

// Rotations of the body's links in their parents, by those of the links that carry the nodes.
Pose PoseOf(const Body& body, const std::vector<int>& node_of_link, const std::vector<Quat>& r) {
  Pose pose;
  pose.rotation.assign(body.links.size(), Quat::Identity());
  for (int l = 1; l < body.num_links(); ++l) {
    const int n = node_of_link[l], parent = node_of_link[body.links[l].parent];
    if (n >= 0 && parent >= 0) pose.rotation[l] = r[parent].conjugate() * r[n];
  }
  return pose;
}

BeyondLimit WorstJoint(const Body& body, const std::vector<int>& node_of_link, const Pose& now,
                       const Pose& source) {
  BeyondLimit worst;
  for (int l = 1; l < body.num_links(); ++l) {
    if (node_of_link[l] < 0) continue;
    const std::vector<LimitExcess> is = LimitExcesses(body, l, now);
    const std::vector<LimitExcess> was = LimitExcesses(body, l, source);
    for (size_t k = 0; k < is.size(); ++k) {
      const double deg = (is[k].beyond - std::max(0.0, was[k].beyond)) / kDegree;
      if (deg > worst.deg) worst = {deg, node_of_link[l]};
    }
  }
  return worst;
}

// A node that each link carries; -1 where there is none.
std::vector<int> NodesOfLinks(const Body& body) {
  std::vector<int> nodes(body.links.size(), -1);
  for (int n = body.num_nodes() - 1; n >= 0; --n) nodes[body.nodes[n].link] = n;
  return nodes;
}

}  // namespace

std::vector<int> TrackedJoints(const Body& body) {
  std::vector<int> joints;
  for (int n = 1; n < body.num_nodes(); ++n) {
    if (body.nodes[n].link != body.nodes[body.nodes[n].parent].link) joints.push_back(n);
  }
  return joints;
}

double PlantedSpeed(const FrameMetrics& series, int figure, const Contact& contact, int t) {
  return series.fps *
         (series.node[t][figure][contact.node] - series.node[t - 1][figure][contact.node]).norm();
}

FrameMetrics MeasureFrames(const MetricsContext& subject, const MotionView& motion,
                           const MotionView& source) {
  const InstantMeter meter(subject);
  const int frames = motion.num_frames;
  const size_t n = static_cast<size_t>(frames);
  FrameMetrics out;
  out.fps = motion.fps;
  out.at.resize(n);
  out.between.resize(n > 0 ? n - 1 : 0);
  out.node.resize(n);
  std::array<std::vector<int>, 2> joints, of_links;
  for (int f = 0; f < 2; ++f) {
    joints[f] = TrackedJoints(subject.body[f]);
    of_links[f] = NodesOfLinks(subject.body[f]);
    out.beyond_limit[f].assign(n, {});
    out.tracking_deg[f].assign(joints[f].size(), std::vector<double>(n, 0));
    out.foot_speed[f].assign(n, 0);
  }
  std::vector<std::vector<PassThrough>> passes(n);
  ParallelFor(frames, NumThreads(0), [&](int t, int) {
    PostureSample now, other;
    motion.at(t, &now);
    out.at[t] = meter.Measure(now, true);
    out.node[t] = now.node;
    if (t < source.num_frames) source.at(t, &other);
    for (int f = 0; f < 2 && t < source.num_frames; ++f) {
      const Body& body = subject.body[f];
      out.beyond_limit[f][t] =
          WorstJoint(body, of_links[f], PoseOf(body, of_links[f], now.rotation[f]),
                     PoseOf(body, of_links[f], other.rotation[f]));
      for (size_t j = 0; j < joints[f].size(); ++j) {
        out.tracking_deg[f][j][t] =
            JointTurn(subject.body[f], now.rotation[f], other.rotation[f], joints[f][j]);
      }
    }
    for (int k = 1; k <= kSubSamples && t + 1 < frames; ++k) {
      motion.at(t + static_cast<double>(k) / kSubSamples, &other);
      if (k == 1) out.between[t] = meter.Measure(other, false);
      if (k > 1 && k < kSubSamples) KeepWorst(meter.Measure(other, false), &out.between[t]);
      const GliJump jump = LargestGliJump(subject.body, now.node, other.node, kMotionReach);
      if (jump.size > kPassThroughGli) passes[t].push_back({t, jump.node_a, jump.node_b});
      std::swap(now, other);
    }
  });
  for (const auto& p : passes) {
    out.pass_throughs.insert(out.pass_throughs.end(), p.begin(), p.end());
  }
  for (int f = 0; f < 2; ++f) {
    for (const Contact& c : subject.contacts[f]) {
      for (int t = c.first + 1; t <= c.last; ++t) {
        out.foot_speed[f][t] = std::max(out.foot_speed[f][t], PlantedSpeed(out, f, c, t));
      }
    }
  }
  return out;
}

}  // namespace retarget::solver
