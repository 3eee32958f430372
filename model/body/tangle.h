// Tangles: pairs of paths that are wound about each other (Ho and Komura 2007, Algorithm 1), and
// the small set of them that is worth holding on to.
#pragma once

#include <string>
#include <vector>

#include "model/body/body.h"
#include "model/body/path.h"
#include "model/body/pose.h"

namespace retarget {

inline constexpr double kTangleThreshold = 0.5;  // turns; section 4.2
inline constexpr double kTangleTie = 1e-12;      // turns; values closer than this are equal

// A path of body a, a path of body b, and their GLI (turns, signed).
struct Tangle {
  Path a, b;
  double gli = 0;
};

// "a (left_hand, right_hand) x b (neck, root)".
std::string TangleText(const Body& a, const Body& b, const Tangle& tangle);

// Algorithm 1: every pair of paths whose |GLI| is above one half and larger than that of every pair
// of their sub-paths. `table` is SegmentGliTable of the posture. All pairs by prefix sums from the
// roots, the sub-path condition by a running maximum over the four one-segment-shorter pairs.
std::vector<Tangle> FindTangles(const Body& a, const Body& b, const MatX& table);

// The same by the definition, pair by pair of sub-paths: the oracle of the tests and benchmarks.
std::vector<Tangle> FindTanglesByDefinition(const Body& a, const Body& b, const MatX& table);

// A tangle worth a residual, and why.
struct Tag {
  Tangle tangle;
  double rho = 0;      // robustness radius (rad, m): how far the bodies may move before it is lost
  int group_size = 1;  // literal tangles that say the same
};

struct ReductionOptions {
  double same_crossings = 0.6;  // cosine above which two tangles share their crossings
  double keep_rho = 0.8;        // a shorter pair may cost this share of the best robustness
  double min_rho = 0.08;        // weaker groups are dropped (the first is always kept)
  double min_rho_share = 0.3;   // and those this much weaker than the first: they bind more than
                                // they say, since a step changes them through the legs or the head
  int max_tags = 6;
};

// Reduces the literal list to few tags, by robustness radius
//   rho = (|GLI| - 0.5) / |d GLI / d q|,  q all coordinates of both bodies (m, rad):
// take the most robust; of the tangles that share its crossings (the vectors
// max(0, s p_i q_j G_ij) have a cosine above `same_crossings`) and keep at least `keep_rho` of its
// rho, keep the one with the fewest segments; drop the group; repeat.
std::vector<Tag> ReduceTangles(const Body& a, const PosedBody& posed_a, const Body& b,
                               const PosedBody& posed_b, const std::vector<Tangle>& literal,
                               const MatX& table, const ReductionOptions& options = {});

// A posture of which only the node positions are known: joint centres are taken at the nodes that
// the links turn about, which is all that a robustness radius needs. Rotations are left identity.
PosedBody PosedFromNodes(const Body& body, const std::vector<Vec3>& nodes);

// |d GLI / d q| of a tangle over all coordinates of both bodies.
double TangleGradientNorm(const Body& a, const PosedBody& posed_a, const Body& b,
                          const PosedBody& posed_b, const Tangle& tangle);

}  // namespace retarget
