// When a stage of the solve has nothing left to gain.
#pragma once

#include <deque>

namespace retarget::solver {

class StageEnd {
 public:
  // `tolerance` is of the cost; `cost` that of the start. Single frames are `patient`: their
  // iterations cost nothing, and only free steps end them.
  StageEnd(double tolerance, double cost, bool patient)
      : tolerance_(tolerance), patient_(patient), costs_{cost} {}

  // One accepted iteration: the cost after it, and whether the step was free, that is, not held
  // short by the guard or the damping. A step that was held short may be followed by longer ones,
  // so by itself it says nothing; but a run of steps that gain nothing between them does. True
  // where the stage ends.
  bool Add(double cost, bool free) {
    const double before = costs_.back();
    costs_.push_back(cost);
    flat_ = free && before - cost < tolerance_ * before ? flat_ + 1 : 0;
    if (flat_ >= kFlat) return true;
    if (patient_ || costs_.size() <= kRun) return false;
    const double gained = costs_.front() - cost;
    const double worth = kWorth * tolerance_ * costs_.front();
    costs_.pop_front();
    return gained < worth;
  }

 private:
  static constexpr int kFlat = 2;  // free steps in a row that gain little
  // Frames that were held back are damped for up to about as many iterations.
  static constexpr size_t kRun = 8;
  static constexpr double kWorth = 2;  // what a run should gain, over the tolerance of one step

  double tolerance_;
  bool patient_;
  std::deque<double> costs_;
  int flat_ = 0;
};

}  // namespace retarget::solver
