#include "solver/problem/smoothness.h"

#include <algorithm>

#include "model/geometry/so3.h"

namespace retarget::solver {
namespace {
constexpr double kStencil[3] = {1, -2, 1};
}

Smoothness::Smoothness(const Scene& scene, const Settings& settings) {
  for (VecX& part : part_) part.setZero(scene.num_coordinates());
  const double rate = scene.fps() / 30;
  for (int f = 0; f < 2; ++f) {
    const int first = scene.FirstCoordinate(f);
    const Body& body = scene.body[f];
    part_[1].segment<6>(first).setConstant(settings.weights.root_smoothness);
    for (int l = 0; l < body.num_links(); ++l) {
      const double share = JointShare(settings.joint_weights, body.links[l].name);
      part_[0].segment<3>(first + 3 + 3 * l).setConstant(settings.weights.smoothness * share);
    }
    part_[0].segment<3>(first) = part_[0].segment<3>(first + 3);
  }
  for (VecX& part : part_) part *= rate * rate;
  weight_ = (part_[0].array().square() + part_[1].array().square()).sqrt();
  const int n = scene.num_frames();
  for (int f = 0; f < 2; ++f) {
    if (scene.base[f].empty()) continue;
    if (base_.size() == 0) base_.setZero(scene.num_coordinates(), n);
    const int first = scene.FirstCoordinate(f);
    for (int t = 1; t + 1 < n; ++t) {
      const RootShift before = scene.BaseOf(f, t - 1), now = scene.BaseOf(f, t),
                      after = scene.BaseOf(f, t + 1);
      base_.col(t).segment<3>(first) = before.shift - 2 * now.shift + after.shift;
      base_.col(t).segment<3>(first + 3) =
          (before.yaw - 2 * now.yaw + after.yaw) *
          (scene.source[f].frames[t].rotation[0].conjugate() * Vec3::UnitY());
    }
  }
}

double Smoothness::Difference(const MatX& edit, int t, int c) const {
  const double own = edit(c, t - 1) - 2 * edit(c, t) + edit(c, t + 1);
  return base_.size() == 0 ? own : own + base_(c, t);
}

VecX Smoothness::BaseDifference(int t) const {
  return base_.size() == 0 ? VecX::Zero(weight_.size()) : VecX(base_.col(t));
}

double Smoothness::HalfSquares(const MatX& edit, int first, int last, bool root) const {
  const int n = static_cast<int>(edit.cols());
  double sum = 0;
  for (int t = std::max(first, 1); t < std::min(last, n - 1); ++t) {
    for (int c = 0; c < weight_.size(); ++c) {
      if (part_[root][c] == 0) continue;
      const double r = part_[root][c] * Difference(edit, t, c);
      sum += r * r;
    }
  }
  return 0.5 * sum;
}

double Smoothness::Largest(const MatX& edit, int t, bool root) const {
  if (t < 1 || t + 1 >= edit.cols()) return 0;
  double largest = 0;
  for (int c = 0; c < weight_.size(); ++c) {
    if (part_[root][c] == 0) continue;
    const double r = part_[root][c] * Difference(edit, t, c);
    largest = std::max(largest, std::abs(r));
  }
  return largest;
}

void Smoothness::AddGradient(const MatX& edit, int t, Eigen::Ref<VecX> g) const {
  AddGradient(edit, t, weight_, g);
}

void Smoothness::AddGradient(const MatX& edit, int t, bool root, Eigen::Ref<VecX> g) const {
  AddGradient(edit, t, part_[root], g);
}

void Smoothness::AddGradient(const MatX& edit, int t, const VecX& weight,
                             Eigen::Ref<VecX> g) const {
  const int n = static_cast<int>(edit.cols());
  for (int centre = std::max(t - 1, 1); centre <= std::min(t + 1, n - 2); ++centre) {
    const double own = kStencil[t - centre + 1];
    g.array() += own * weight.array().square() *
                 (edit.col(centre - 1) - 2 * edit.col(centre) + edit.col(centre + 1)).array();
    if (base_.size() == 0) continue;
    g.array() += own * weight.array().square() * base_.col(centre).array();
  }
}

double Smoothness::StencilProduct(int num_frames, int t, int lag) {
  double sum = 0;
  for (int centre = std::max(t + lag - 1, 1); centre <= std::min(t + 1, num_frames - 2); ++centre) {
    sum += kStencil[t - centre + 1] * kStencil[t + lag - centre + 1];
  }
  return sum;
}

}  // namespace retarget::solver
