// smoothness, root_smoothness: the edit changes evenly, so the capture's own detail stays.
//   r = s_c (fps/30)^2 (x_c(t-1) - 2 x_c(t) + x_c(t+1) + b_c(t))     (rad, m; per (1/30 s)^2)
// for every coordinate c of the edit, s_c its joint's share. Where contacts ask for quick changes,
// they are made by what is cheapest to change: were the joints smooth and the root not, it would
// shake the whole body. So one weight works on both, and the root's share is as much over the
// joints' as its lever is: what a coordinate moves all nodes by, as root mean square, is 1 m per m
// for the root, 0.6 m per rad for its turn, 0.45 to 0.03 for joints from waist to ankle.
// root_smoothness is the same of the root's coordinates alone, s_c = 1. b is the same second
// difference of the base that edits of the roots are counted from (Scene::base), so that the whole
// edit is smooth and not its rest alone; its turn is taken about the vertical in the axes of the
// placed root. Linear with the stencil (1, -2, 1): its normal equations are constant and diagonal
// in every block, which the back ends use.
// 3 frames, 1 body. YAML: weights.smoothness, weights.root_smoothness, joint_weights.
#pragma once

#include <array>

#include "model/settings.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

class Smoothness {
 public:
  Smoothness(const Scene& scene, const Settings& settings);
  // Of both terms together, per coordinate of a frame: the root of the sum of the squares of
  // weight * s_c * (fps/30)^2.
  const VecX& weight() const { return weight_; }
  // Half the sum of squares over the rows centred on frames [first, last), of smoothness or of
  // root_smoothness.
  double HalfSquares(const MatX& edit, int first, int last, bool root) const;
  // Largest residual of either centred on frame t.
  double Largest(const MatX& edit, int t, bool root) const;
  // b(t): what the base adds to the second difference centred on frame t. [coordinates]
  VecX BaseDifference(int t) const;
  // Gradient of the cost of both, or of one, by the coordinates of frame t is added to g.
  // [coordinates]
  void AddGradient(const MatX& edit, int t, Eigen::Ref<VecX> g) const;
  void AddGradient(const MatX& edit, int t, bool root, Eigen::Ref<VecX> g) const;
  // Coefficient of the normal equations between frames t and t + lag (lag 0, 1, 2), to be
  // multiplied by weight^2.
  static double StencilProduct(int num_frames, int t, int lag);

 private:
  double Difference(const MatX& edit, int t, int c) const;
  void AddGradient(const MatX& edit, int t, const VecX& weight, Eigen::Ref<VecX> g) const;

  std::array<VecX, 2> part_;  // weights of smoothness and of root_smoothness
  VecX weight_;
  MatX base_;  // b: [coordinates x frames]; empty where it is 0
};

}  // namespace retarget::solver
