#include "solver/proof/claims.h"

#include "model/body/path.h"
#include "model/body/shape.h"

namespace retarget::solver {
namespace {

using Kind = RequirementKind;

// A node's place in the frame of its parent where that never changes.
bool IsFixed(const KeyedNode& node) { return node.translation_track < 0; }

// Both frames turn about the same point, wherever they are: the node `q` itself, and node `joint`,
// which stands where q stands in the same frame.
bool TurnsAbout(const KeyedMotion& motion, int joint, int q) {
  if (joint == q) return true;
  const KeyedNode &j = motion.nodes[joint], &n = motion.nodes[q];
  if (!IsFixed(j)) return false;
  if (j.parent == q) return j.translation.isZero(0);
  return IsFixed(n) && n.parent >= 0 && n.parent == j.parent && n.translation == j.translation;
}

// The distance of p from q never changes: p is fixed in a frame that turns about q, or both are
// fixed in one frame.
bool IsRigid(const KeyedMotion& motion, int p, int q) {
  const KeyedNode &n = motion.nodes[p], &other = motion.nodes[q];
  if (!IsFixed(n) || n.parent < 0) return false;
  for (int up = n.parent; up >= 0; up = motion.nodes[up].parent) {
    if (!motion.nodes[up].stretch.isIdentity(0)) return false;
  }
  if (IsFixed(other) && other.parent == n.parent) return true;
  return TurnsAbout(motion, n.parent, q);
}

class ClaimList {
 public:
  explicit ClaimList(const ProofTask& task) : task_(task) {}

  Claims Run() {
    AddTags();
    AddPairs();
    AddHolds();
    for (int f = 0; f < 2; ++f) AddFigure(f);
    return std::move(out_);
  }

 private:
  int AddStatement(Kind kind, double limit, int item = -1, int figure = -1) {
    out_.statements.push_back({.kind = kind, .item = item, .figure = figure, .limit = limit});
    return static_cast<int>(out_.statements.size()) - 1;
  }

  void AddTags() {
    for (size_t k = 0; k < task_.subject.tangles.size(); ++k) {
      AddStatement(Kind::kTangle, task_.limits.gli, static_cast<int>(k));
    }
  }

  void AddPairs() {
    const std::array<Body, 2>& body = task_.subject.body;
    const int na = body[0].num_nodes() - 1, nb = body[1].num_nodes() - 1;
    out_.num_pairs = na * nb;
    out_.segments_b = nb;
    out_.pass_throughs = AddStatement(Kind::kPassThroughs, task_.limits.pass_throughs);
    out_.penetration = AddStatement(Kind::kPenetration, task_.limits.penetration_m);
    for (const ClaimType type : {ClaimType::kFree, ClaimType::kDepth}) {
      for (int pair = 0; pair < na * nb; ++pair) {
        Claim claim;
        claim.type = type;
        claim.statement = type == ClaimType::kFree ? out_.pass_throughs : out_.penetration;
        claim.limit = type == ClaimType::kFree ? 0 : task_.limits.penetration_m;
        claim.node_1 = pair / nb + 1;
        claim.node_2 = pair % nb + 1;
        out_.claims.push_back(claim);
      }
    }
    for (size_t k = 0; k < task_.subject.tangles.size(); ++k) AddTag(static_cast<int>(k));
  }

  void AddTag(int k) {
    const Tangle& t = task_.subject.tangles[k].tag.tangle;
    const std::array<Body, 2>& body = task_.subject.body;
    TagPaths paths{NodesOn(body[0], t.a), NodesOn(body[1], t.b), {}};
    const Eigen::VectorXi a = SignsOf(body[0], t.a), b = SignsOf(body[1], t.b);
    for (int pair = 0; pair < out_.num_pairs; ++pair) {
      paths.pairs.push_back(a[pair / out_.segments_b] != 0 && b[pair % out_.segments_b] != 0);
    }
    out_.tags.push_back(paths);
    Claim claim;
    claim.type = ClaimType::kTag;
    claim.statement = claim.item = k;
    claim.limit = -task_.limits.gli;
    out_.claims.push_back(claim);
  }

  void AddHolds() {
    for (size_t k = 0; k < task_.subject.holds.size(); ++k) {
      Claim claim;
      claim.type = ClaimType::kHold;
      claim.item = static_cast<int>(k);
      claim.limit = task_.limits.hold_m;
      claim.statement = AddStatement(Kind::kHold, claim.limit, claim.item);
      out_.claims.push_back(claim);
    }
  }

  void AddFigure(int f) {
    const Body& body = task_.subject.body[f];
    out_.radius[f] = NodeRadii(body);
    Claim claim;
    claim.figure = f;
    claim.type = ClaimType::kFoot;
    claim.limit = task_.limits.foot_drift_m;
    claim.statement = AddStatement(Kind::kFootDrift, claim.limit, -1, f);
    for (size_t c = 0; c < task_.subject.contacts[f].size(); ++c) {
      claim.item = static_cast<int>(c);
      claim.node_1 = task_.subject.contacts[f][c].node;
      out_.claims.push_back(claim);
    }
    claim.type = ClaimType::kFloor;
    claim.limit = task_.limits.floor_m;
    claim.statement = AddStatement(Kind::kFloor, claim.limit, -1, f);
    for (claim.node_1 = 0; claim.node_1 < body.num_nodes(); ++claim.node_1) {
      out_.claims.push_back(claim);
    }
    claim.type = ClaimType::kLength;
    claim.limit = task_.limits.segment_length_percent;
    claim.statement = AddStatement(Kind::kSegmentLength, claim.limit, -1, f);
    out_.rigid[f].assign(body.nodes.size(), 0);
    for (int n = 1; n < body.num_nodes(); ++n) {
      // The neck-shoulder segment may change: a clavicle turns about the rig's own joint.
      if (body.nodes[n].name.find("shoulder") != std::string::npos) continue;
      if (!(task_.subject.length[f][n] > 0)) continue;
      claim.node_1 = n;
      claim.node_2 = body.nodes[n].parent;
      out_.rigid[f][n] =
          IsRigid(task_.motion, task_.node[f][n], task_.node[f][body.nodes[n].parent]);
      out_.claims.push_back(claim);
    }
  }

  const ProofTask& task_;
  Claims out_;
};

}  // namespace

Claims ClaimsOf(const ProofTask& task) { return ClaimList(task).Run(); }

std::vector<LimbNode> LimbsOf(const ProofTask& task, const Claim& claim) {
  switch (claim.type) {
    case ClaimType::kFree:
    case ClaimType::kDepth:
      return {{0, claim.node_1}, {1, claim.node_2}};
    case ClaimType::kTag: {
      const Tangle& t = task.subject.tangles[claim.item].tag.tangle;
      return {{0, t.a.from}, {0, t.a.to}, {1, t.b.from}, {1, t.b.to}};
    }
    case ClaimType::kHold: {
      std::vector<LimbNode> limbs;
      const Hold& hold = task.subject.holds[claim.item];
      for (const HoldPoint& point : {hold.from, hold.to}) {
        if (point.figure != kWorld) limbs.push_back({point.figure, point.node});
      }
      return limbs;
    }
    case ClaimType::kFoot:
    case ClaimType::kFloor:
    case ClaimType::kLength:
      return {{claim.figure, claim.node_1}};
  }
  return {};
}

}  // namespace retarget::solver
