// Where a requirement is missed: in which frame, by which limbs, and which parts of the objective
// pull against each other there.
#pragma once

#include <string>
#include <vector>

#include "solver/metrics/requirements.h"

namespace retarget::solver {

// Frames before and after the worst that are looked at too: hinges come and go.
inline constexpr int kConflictReach = 2;
// Cosines above this are no opposition.
inline constexpr double kOpposes = -0.3;

// What opposes a requirement's own pull, in the frames about the worst miss, over the coordinates
// that move the limbs in question.
struct Opposition {
  struct Share {
    std::string term;
    double share = 0;   // of the pull; all add up to one where the solve has settled
    double cosine = 0;  // of the two gradients
  };
  std::vector<Share> shares;  // largest first; the requirement's own term without the part itself
  int item = -1;              // the hold, tag or anchor that takes most of the largest share
  double unopposed = 1;       // share that nothing takes
  double pull = 0;            // norm of the requirement's own gradient

  // Something pulls against it.
  bool opposed() const { return !shares.empty() && shares[0].cosine < kOpposes; }
};

Opposition OppositionTo(const Problem& problem, const Unknowns& unknowns,
                        const RequirementCheck& check);

struct Conflict {
  std::string requirement;         // RequirementCheck::name
  int frame = -1;                  // of the worst miss; -1: none
  std::vector<std::string> limbs;  // "a left_hand"
  std::vector<std::string> terms;  // the requirement's and what opposes it most; fewer: none does
  double cosine = 0;               // of these two; 0 where there are not two
  std::string sentence;            // what, where, why, and what to do
};

// One conflict per missed requirement, in the order of the checks.
std::vector<Conflict> FindConflicts(const Problem& problem, const Unknowns& unknowns,
                                    const MeasureSubject& subject, const Metrics& metrics,
                                    const std::vector<RequirementCheck>& checks);

}  // namespace retarget::solver
