#include "solver/proof/proof.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "model/body/path.h"
#include "model/geometry/capsule.h"
#include "model/geometry/polyline.h"
#include "solver/proof/claims.h"
#include "solver/proof/gli_bound.h"
#include "solver/proof/posture_track.h"

namespace retarget::solver {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::infinity();
// Smallest stretches of an interval in which one claim may be undecided before no more is asked.
constexpr int kMostUndecided = 8;

class Prover {
 public:
  explicit Prover(const ProofTask& task)
      : task_(task), claims_(ClaimsOf(task)), track_(task, claims_.num_pairs) {
    for (Statement& s : claims_.statements) s.value = s.bound = kNothing;
    finding_of_.assign(claims_.claims.size(), -1);
    given_up_.assign(claims_.claims.size(), 0);
    // A stretch of every depth down to the smallest, and what is open in it.
    levels_.resize(static_cast<size_t>(std::lround(-std::log2(kSmallestStretch))) + 1);
  }

  Proof Run() {
    const auto begin = std::chrono::steady_clock::now();
    const int keys = task_.motion.num_keys();
    track_.Place(0, 0, &ends_[0]);
    foot_start_ = {std::vector<Vec3>(task_.subject.contacts[0].size()),
                   std::vector<Vec3>(task_.subject.contacts[1].size())};
    // A motion of one key stands still: an interval of no length.
    for (key_ = 0; key_ + 1 < std::max(2, keys); ++key_) {
      const int next = std::min(key_ + 1, keys - 1);
      track_.Place(next, 0, &ends_[1]);
      ends_[0].share = 0;
      ends_[1].share = 1;
      track_.Bound(key_, &bounds_);
      CertifyInterval();
      std::swap(ends_[0], ends_[1]);
    }
    Finish();
    const auto end = std::chrono::steady_clock::now();
    out_.seconds = std::chrono::duration<double>(end - begin).count();
    return std::move(out_);
  }

 private:
  struct Level {
    Instant middle;
    MovingFigures points;
    std::vector<int> open;        // claims
    std::vector<int> open_pairs;  // of them, pairs that may still meet
  };

  double LengthOfInterval() const {
    const std::vector<double>& t = task_.motion.key_times;
    return key_ + 1 < task_.motion.num_keys() ? t[key_ + 1] - t[key_] : 0;
  }
  double TimeAt(double share) const {
    return task_.motion.key_times[key_] + share * LengthOfInterval();
  }

  void CertifyInterval() {
    out_.intervals.emplace_back();
    now_ = &out_.intervals.back();
    now_->evaluations = 0;
    now_->bound.assign(claims_.statements.size(), kNothing);
    for (int f = 0; f < 2; ++f) {
      for (size_t c = 0; c < task_.subject.contacts[f].size(); ++c) {
        const Contact& contact = task_.subject.contacts[f][c];
        if (contact.first == key_) foot_start_[f][c] = ends_[0].node[f][contact.node];
      }
    }
    // Every claim that is about this interval, but for pairs that are far apart all the time.
    open_.clear();
    FindNearPairs();
    for (size_t c = 2 * claims_.num_pairs; c < claims_.claims.size(); ++c) {
      if (IsAboutInterval(claims_.claims[c])) open_.push_back(static_cast<int>(c));
    }
    Certify(ends_[0], ends_[1], open_, 0);
    for (const int c : recorded_) given_up_[c] = 0;
    recorded_.clear();
    met_.clear();
  }

  bool IsAboutInterval(const Claim& claim) const {
    if (claim.type == ClaimType::kFoot) {
      const Contact& contact = task_.subject.contacts[claim.figure][claim.item];
      return contact.first <= key_ && key_ < contact.last;
    }
    // A rigid segment is shown at the first key.
    if (claim.type == ClaimType::kLength) return key_ == 0 || !Rigid(claim);
    return true;
  }
  bool Rigid(const Claim& claim) const { return claims_.rigid[claim.figure][claim.node_1] != 0; }

