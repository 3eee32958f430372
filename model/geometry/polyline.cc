#include "model/geometry/polyline.h"

#include "model/geometry/gli.h"

namespace retarget {
namespace {

// Adds `sign` times the gradient of the terms in which the segments of `line` are seen from `eye`:
// to the points of `line` and, with the opposite sum, to `eye` itself.
void AddViewFrom(const Vec3& eye, double sign, const std::vector<Vec3>& line, Vec3* at_eye,
                 std::vector<Vec3>* at_line) {
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 p = line[i] - eye, q = line[i + 1] - eye;
    const double np = p.norm(), nq = q.norm();
    if (np == 0 || nq == 0) continue;
    const Vec3 edge = sign / (4 * kPi) * GliEdge(p, q);
    (*at_line)[i] += edge / np;
    (*at_line)[i + 1] += edge / nq;
    *at_eye -= edge / np + edge / nq;
  }
}

}  // namespace

double PolylineGli(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  double sum = 0;
  for (size_t i = 0; i + 1 < p.size(); ++i) {
    for (size_t j = 0; j + 1 < q.size(); ++j) sum += SegmentGli(p[i], p[i + 1], q[j], q[j + 1]);
  }
  return sum;
}

PathGli PolylineGliWithGradient(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  PathGli out = PolylineGliGradient(p, q);
  out.value = PolylineGli(p, q);
  return out;
}

PathGli PolylineGliGradient(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  PathGli out;
  out.gradient_p.assign(p.size(), Vec3::Zero());
  out.gradient_q.assign(q.size(), Vec3::Zero());
  // Seen from an end of q the corner vectors are (p_i - eye); seen from an end of p they are
  // (eye - q_j), the same edge vector with both arguments negated, which leaves it unchanged but
  // swaps the roles of point and eye in the gradient's sign.
  AddViewFrom(q.front(), 1, p, &out.gradient_q.front(), &out.gradient_p);
  AddViewFrom(q.back(), -1, p, &out.gradient_q.back(), &out.gradient_p);
  AddViewFrom(p.back(), -1, q, &out.gradient_p.back(), &out.gradient_q);
  AddViewFrom(p.front(), 1, q, &out.gradient_p.front(), &out.gradient_q);
  return out;
}

}  // namespace retarget
