// The GLI of two polylines (Ho and Komura 2007, Eq. 3).
#pragma once

#include <vector>

#include "model/geometry/types.h"

namespace retarget {

// GLI (turns) of two polylines and its gradient with respect to their points (turns per metre).
// All terms at interior points cancel between neighbouring segments: what is left are the segments
// of one polyline seen from the two end points of the other, 2 (m + n) edge vectors in place of
// 4mn.
struct PathGli {
  double value = 0;
  std::vector<Vec3> gradient_p;  // one per point of p
  std::vector<Vec3> gradient_q;
};
double PolylineGli(const std::vector<Vec3>& p, const std::vector<Vec3>& q);
// The gradients alone; `value` is left 0.
PathGli PolylineGliGradient(const std::vector<Vec3>& p, const std::vector<Vec3>& q);
PathGli PolylineGliWithGradient(const std::vector<Vec3>& p, const std::vector<Vec3>& q);

}  // namespace retarget