  // Pairs whose capsules cannot touch, by spheres round the segments; the others are open.
  void FindNearPairs() {
    const std::array<Body, 2>& body = task_.subject.body;
    for (int f = 0; f < 2; ++f) {
      spheres_[f].resize(body[f].nodes.size());
      const std::vector<Vec3>&p0 = ends_[0].node[f], &p1 = ends_[1].node[f];
      const double carried = f == 0 ? bounds_.carried_apart() : 0;
      const auto reach = [&](int n) {  // relative to what carries b
        const double seen = (p1[n] - p0[n] - bounds_.carried[1]).norm() + bounds_.bend[f][n] / 2;
        return std::min(bounds_.speed[f][n] + carried, seen);
      };
      for (int n = 1; n < body[f].num_nodes(); ++n) {
        const int parent = body[f].nodes[n].parent;
        spheres_[f][n] = {0.5 * (p0[n] + p0[parent]), 0.5 * (p0[n] - p0[parent]).norm() +
                                                          body[f].nodes[n].radius + kLengthMargin +
                                                          std::max(reach(n), reach(parent))};
      }
    }
    for (int pair = 0; pair < claims_.num_pairs; ++pair) {
      const Claim& claim = claims_.claims[pair];
      const Sphere &a = spheres_[0][claim.node_1], &b = spheres_[1][claim.node_2];
      const double apart = a.radius + b.radius;
      if ((a.centre - b.centre).squaredNorm() > apart * apart) continue;
      open_.push_back(pair);
      open_.push_back(claims_.num_pairs + pair);
    }
  }

  // Decides what it can of `open` between two instants, and halves for the rest.
  void Certify(Instant& i0, Instant& i1, const std::vector<int>& open, int depth) {
    const double length = i1.share - i0.share;
    Level& level = levels_[depth];
    ++now_->evaluations;
    now_->depth = std::max(now_->depth, depth);
    FollowPoints(i0, i1, bounds_, length, &level.points);
    level.open.clear();
    level.open_pairs.clear();
    const bool smallest = length <= kSmallestStretch;
    double free = 0;  // of the pair of the last kFree claim: pairs come twice, in a row
    int free_pair = -1;
    for (const int c : open) {
      if (given_up_[c] >= kMostUndecided) continue;
      const Claim& claim = claims_.claims[c];
      Judged judged;
      if (claim.type == ClaimType::kFree || claim.type == ClaimType::kDepth) {
        const int pair = c % claims_.num_pairs;
        if (pair != free_pair) free = PairBound(i0, i1, claim, pair, level.points);
        free_pair = pair;
        judged = JudgePair(i0, i1, claim, pair, free);
      } else {
        judged = Judge(i0, i1, claim, level);
      }
      if (Settle(c, claim, i0, i1, judged, smallest)) continue;
      level.open.push_back(c);
      if (claim.type == ClaimType::kFree) level.open_pairs.push_back(c);
    }
    if (level.open.empty()) return;
    const double middle = 0.5 * (i0.share + i1.share);
    track_.Place(key_, middle, &level.middle);
    Certify(i0, level.middle, level.open, depth + 1);
    Certify(level.middle, i1, level.open, depth + 1);
  }

  // Values at both ends and a bound on all between, larger is worse.
  struct Judged {
    double v0 = 0, v1 = 0, bound = 0;
  };

