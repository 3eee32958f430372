// What one claim shows over a stretch of time: its value at both ends and a bound on all between.
// Inner part of solver/proof/proof.h.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "solver/proof/claims.h"
#include "solver/proof/posture_track.h"

namespace retarget::solver {

// The bound of what no bound can be given for.
inline constexpr double kUndecided = std::numeric_limits<double>::infinity();

// Larger is worse (ClaimType).
struct Judgement {
  double v0 = 0, v1 = 0, bound = 0;
};

class ClaimJudge {
 public:
  // Pairs of segments that may meet: a tag of theirs has no bound then.
  using PairLists = std::array<const std::vector<int>*, 2>;

  // Task and claims must outlive it.
  ClaimJudge(const ProofTask& task, const Claims& claims);

  // The feet whose contacts begin with `key`, whose posture `instant` is, stand here.
  void StartContacts(int key, const Instant& instant);

  // A distance (m) that a pair's segments keep over the stretch. Gaps and GLI that it asks for are
  // kept in the instants.
  double PairBound(Instant& i0, Instant& i1, const Claim& claim, int pair,
                   const MovingFigures& points);
  // Of a kFree or kDepth claim; `free` is PairBound.
  Judgement OfPair(Instant& i0, Instant& i1, const Claim& claim, int pair, double free);
  // Of the other types.
  Judgement Of(Instant& i0, Instant& i1, const Claim& claim, const MovingFigures& points,
               const PairLists& may_meet);

  // Whether a kLength claim is of a segment whose length cannot change.
  bool Rigid(const Claim& claim) const { return claims_.rigid[claim.figure][claim.node_1] != 0; }

 private:
  const Gap& GapAt(Instant& i, const Claim& claim, int pair);
  Judgement OfTag(Instant& i0, Instant& i1, const Claim& claim, const MovingFigures& points,
                  const PairLists& may_meet);
  Judgement OfLength(const Claim& claim, const MovingFigures& points) const;

  const ProofTask& task_;
  const Claims& claims_;
  std::array<std::vector<Vec3>, 2> foot_start_;          // [contacts]
  std::array<std::vector<const MovingPoint*>, 2> path_;  // scratch
};

}  // namespace retarget::solver
