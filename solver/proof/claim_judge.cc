#include "solver/proof/claim_judge.h"

#include <algorithm>
#include <cmath>

#include "model/body/path.h"
#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"
#include "solver/proof/gap_bound.h"
#include "solver/proof/gli_bound.h"

namespace retarget::solver {

ClaimJudge::ClaimJudge(const ProofTask& task, const Claims& claims) : task_(task), claims_(claims) {
  for (int f = 0; f < 2; ++f) foot_start_[f].resize(task.subject.contacts[f].size());
}

void ClaimJudge::StartContacts(int key, const Instant& instant) {
  for (int f = 0; f < 2; ++f) {
    for (size_t c = 0; c < foot_start_[f].size(); ++c) {
      const Contact& contact = task_.subject.contacts[f][c];
      if (contact.first == key) foot_start_[f][c] = instant.node[f][contact.node];
    }
  }
}

const Gap& ClaimJudge::GapAt(Instant& i, const Claim& claim, int pair) {
  if (!i.gap_known[pair]) {
    const std::array<Body, 2>& body = task_.subject.body;
    const std::vector<Vec3>&p = i.node[0], &q = i.node[1];
    const ClosestPoints closest =
        ClosestPointsOfSegments(p[body[0].nodes[claim.node_1].parent], p[claim.node_1],
                                q[body[1].nodes[claim.node_2].parent], q[claim.node_2]);
    i.gap[pair] = {closest.distance, closest.normal};
    i.gap_known[pair] = 1;
  }
  return i.gap[pair];
}

double ClaimJudge::PairBound(Instant& i0, Instant& i1, const Claim& claim, int pair,
                             const MovingFigures& points) {
  const std::array<Body, 2>& body = task_.subject.body;
  const MovingSegment p = {&points.node[0][body[0].nodes[claim.node_1].parent],
                           &points.node[0][claim.node_1]};
  const MovingSegment q = {&points.node[1][body[1].nodes[claim.node_2].parent],
                           &points.node[1][claim.node_2]};
  return GapBound(p, q, GapAt(i0, claim, pair), GapAt(i1, claim, pair), points.carried);
}

Judgement ClaimJudge::OfPair(Instant& i0, Instant& i1, const Claim& claim, int pair, double free) {
  const double d0 = GapAt(i0, claim, pair).distance, d1 = GapAt(i1, claim, pair).distance;
  const double radii = claim.type == ClaimType::kFree
                           ? 0
                           : task_.subject.body[0].nodes[claim.node_1].radius +
                                 task_.subject.body[1].nodes[claim.node_2].radius;
  return {radii - d0, radii - d1, radii - free};
}

Judgement ClaimJudge::Of(Instant& i0, Instant& i1, const Claim& claim, const MovingFigures& points,
                         const PairLists& may_meet) {
  switch (claim.type) {
    case ClaimType::kTag:
      return OfTag(i0, i1, claim, points, may_meet);
    case ClaimType::kHold: {
      const auto& held = points.held[claim.item];
      return {(held[0].at0 - held[1].at0).norm(), (held[0].at1 - held[1].at1).norm(),
              LargestDistance(held[0], held[1])};
    }
    case ClaimType::kFoot: {
      MovingPoint foot = points.node[claim.figure][claim.node_1];
      MovingPoint start;
      start.at0 = start.at1 = foot_start_[claim.figure][claim.item];
      for (Vec3* at : {&foot.at0, &foot.at1, &start.at0, &start.at1}) at->y() = 0;
      return {(foot.at0 - start.at0).norm(), (foot.at1 - start.at1).norm(),
              LargestDistance(foot, start)};
    }
    case ClaimType::kFloor: {
      const MovingPoint& node = points.node[claim.figure][claim.node_1];
      const double radius = claims_.radius[claim.figure][claim.node_1];
      const double v0 = radius - node.at0.y(), v1 = radius - node.at1.y();
      return {v0, v1, std::max(v0, v1) + node.stray() + kLengthMargin};
    }
    case ClaimType::kLength:
      return OfLength(claim, points);
    case ClaimType::kFree:
    case ClaimType::kDepth:
      break;
  }
  return {};
}

Judgement ClaimJudge::OfTag(Instant& i0, Instant& i1, const Claim& claim,
                            const MovingFigures& points, const PairLists& may_meet) {
  const TagPaths& paths = claims_.tags[claim.item];
  const auto gli_at = [&](Instant& i) {
    if (std::isnan(i.gli[claim.item])) {
      i.gli[claim.item] = task_.subject.tangles[claim.item].sign *
                          PolylineGli(PointsOn(i.node[0], paths.a), PointsOn(i.node[1], paths.b));
    }
    return i.gli[claim.item];
  };
  const double g0 = gli_at(i0), g1 = gli_at(i1);
  // The lemma holds where no pair of the two paths' segments meets.
  const auto blocks = [&](int pair) { return paths.pairs[pair] != 0; };
  for (const std::vector<int>* pairs : may_meet) {
    if (std::any_of(pairs->begin(), pairs->end(), blocks)) return {-g0, -g1, kUndecided};
  }
  const auto points_on = [](const std::vector<MovingPoint>& node, const std::vector<int>& path,
                            std::vector<const MovingPoint*>* out) {
    out->clear();
    for (const int n : path) out->push_back(&node[n]);
  };
  points_on(points.node[0], paths.a, &path_[0]);
  points_on(points.node[1], paths.b, &path_[1]);
  const GliChange change = BoundGliChange(path_[0], path_[1], points.carried);
  return {-g0, -g1, -GliBound(g0, g1, change)};
}

Judgement ClaimJudge::OfLength(const Claim& claim, const MovingFigures& points) const {
  const std::vector<MovingPoint>& node = points.node[claim.figure];
  const MovingPoint &p = node[claim.node_1], &q = node[claim.node_2];
  const double should = task_.subject.length[claim.figure][claim.node_1];
  const auto error = [&](double is) { return 100 * std::abs(is / should - 1); };
  const double v0 = error((p.at0 - q.at0).norm()), v1 = error((p.at1 - q.at1).norm());
  if (Rigid(claim)) return {v0, v0, v0 + 100 * kLengthMargin / should};
  return {v0, v1, std::max(error(LargestDistance(p, q)), error(LeastDistance(p, q)))};
}

}  // namespace retarget::solver
