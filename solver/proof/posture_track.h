// The two figures between two keys: their places at instants, and what their points can do in
// between. Inner part of solver/proof/proof.h.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "solver/proof/gap_bound.h"
#include "solver/proof/proof.h"

namespace retarget::solver {

// One instant of a key interval. Gaps and GLI are worked out when they are first asked for.
struct Instant {
  double share = 0;  // of the way between the keys
  std::array<std::vector<Vec3>, 2> node;
  std::vector<std::array<Vec3, 2>> held;  // both points of each hold
  std::vector<double> gli;                // [tags] s GLI; NaN: not known yet
  std::vector<Gap> gap;                   // [pairs]
  std::vector<char> gap_known;
};

// Bounds of both figures over one key interval.
struct IntervalBounds {
  std::array<std::vector<double>, 2> speed, bend;  // [nodes]
  std::vector<std::array<MovingPoint, 2>> held;    // speed and bend alone
  std::array<Vec3, 2> carried = {Vec3::Zero(), Vec3::Zero()};
  // Difference of the steps that carry both figures, which moves one against the other.
  double carried_apart() const { return (carried[0] - carried[1]).norm(); }
};

class PostureTrack {
 public:
  PostureTrack(const ProofTask& task, int num_pairs);

  // The instant at `share` of the way from `key` to the next.
  void Place(int key, double share, Instant* out);
  // Bounds from `key` to the next; zero at the last key.
  void Bound(int key, IntervalBounds* out);

 private:
  const ProofTask& task_;
  int num_pairs_;
  std::vector<int> order_;
  KeyedPosture posture_;
  MotionBounds bounds_;
};

// The points of both figures over a part `length` of a key interval.
struct MovingFigures {
  std::array<std::vector<MovingPoint>, 2> node;
  std::vector<std::array<MovingPoint, 2>> held;
  double carried = 0;
};
void FollowPoints(const Instant& i0, const Instant& i1, const IntervalBounds& bounds, double length,
                  MovingFigures* out);

}  // namespace retarget::solver
