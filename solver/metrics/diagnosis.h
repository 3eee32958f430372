// Why a requirement is missed: in which frame, by which limbs, which parts of the objective pull
// against each other there, and which setting would change it. Sentences: tools/report.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "solver/metrics/requirements.h"

namespace retarget::solver {

// Frames before and after the worst that are looked at too: hinges come and go.
inline constexpr int kConflictReach = 2;
// Cosines above this are no opposition.
inline constexpr double kOpposes = -0.3;
// Share of a pull that counts where none is large.
inline constexpr double kCountingShare = 0.05;
// Share of a pull that nothing takes, above which the solve has not settled.
inline constexpr double kUnsettled = 0.5;

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
  bool settled() const { return std::abs(unopposed) < kUnsettled; }
};

Opposition OppositionTo(const Problem& problem, const Unknowns& unknowns,
                        const RequirementCheck& check);

// Why no solve with these settings meets the requirement.
enum class Cause {
  kPassThrough,     // no term sees limbs that change sides
  kNoTerm,          // no term works for it
  kUnlike,          // the clip is too unlike what the template asks for
  kLowTarget,       // the tag does not aim so high: tangle.margin
  kLooseTemplate,   // the template itself shows no more
  kNoWeight,        // the weight of its term is 0
  kBetweenFrames,   // the frames themselves miss nothing
  kFeetInOnePlace,  // the clips plant both feet in one place
  kHoldOutOfReach,  // the planted feet are too far apart for the hold
  kSameTerm,        // another part of its own term opposes it: no weight settles that
  kFlatTangle,      // the tag's gradient has vanished
  kLowWeight,       // the weight of its term is far below the default
  kNotSettled,      // the pulls are not in balance
  kOpposed,         // another term opposes it
  kUnopposed        // no one term does
};

// A contact with whose foot it is.
struct PlantedFoot {
  int figure = 0;
  Contact contact;
};
// Of an anchor (column of Unknowns::anchor).
PlantedFoot FootOfAnchor(const Scene& scene, int anchor);

// A setting, and a value that would help.
struct Suggestion {
  std::string setting;  // YAML key, such as weights.hold
  double value = 0;
  double now = 0;           // what it is
  bool is_default = false;  // `value` is, and `now` is far from it
};

// Two points that a hold is to bring together.
struct Reach {
  std::array<std::optional<PlantedFoot>, 2> ground;  // where each end is tied down: a planted foot,
                                                     // or (nothing) its place in the world
  double apart_m = 0;                                // these two
  double reach_m = 0;                                // of the bodies between them, stretched
};

struct Diagnosis {
  RequirementCheck check;  // that is missed
  Cause cause = Cause::kUnopposed;
  Opposition opposition;
  std::optional<PlantedFoot> opposing_foot;  // where Opposition::item is an anchor
  std::optional<Suggestion> suggestion;
  std::vector<PlantedFoot> feet;  // kFeetInOnePlace: both
  Reach reach;                    // kHoldOutOfReach
  double gli_slope = 0;           // kFlatTangle: turns per rad or m
  int pass_throughs = 0;          // kPassThrough: how many there are

  // The requirement's and what opposes it most; fewer: none does.
  std::vector<std::string> terms() const;
};

// One diagnosis per missed requirement, in the order of the checks.
std::vector<Diagnosis> Diagnose(const Problem& problem, const Unknowns& unknowns,
                                const MetricsContext& subject, const Metrics& metrics,
                                const std::vector<RequirementCheck>& checks);

}  // namespace retarget::solver
