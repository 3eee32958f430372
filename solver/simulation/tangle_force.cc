#include "solver/simulation/tangle_force.h"

#include <algorithm>

#include "model/body/path.h"
#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"

namespace retarget::solver {
namespace {

constexpr double kLeastShare = 0.1;

}  // namespace

TangleForce::TangleForce(const Scene& scene, const SimulationSettings& settings)
    : scene_(&scene), settings_(settings) {
  const std::array<PosedBody, 2> posed = {PoseBody(scene.body[0], scene.posture.pose[0]),
                                          PoseBody(scene.body[1], scene.posture.pose[1])};
  const MatX gli = SegmentGliTable(scene.body[0], posed[0].node, scene.body[1], posed[1].node);
  MatX share = MatX::Zero(gli.rows(), gli.cols());  // two tags with one crossing pull once
  for (const TangleTarget& held : scene.tangles) {
    const Eigen::VectorXi p = SignsOf(scene.body[0], held.tag.tangle.a);
    const Eigen::VectorXi q = SignsOf(scene.body[1], held.tag.tangle.b);
    MatX crossing = MatX::Zero(gli.rows(), gli.cols());
    for (long i = 0; i < gli.rows(); ++i) {
      for (long j = 0; j < gli.cols(); ++j) {
        crossing(i, j) = std::max(0.0, held.sign * p[i] * q[j] * gli(i, j));
      }
    }
    share = share.cwiseMax(crossing / std::max(crossing.maxCoeff(), 1e-12));
  }
  for (long i = 0; i < share.rows(); ++i) {
    for (long j = 0; j < share.cols(); ++j) {
      if (share(i, j) < kLeastShare) continue;
      // Row and column k belong to the segment that ends at node k + 1.
      pulls_.push_back({static_cast<int>(i) + 1, static_cast<int>(j) + 1, share(i, j)});
    }
  }
}

void TangleForce::Apply(const std::array<PosedBody, 2>& posed, PhysicsWorld* world) const {
  if (settings_.tangle_force == TangleForceKind::kGli) {
    ApplyGli(posed, world);
  } else {
    ApplyElastic(posed, world);
  }
}

void TangleForce::ApplyElastic(const std::array<PosedBody, 2>& posed, PhysicsWorld* world) const {
  const Body &a = scene_->body[0], &b = scene_->body[1];
  for (const Pull& pull : pulls_) {
    const Node &m = a.nodes[pull.node_a], &n = b.nodes[pull.node_b];
    const Vec3 &a0 = posed[0].node[m.parent], &a1 = posed[0].node[pull.node_a];
    const Vec3 &b0 = posed[1].node[n.parent], &b1 = posed[1].node[pull.node_b];
    const ClosestPoints closest = ClosestPointsOfSegments(a0, a1, b0, b1);
    const double stretch = closest.distance - m.radius - n.radius - settings_.tangle_slack_m;
    if (stretch <= 0) continue;
    const Vec3 force = pull.share *
                       std::min(settings_.tangle_stiffness * stretch, settings_.tangle_max_force) *
                       closest.normal;  // from b's point to a's
    world->AddForce(0, m.link, a0 + closest.s * (a1 - a0), -force);
    world->AddForce(1, n.link, b0 + closest.t * (b1 - b0), force);
  }
}

void TangleForce::ApplyGli(const std::array<PosedBody, 2>& posed, PhysicsWorld* world) const {
  for (const TangleTarget& held : scene_->tangles) {
    const std::vector<int> nodes_a = NodesOn(scene_->body[0], held.tag.tangle.a);
    const std::vector<int> nodes_b = NodesOn(scene_->body[1], held.tag.tangle.b);
    const PathGli gli =
        PolylineGliWithGradient(PointsOn(posed[0].node, nodes_a), PointsOn(posed[1].node, nodes_b));
    const double lack = held.target - held.sign * gli.value;
    if (lack <= 0) continue;
    const double gain = settings_.tangle_gli_stiffness * lack * held.sign;
    for (size_t k = 0; k < nodes_a.size(); ++k) {
      world->AddForce(0, scene_->body[0].nodes[nodes_a[k]].link, posed[0].node[nodes_a[k]],
                      gain * gli.gradient_p[k]);
    }
    for (size_t k = 0; k < nodes_b.size(); ++k) {
      world->AddForce(1, scene_->body[1].nodes[nodes_b[k]].link, posed[1].node[nodes_b[k]],
                      gain * gli.gradient_q[k]);
    }
  }
}

}  // namespace retarget::solver