  const Gap& GapAt(Instant& i, const Claim& claim, int pair) {
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

  double PairBound(Instant& i0, Instant& i1, const Claim& claim, int pair,
                   const MovingFigures& points) {
    const std::array<Body, 2>& body = task_.subject.body;
    const MovingSegment p = {&points.node[0][body[0].nodes[claim.node_1].parent],
                             &points.node[0][claim.node_1]};
    const MovingSegment q = {&points.node[1][body[1].nodes[claim.node_2].parent],
                             &points.node[1][claim.node_2]};
    return GapBound(p, q, GapAt(i0, claim, pair), GapAt(i1, claim, pair), points.carried);
  }

  Judged JudgePair(Instant& i0, Instant& i1, const Claim& claim, int pair, double free) {
    const double d0 = GapAt(i0, claim, pair).distance, d1 = GapAt(i1, claim, pair).distance;
    const double radii = claim.type == ClaimType::kFree
                             ? 0
                             : task_.subject.body[0].nodes[claim.node_1].radius +
                                   task_.subject.body[1].nodes[claim.node_2].radius;
    return {radii - d0, radii - d1, radii - free};
  }

  Judged Judge(Instant& i0, Instant& i1, const Claim& claim, Level& level) {
    switch (claim.type) {
      case ClaimType::kTag:
        return JudgeTag(i0, i1, claim, level);
      case ClaimType::kHold: {
        const auto& points = level.points.held[claim.item];
        return {(points[0].at0 - points[1].at0).norm(), (points[0].at1 - points[1].at1).norm(),
                LargestDistance(points[0], points[1])};
      }
      case ClaimType::kFoot: {
        MovingPoint foot = level.points.node[claim.figure][claim.node_1];
        MovingPoint start;
        start.at0 = start.at1 = foot_start_[claim.figure][claim.item];
        for (Vec3* at : {&foot.at0, &foot.at1, &start.at0, &start.at1}) at->y() = 0;
        return {(foot.at0 - start.at0).norm(), (foot.at1 - start.at1).norm(),
                LargestDistance(foot, start)};
      }
      case ClaimType::kFloor: {
        const MovingPoint& node = level.points.node[claim.figure][claim.node_1];
        const double radius = claims_.radius[claim.figure][claim.node_1];
        const double v0 = radius - node.at0.y(), v1 = radius - node.at1.y();
        return {v0, v1, std::max(v0, v1) + node.stray() + kLengthMargin};
      }
      case ClaimType::kLength:
        return JudgeLength(claim, level);
      case ClaimType::kFree:
      case ClaimType::kDepth:
        break;
    }
    return {};
  }

  Judged JudgeTag(Instant& i0, Instant& i1, const Claim& claim, const Level& level) {
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
    if (std::any_of(level.open_pairs.begin(), level.open_pairs.end(), blocks) ||
        std::any_of(met_.begin(), met_.end(), blocks)) {
      return {-g0, -g1, kUnknown};
    }
    const auto points_on = [](const std::vector<MovingPoint>& node, const std::vector<int>& path,
                              std::vector<const MovingPoint*>* out) {
      out->clear();
      for (const int n : path) out->push_back(&node[n]);
    };
    points_on(level.points.node[0], paths.a, &path_[0]);
    points_on(level.points.node[1], paths.b, &path_[1]);
    const GliChange change = BoundGliChange(path_[0], path_[1], level.points.carried);
    return {-g0, -g1, -GliBound(g0, g1, change)};
  }

  Judged JudgeLength(const Claim& claim, const Level& level) const {
    const std::vector<MovingPoint>& node = level.points.node[claim.figure];
    const MovingPoint &p = node[claim.node_1], &q = node[claim.node_2];
    const double should = task_.subject.length[claim.figure][claim.node_1];
    const auto error = [&](double is) { return 100 * std::abs(is / should - 1); };
    const double v0 = error((p.at0 - q.at0).norm()), v1 = error((p.at1 - q.at1).norm());
    if (Rigid(claim)) return {v0, v0, v0 + 100 * kLengthMargin / should};
    return {v0, v1, std::max(error(LargestDistance(p, q)), error(LeastDistance(p, q)))};
  }

  // True where nothing more is to be found out about a claim between two instants.
  bool Settle(int c, const Claim& claim, const Instant& i0, const Instant& i1, const Judged& judged,
              bool smallest) {
    Meet(claim, judged.v0);
    Meet(claim, judged.v1);
    if (judged.bound <= claim.limit) {
      double& bound = now_->bound[claim.statement];
      bound = std::max(bound, judged.bound);
      return true;
    }
    if (judged.v0 > claim.limit) {
      Record(c, claim, true, i0.share, judged.v0);
    } else if (!smallest) {
      return false;
    } else if (judged.v1 > claim.limit) {
      Record(c, claim, true, i1.share, judged.v1);
    } else {
      Record(c, claim, false, i0.share, std::max(judged.v0, judged.v1));
    }
    return true;
  }

  void Meet(const Claim& claim, double value) {
    Statement& s = claims_.statements[claim.statement];
    if (value <= s.value) return;
    s.value = value;
    s.frame = key_;
    worst_[static_cast<size_t>(claim.statement)] = claim;
  }

  // Notes that a claim fails in this interval, and asks no more of it before the next key where it
  // is lost, or undecided again and again.
  void Record(int c, const Claim& claim, bool lost, double share, double value) {
    now_->bound[claim.statement] = kUnknown;
    const bool first_here = given_up_[c] == 0;
    given_up_[c] = lost ? kMostUndecided : given_up_[c] + 1;
    if (first_here) recorded_.push_back(c);
    if (first_here && claim.type == ClaimType::kFree) met_.push_back(c);
    if (finding_of_[c] < 0) {
      finding_of_[c] = static_cast<int>(out_.findings.size());
      Finding finding;
      finding.statement = claim.statement;
      finding.time_s = TimeAt(share);
      finding.frame = key_;
      finding.lost = lost;
      finding.value = finding.worst = value;
      finding.worst_s = finding.time_s;
      finding.limbs = LimbsOf(task_, claim);
      out_.findings.push_back(finding);
    }
    Finding& finding = out_.findings[finding_of_[c]];
    finding.intervals += first_here;
    finding.lost |= lost;
    if (value <= finding.worst) return;
    finding.worst = value;
    finding.worst_s = TimeAt(share);
  }

  void Finish();

  struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
  };

