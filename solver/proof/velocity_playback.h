// Playback of a keyed motion with velocities, for the second checker alone. Inner part of
// solver/proof/advancement.h.
#pragma once

#include <array>
#include <vector>

#include "solver/proof/proof.h"

namespace retarget::solver {

// A point at an instant: place (m), velocity (m per interval), and a bound on the acceleration in
// the whole interval (m per interval squared).
struct PointState {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
  double a = 0;
};

class VelocityPlayback {
 public:
  explicit VelocityPlayback(const ProofTask& task);

  // Sets the interval from `key` to the next.
  void Enter(int key);
  // Both figures at `u` in [0, 1] of it.
  void At(double u);

  const PointState& Node(int figure, int node) const {
    return state_[task_.node[figure][node]].origin;
  }
  PointState Held(const HoldPoint& point) const;

 private:
  // A frame p -> L p + o with dL/du and the sum of turn rates.
  struct Frame {
    PointState origin;
    Mat3 linear = Mat3::Identity(), change = Mat3::Zero();
    double rates = 0, size = 1;
  };
  // What does not change in an interval: R(u) = R0 exp(u [w]x), translation t0 + u dt.
  struct Local {
    Mat3 start = Mat3::Identity();
    Vec3 axis = Vec3::Zero();
    double rate = 0;
    Vec3 t0 = Vec3::Zero(), dt = Vec3::Zero();
  };

  const ProofTask& task_;
  std::vector<char> used_;
  std::vector<Local> local_;
  std::vector<Frame> state_;
};

}  // namespace retarget::solver
