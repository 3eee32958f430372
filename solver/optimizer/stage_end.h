// When a stage of the solve has nothing left to gain, by progress of cost and step.
#pragma once

#include <deque>

namespace retarget::solver {

class StageEnd {
 public:
  // `tolerance` is of the cost; `cost` that of the start. Single frames are `patient`: their
  // iterations cost nothing, and only free steps end them.
  StageEnd(double tolerance, double cost, bool patient)
      : tolerance_(tolerance), patient_(patient), costs_{cost} {}

  // One accepted iteration: the cost after it, the way of the furthest node (m), and whether the
  // step was free, that is, not held short by the guard or the damping. A step that was held short
  // may be followed by longer ones, so by itself it says nothing; but one that moves nothing, or
  // several that gain nothing between them, do. True where the stage ends.
  bool Add(double cost, double step_m, bool free) {
    const double before = costs_.back();
    costs_.push_back(cost);
    flat_ = (free || (step_m < kStill && !patient_)) && before - cost < tolerance_ * before
                ? flat_ + 1
                : 0;
    if (flat_ >= kFlat) return true;
    if (patient_ || costs_.size() <= kWindow) return false;
    const double gained = costs_.front() - cost;
    const double worth = tolerance_ * costs_.front();
    costs_.pop_front();
    return gained < worth;
  }

 private:
  static constexpr double kStill = 1e-3;  // m
  static constexpr int kFlat = 2;         // in a row
  static constexpr size_t kWindow = 5;    // iterations, free or not, that gain less than one should

  double tolerance_;
  bool patient_;
  std::deque<double> costs_;
  int flat_ = 0;
};

}  // namespace retarget::solver
