#include "solver/proof/proof.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "solver/proof/claim_judge.h"
#include "solver/proof/claims.h"
#include "solver/proof/posture_track.h"

namespace retarget::solver {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
// Smallest stretches of an interval in which one claim may be undecided before no more is asked.
constexpr int kMostUndecided = 8;

class Prover {
 public:
  explicit Prover(const ProofTask& task)
      : task_(task),
        claims_(ClaimsOf(task)),
        judge_(task, claims_),
        track_(task, claims_.num_pairs) {
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

  double TimeAt(double share) const {
    const std::vector<double>& t = task_.motion.key_times;
    const double length = key_ + 1 < task_.motion.num_keys() ? t[key_ + 1] - t[key_] : 0;
    return t[key_] + share * length;
  }

  void CertifyInterval() {
    out_.intervals.emplace_back();
    now_ = &out_.intervals.back();
    now_->evaluations = 0;
    now_->bound.assign(claims_.statements.size(), kNothing);
    judge_.StartContacts(key_, ends_[0]);
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
    if (claim.type == ClaimType::kLength) return key_ == 0 || !judge_.Rigid(claim);
    return true;
  }

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
      Judgement judged;
      if (claim.type == ClaimType::kFree || claim.type == ClaimType::kDepth) {
        const int pair = c % claims_.num_pairs;
        if (pair != free_pair) free = judge_.PairBound(i0, i1, claim, pair, level.points);
        free_pair = pair;
        judged = judge_.OfPair(i0, i1, claim, pair, free);
      } else {
        judged = judge_.Of(i0, i1, claim, level.points, {&level.open_pairs, &met_});
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

  // True where nothing more is to be found out about a claim between two instants.
  bool Settle(int c, const Claim& claim, const Instant& i0, const Instant& i1,
              const Judgement& judged, bool smallest) {
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
    now_->bound[claim.statement] = kUndecided;
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
  ClaimJudge judge_;
  PostureTrack track_;
  std::array<Instant, 2> ends_;
  IntervalBounds bounds_;
  std::array<std::vector<Sphere>, 2> spheres_;
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
    // A statement about nothing, such as planted feet where none is planted.
    const bool none = s.value == kNothing && s.kind != RequirementKind::kPassThroughs;
    s.value = none ? kNothingMeasured : turned(s, s.value);
    s.bound = none ? kNothingMeasured : turned(s, s.bound);
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
