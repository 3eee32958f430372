#include "io/acclaim/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "model/geometry/euler_angles.h"

namespace retarget::io::acclaim {
namespace {

// A radian of orientation counts as much as a displacement by this part of all bones' lengths: 2 to
// 3 cm on a human.
constexpr double kSizePerRadian = 0.005;
constexpr double kHeld = 1e-6;  // rad: a rotation is held if no more is lost
constexpr int kMostSteps = 10;
constexpr double kDamping = 1e-6;

double NearestTurn(double angle, double previous) {
  return angle + 2 * kPi * std::round((previous - angle) / (2 * kPi));
}

Quat TurnOf(const AcclaimBone& bone, const Vec3& angles) {
  const std::array<int, 3> axes = TurnAxes(bone);
  Quat turn = Quat::Identity();
  for (int k = 0; k < NumTurns(bone); ++k) {
    turn = turn * AxisTurn(axes[static_cast<size_t>(k)], angles[k]);
  }
  return turn;
}

// One bone alone: Euler angles, and of fewer than three axes the part that they hold.
Vec3 AnglesOf(const AcclaimBone& bone, const Quat& rotation, const Vec3& previous) {
  const Quat turn = (bone.axes.conjugate() * rotation * bone.axes).normalized();
  Vec3 angles = EulerAngles(turn.toRotationMatrix(), TurnAxes(bone), previous);
  for (int k = NumTurns(bone); k < 3; ++k) angles[k] = 0;
  return angles;
}

// Least squares for one frame over all turns and the root's translation.
class FrameFit {
 public:
  FrameFit(const AcclaimFile& file, const RigFrame& frame, double scale, BoneValues* values)
      : file_(file), rig_(file.motion.rig), scale_(scale), values_(*values) {
    wanted_ = PoseRig(rig_, frame);
    for (const RigJoint& joint : rig_.joints) size_ += scale * joint.offset.norm();
    for (size_t j = 0; j < file.bones.size(); ++j) {
      if (j == 0) {
        for (const int kind : file.bones[0].dofs) {
          if (kind < kFirstRotationDof) unknowns_.push_back({0, kind});
        }
      }
      for (int k = 0; k < NumTurns(file.bones[j]); ++k) {
        unknowns_.push_back({static_cast<int>(j), kFirstRotationDof + k});
      }
    }
  }

  void Run() {
    double cost = Evaluate();
    double damping = kDamping;
    for (int step = 0; step < kMostSteps && cost > 0; ++step) {
      const BoneValues before = values_;
      const MatX jacobian = Jacobian();
      MatX normal = jacobian.transpose() * jacobian;
      normal.diagonal().array() += damping;
      const VecX change = -normal.ldlt().solve(jacobian.transpose() * residual_);
      for (size_t u = 0; u < unknowns_.size(); ++u) Value(u) += change[static_cast<long>(u)];
      const double trial = Evaluate();
      if (trial < cost) {
        const bool done = cost - trial < 1e-6 * cost;
        cost = trial;
        damping = std::max(kDamping, damping / 10);
        if (done) break;
      } else {
        values_ = before;
        Evaluate();
        damping *= 100;
      }
    }
  }

 private:
  struct Unknown {
    int joint;
    int kind;  // 0..2 a translation of the root, 3..5 the turn kind - 3 of TurnAxes
  };

  double& Value(size_t u) {
    const auto& [joint, kind] = unknowns_[u];
    return kind < kFirstRotationDof
               ? values_.shift[0][kind]
               : values_.angles[static_cast<size_t>(joint)][kind - kFirstRotationDof];
  }

  // Residuals, [6 per joint]: displacement over the size, weighted rotation in the world (rad).
  double Evaluate() {
    RigFrame frame;
    for (size_t j = 0; j < file_.bones.size(); ++j) {
      const AcclaimBone& bone = file_.bones[j];
      Vec3 shift = Vec3::Zero();
      for (const int kind : bone.dofs) {
        if (kind < kFirstRotationDof) shift[kind] = values_.shift[j][kind];
      }
      frame.translation.push_back(scale_ * rig_.joints[j].offset +
                                  (j == 0 ? shift : bone.axes * shift));
      frame.rotation.push_back(bone.axes * TurnOf(bone, values_.angles[j]) * bone.axes.conjugate());
    }
    posed_ = PoseRig(rig_, frame);
    residual_.resize(static_cast<long>(6 * file_.bones.size()));
    for (size_t j = 0; j < file_.bones.size(); ++j) {
      const long row = static_cast<long>(6 * j);
      residual_.segment<3>(row) = (posed_.position[j] - wanted_.position[j]) / size_;
      Quat apart = posed_.rotation[j] * wanted_.rotation[j].conjugate();
      if (apart.w() < 0) apart.coeffs() *= -1;
      residual_.segment<3>(row + 3) = 2 * kSizePerRadian * apart.vec();  // its chord
    }
    return residual_.squaredNorm();
  }

