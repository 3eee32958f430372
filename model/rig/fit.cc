#include "model/rig/fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "model/geometry/so3.h"
#include "model/rig/tree.h"

namespace retarget {
namespace {

constexpr double kTurn = 0.05;     // rad, standard deviation of a bone's turn
constexpr double kShift = 0.005;   // m, of a joint's shift
constexpr double kNoise = 0.0003;  // m, lambda^1/2
constexpr double kDone = 2e-5;     // m
constexpr double kLongest = 0.3;   // rad of one step
constexpr int kMostSteps = 12;

Mat3 Cross(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

class Fit {
 public:
  Fit(const Rig& rig, const RigFreedom& freedom, const std::vector<RigTarget>& targets,
      double metres_per_unit, const RigFrame& frame)
      : rig_(rig), targets_(targets), metres_(metres_per_unit), frame_(frame) {
    turn_column_.assign(rig.joints.size(), -1);
    shift_column_.assign(rig.joints.size(), -1);
    std::vector<char> carries(rig.joints.size(), 0);
    for (const RigTarget& target : targets) carries[target.joint] = 1;
    for (size_t j = rig.joints.size(); j-- > 0;) {
      if (carries[j] && rig.joints[j].parent >= 0) carries[rig.joints[j].parent] = 1;
    }
    for (int j = 0; j < rig.num_joints(); ++j) {
      if (carries[j] && freedom.shifts[j]) shift_column_[j] = Columns(3, kShift);
      const size_t axes = rig.joints[j].turns_freely ? 3 : rig.joints[j].turn_axes.size();
      if (carries[j] && freedom.turns[j] && axes > 0) {
        turn_column_[j] = Columns(static_cast<int>(axes), kTurn);
      }
    }
  }

  RigFrame Run() {
    double worst = Evaluate();
    double damping = 1;
    for (int step = 0; step < kMostSteps && worst > kDone; ++step) {
      const RigFrame before = frame_;
      const double cost = residual_.squaredNorm();
      const MatX jacobian = Jacobian();
      const MatX weighted = jacobian * deviation_.cwiseAbs2().asDiagonal();
      MatX normal = weighted * jacobian.transpose();
      normal.diagonal().array() += damping * kNoise * kNoise;
      VecX change = weighted.transpose() * normal.ldlt().solve(residual_);
      const double longest = LongestTurn(change);
      if (longest > kLongest) change *= kLongest / longest;
      Change(change);
      worst = Evaluate();
      if (residual_.squaredNorm() < cost) {
        damping = std::max(damping / 4, 1e-3);
        continue;
      }
      frame_ = before;
      worst = Evaluate();
      damping *= 16;
    }
    return frame_;
  }

 private:
  int Columns(int count, double deviation) {
    const int first = static_cast<int>(deviation_.size());
    deviation_.conservativeResize(first + count);
    deviation_.tail(count).setConstant(deviation);
    return first;
  }

  // What is left to go (m), beyond the slack; the largest of it.
  double Evaluate() {
    posed_ = PoseRig(rig_, frame_);
    residual_.resize(static_cast<long>(3 * targets_.size()));
    double worst = 0;
    for (size_t i = 0; i < targets_.size(); ++i) {
      const Vec3 apart = metres_ * (targets_[i].position - posed_.position[targets_[i].joint]);
      const double far = apart.norm();
      const double beyond = std::max(far - kFitSlack, 0.0);
      residual_.segment<3>(static_cast<long>(3 * i)) = far > 0 ? Vec3(beyond / far * apart) : apart;
      worst = std::max(worst, beyond);
    }
    return worst;
  }

  Quat RotationAbove(int joint) const {
    const int parent = rig_.joints[joint].parent;
    return parent < 0 ? Quat::Identity() : posed_.rotation[parent];
  }

  Mat3 LinearAbove(int joint) const {
    const int parent = rig_.joints[joint].parent;
    if (parent < 0) return Mat3::Identity();
    return posed_.linear.empty() ? posed_.rotation[parent].toRotationMatrix()
                                 : posed_.linear[parent];
  }

  // The axes about which a joint can turn, in its own frame as it stands. R exp(w) = A_1 ... A_n
  // exp(w): the last axis stays as it is, the first of two has been turned by the last.
  Eigen::Matrix<double, 3, Eigen::Dynamic> OwnAxes(int joint) const {
    const std::vector<Vec3>& axes = rig_.joints[joint].turn_axes;
    Eigen::Matrix<double, 3, Eigen::Dynamic> out(3, static_cast<long>(axes.size()));
    if (!axes.empty()) out.rightCols<1>() = axes.back();
    if (axes.size() == 2) out.col(0) = frame_.rotation[joint].conjugate() * axes[0];
    return out;
  }

  // d position[target] / d turn of `joint` against its parent (rad, world axes), in m.
  Mat3 Lever(int joint, int target) const {
    const Vec3 arm = posed_.position[target] - posed_.position[joint];
    if (posed_.linear.empty()) return -metres_ * Cross(arm);
    const Mat3 above = LinearAbove(joint);
    const Eigen::FullPivLU<Mat3> lu(above);
    if (!lu.isInvertible()) return Mat3::Zero();
    return -metres_ * above * Cross(lu.solve(arm)) *
           RotationAbove(joint).toRotationMatrix().transpose();
  }

  MatX Jacobian() const {
    MatX jacobian = MatX::Zero(residual_.size(), deviation_.size());
    for (size_t i = 0; i < targets_.size(); ++i) {
      const long row = static_cast<long>(3 * i);
      const int target = targets_[i].joint;
      std::vector<int> path = Between(rig_, -1, target);
      for (size_t k = 0; k < path.size(); ++k) {
        const int j = path[k];
        if (shift_column_[j] >= 0) {
          jacobian.block<3, 3>(row, shift_column_[j]).setIdentity();
        }
        if (turn_column_[j] < 0) continue;
        // A bone that turns takes along those below that cannot keep their orientation, up to the
        // next that can.
        if (!rig_.joints[j].turns_freely) {
          const MatX turn = posed_.rotation[j].toRotationMatrix() * OwnAxes(j);
          jacobian.middleCols(turn_column_[j], turn.cols()).middleRows<3>(row) +=
              (Lever(j, target) - LeverBelow(path, k, target)) * turn;
        } else {
          jacobian.block<3, 3>(row, turn_column_[j]) +=
              Lever(j, target) - LeverBelow(path, k, target);
        }
      }
      if (shift_column_[target] >= 0) {
        jacobian.block<3, 3>(row, shift_column_[target]).setIdentity();
      }
    }
    return jacobian;
  }

  // The lever of the next joint down the path that keeps its orientation in the world.
  Mat3 LeverBelow(const std::vector<int>& path, size_t k, int target) const {
    for (size_t n = k + 1; n < path.size(); ++n) {
      if (turn_column_[path[n]] >= 0 && rig_.joints[path[n]].turns_freely) {
        return Lever(path[n], target);
      }
    }
    return Mat3::Zero();
  }

  double LongestTurn(const VecX& change) const {
    double longest = 0;
    for (int j = 0; j < rig_.num_joints(); ++j) {
      if (turn_column_[j] < 0) continue;
      const int count =
          rig_.joints[j].turns_freely ? 3 : static_cast<int>(rig_.joints[j].turn_axes.size());
      longest = std::max(longest, change.segment(turn_column_[j], count).norm());
    }
    return longest;
  }

  void Change(const VecX& change) {
    std::vector<Quat> world(rig_.joints.size());
    for (int j = 0; j < rig_.num_joints(); ++j) {
      const int parent = rig_.joints[j].parent;
      const Quat above = parent < 0 ? Quat::Identity() : world[parent];
      const int turn = turn_column_[j], shift = shift_column_[j];
      if (shift >= 0) {
        const Mat3 linear = LinearAbove(j);
        const Eigen::FullPivLU<Mat3> lu(linear);
        if (lu.isInvertible()) {
          frame_.translation[j] += lu.solve(Vec3(change.segment<3>(shift) / metres_));
        }
      }
      if (turn >= 0 && rig_.joints[j].turns_freely) {
        world[j] = (ExpSo3(change.segment<3>(turn)) * posed_.rotation[j]).normalized();
        frame_.rotation[j] = (above.conjugate() * world[j]).normalized();
        continue;
      }
      if (turn >= 0) {
        const auto axes = OwnAxes(j);
        frame_.rotation[j] =
            (frame_.rotation[j] * ExpSo3(axes * change.segment(turn, axes.cols()))).normalized();
      }
      world[j] = above * frame_.rotation[j];
    }
  }

  const Rig& rig_;
  const std::vector<RigTarget>& targets_;
  const double metres_;
  RigFrame frame_;
  std::vector<int> turn_column_, shift_column_;  // [joints] first column, -1: fixed
  VecX deviation_;                               // [columns]
  PosedRig posed_;
  VecX residual_;  // [3 per target]
};

}  // namespace

RigFrame FitFrame(const Rig& rig, const RigFreedom& freedom, const std::vector<RigTarget>& targets,
                  double metres_per_unit, const RigFrame& frame) {
  return Fit(rig, freedom, targets, metres_per_unit, frame).Run();
}

}  // namespace retarget
