// smoothness, root_smoothness: the edit changes evenly, so the capture's own detail stays.
//   r = s_c (fps/30)^2 (x_c(t-1) - 2 x_c(t) + x_c(t+1) + b_c(t))     (rad, m; per (1/30 s)^2)
// for every coordinate c of the edit. b is the same second difference of the base that edits of the
// roots are counted from (Scene::base), so that the whole edit is smooth and not its rest alone;
// its turn is taken about the vertical in the axes of the placed root. Linear with the stencil (1,
// -2, 1): its normal equations are constant and diagonal in every block, which the back ends use.
// 3 frames, 1 body. YAML: weights.smoothness, weights.root_smoothness.
#pragma once

#include "model/settings.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

class Smoothness {
 public:
  Smoothness(const Scene& scene, const Settings& settings);
  // weight * s_c * (fps/30)^2 per coordinate of a frame.
  const VecX& weight() const { return weight_; }
  // True for the coordinates of the two roots (root_smoothness).
  bool IsRoot(int coordinate) const { return is_root_[coordinate]; }
  // Half the sum of squares over the rows centred on frames [first, last), root and joints apart.
  double HalfSquares(const MatX& edit, int first, int last, bool root) const;
  // Largest residual centred on frame t.
  double Largest(const MatX& edit, int t, bool root) const;
  // b(t): what the base adds to the second difference centred on frame t. [coordinates]
  VecX BaseDifference(int t) const;
  // Gradient of the cost by the coordinates of frame t is added to g. [coordinates]
  void AddGradient(const MatX& edit, int t, Eigen::Ref<VecX> g) const;
  // Coefficient of the normal equations between frames t and t + lag (lag 0, 1, 2), to be
  // multiplied by weight^2.
  static double StencilProduct(int num_frames, int t, int lag);

 private:
  double Difference(const MatX& edit, int t, int c) const;

  VecX weight_;
  MatX base_;  // b: [coordinates x frames]; empty where it is 0
  std::vector<bool> is_root_;
};

}  // namespace retarget::solver