  MatX Jacobian() const {
    MatX jacobian = MatX::Zero(residual_.size(), static_cast<long>(unknowns_.size()));
    for (size_t u = 0; u < unknowns_.size(); ++u) {
      const auto& [joint, kind] = unknowns_[u];
      const Vec3 axis = kind < kFirstRotationDof ? Vec3(Vec3::Unit(kind)) : AxisInWorld(u);
      for (size_t j = static_cast<size_t>(joint); j < file_.bones.size(); ++j) {
        if (!Carries(static_cast<size_t>(joint), j)) continue;
        const long row = static_cast<long>(6 * j), column = static_cast<long>(u);
        if (kind < kFirstRotationDof) {
          jacobian.block<3, 1>(row, column) = axis / size_;
          continue;
        }
        const Vec3 arm = posed_.position[j] - posed_.position[static_cast<size_t>(joint)];
        jacobian.block<3, 1>(row, column) = axis.cross(arm) / size_;
        jacobian.block<3, 1>(row + 3, column) = kSizePerRadian * axis;
      }
    }
    return jacobian;
  }

  // The axis that a turn is about, behind the turns outside of it.
  Vec3 AxisInWorld(size_t u) const {
    const auto& [joint, kind] = unknowns_[u];
    const size_t j = static_cast<size_t>(joint);
    const AcclaimBone& bone = file_.bones[j];
    const std::array<int, 3> axes = TurnAxes(bone);
    Quat above = rig_.joints[j].parent < 0
                     ? Quat::Identity()
                     : posed_.rotation[static_cast<size_t>(rig_.joints[j].parent)];
    above = above * bone.axes;
    const size_t turn = static_cast<size_t>(kind - kFirstRotationDof);
    for (size_t k = 0; k < turn; ++k) {
      above = above * AxisTurn(axes[k], values_.angles[j][static_cast<long>(k)]);
    }
    return above * Vec3::Unit(axes[turn]);
  }

  bool Carries(size_t above, size_t joint) const {
    int j = static_cast<int>(joint);
    while (j > static_cast<int>(above)) j = rig_.joints[static_cast<size_t>(j)].parent;
    return j == static_cast<int>(above);
  }

  const AcclaimFile& file_;
  const Rig& rig_;
  double scale_;
  BoneValues& values_;
  double size_ = 1e-9;  // sum of the bones, file units
  std::vector<Unknown> unknowns_;
  PosedRig wanted_, posed_;
  VecX residual_;
};

}  // namespace

int NumTurns(const AcclaimBone& bone) {
  return static_cast<int>(
      std::ranges::count_if(bone.dofs, [](int kind) { return kind >= kFirstRotationDof; }));
}

std::array<int, 3> TurnAxes(const AcclaimBone& bone) {
  std::vector<int> axes;
  for (size_t k = bone.dofs.size(); k-- > 0;) {
    if (bone.dofs[k] >= kFirstRotationDof) axes.push_back(bone.dofs[k] - kFirstRotationDof);
  }
  return CompleteAxes(axes);
}

BoneValues FitFrame(const AcclaimFile& file, const RigFrame& frame, double scale,
                    const BoneValues& previous) {
  BoneValues values;
  bool all_held = true;
  for (size_t j = 0; j < file.bones.size(); ++j) {
    const AcclaimBone& bone = file.bones[j];
    const Vec3 shift = frame.translation[j] - scale * file.motion.rig.joints[j].offset;
    values.shift.push_back(j == 0 ? shift : bone.axes.conjugate() * shift);
    values.angles.push_back(AnglesOf(bone, frame.rotation[j].normalized(), previous.angles[j]));
    const Quat held = bone.axes * TurnOf(bone, values.angles[j]) * bone.axes.conjugate();
    all_held = all_held && held.angularDistance(frame.rotation[j].normalized()) < kHeld;
  }
  if (all_held) return values;
  FrameFit(file, frame, scale, &values).Run();
  for (size_t j = 0; j < file.bones.size(); ++j) {
    for (int k = 0; k < NumTurns(file.bones[j]); ++k) {
      values.angles[j][k] = NearestTurn(values.angles[j][k], previous.angles[j][k]);
    }
  }
  return values;
}

}  // namespace retarget::io::acclaim
