// One frame of the problem, worked out: what a term sees.
#pragma once

#include <array>
#include <vector>

#include "model/body/pose.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

struct Frame {
  const Scene* scene = nullptr;
  int t = 0;
  const double* x = nullptr;     // the frame's coordinates [scene.num_coordinates()]
  const MatX* anchor = nullptr;  // Unknowns::anchor
  std::array<Pose, 2> pose;
  std::array<PosedBody, 2> posed;
  // dexp[figure][link]: turns a change of the link's edit into the world's angular change,
  // d omega_world = dexp d delta, dexp = R_link J_r(delta). Empty without derivatives.
  std::array<std::vector<Mat3>, 2> dexp;

  const Body& body(int figure) const { return scene->body[figure]; }
  // Poses both figures; with `derivatives` also the charts.
  void Set(const Scene& s, const Unknowns& unknowns, int frame, bool derivatives);
};

}  // namespace retarget::solver