  const ProofTask& task_;
  Claims claims_;
  PostureTrack track_;
  std::array<Instant, 2> ends_;
  IntervalBounds bounds_;
  std::array<std::vector<Sphere>, 2> spheres_;
  std::array<std::vector<Vec3>, 2> foot_start_;
  std::array<std::vector<const MovingPoint*>, 2> path_;
  std::vector<Level> levels_;
  std::vector<int> open_;
  std::vector<int> finding_of_;    // [claims] -1: none
  std::vector<int> given_up_;      // [claims] how often, in this interval
  std::vector<int> recorded_;      // claims that were
  std::vector<int> met_;           // pairs that may meet in this interval
  std::map<size_t, Claim> worst_;  // of each statement
  int key_ = 0;
  IntervalProof* now_ = nullptr;
  Proof out_;
};

void Prover::Finish() {
  // Back to each statement's own sense: s GLI, a count, a depth that is never negative.
  const auto turned = [&](const Statement& s, double value) {
    if (s.kind == RequirementKind::kTangle) return -value;
    return std::max(0.0, value);
  };
  for (size_t k = 0; k < claims_.statements.size(); ++k) {
    Statement& s = claims_.statements[k];
    for (IntervalProof& interval : out_.intervals) {
      s.bound = std::max(s.bound, interval.bound[k]);
      interval.bound[k] = turned(s, interval.bound[k]);
    }
    s.value = turned(s, s.value);
    s.bound = turned(s, s.bound);
    if (const auto worst = worst_.find(k); worst != worst_.end()) {
      s.limbs = LimbsOf(task_, worst->second);
    }
  }
  Statement& passes = claims_.statements[claims_.pass_throughs];
  passes.value = passes.bound = 0;
  passes.frame = -1;
  passes.limbs.clear();
  for (IntervalProof& interval : out_.intervals) {
    double& bound = interval.bound[claims_.pass_throughs];
    bound = std::isinf(bound) ? bound : 0;
    out_.evaluations += interval.evaluations;
    out_.depth = std::max(out_.depth, interval.depth);
  }
  std::stable_sort(out_.findings.begin(), out_.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.time_s < b.time_s; });
  for (Finding& finding : out_.findings) {
    Statement& s = claims_.statements[finding.statement];
    if (s.kind == RequirementKind::kTangle || s.kind == RequirementKind::kPassThroughs) {
      finding.value = -finding.value;
      finding.worst = -finding.worst;
    }
    if (s.kind == RequirementKind::kPassThroughs) {
      s.value += finding.intervals;
      s.bound = s.value;
      if (s.frame < 0) {
        s.frame = finding.frame;
        s.limbs = finding.limbs;
      }
      s.proved = s.value <= s.limit;
    } else {
      s.proved = false;
    }
  }
  out_.statements = std::move(claims_.statements);
}

}  // namespace

Proof Prove(const ProofTask& task) { return Prover(task).Run(); }

}  // namespace retarget::solver
