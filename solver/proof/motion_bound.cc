#include "solver/proof/motion_bound.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

double NormOf(const Mat3& stretch) {
  if (stretch.isIdentity(0)) return 1;
  return stretch.norm();  // Frobenius: never below the spectral norm
}

}  // namespace

double ArcBetween(const Quat& p, const Quat& q) {
  const Quat d = p.conjugate() * q;
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

void BoundMotion(const KeyedMotion& motion, const std::vector<int>& order, int key,
                 MotionBounds* out) {
  const size_t n = motion.nodes.size();
  for (std::vector<double>* v : {&out->speed, &out->bend, &out->turn, &out->stretch}) v->resize(n);
  out->carried.resize(n);
  for (const int i : order) {
    const KeyedNode& node = motion.nodes[i];
    double rate = 0;
    if (node.rotation_track >= 0) {
      const std::vector<Quat>& track = motion.rotation_tracks[node.rotation_track];
      rate = ArcBetween(track[key], track[key + 1]);
    }
    double bone = node.translation.norm();
    Vec3 step = Vec3::Zero();
    if (node.translation_track >= 0) {
      const std::vector<Vec3>& track = motion.translation_tracks[node.translation_track];
      bone = std::max(track[key].norm(), track[key + 1].norm());
      step = track[key + 1] - track[key];
    }
    const double own = NormOf(node.stretch);
    if (node.parent < 0) {
      out->speed[i] = out->bend[i] = 0;
      out->turn[i] = rate;
      out->stretch[i] = own;
      out->carried[i] = step;
      continue;
    }
    const int p = node.parent;
    const double w = out->turn[p], slide = step.norm();
    out->speed[i] = out->speed[p] + out->stretch[p] * (w * bone + slide);
    out->bend[i] = out->bend[p] + out->stretch[p] * w * (w * bone + 2 * slide);
    out->turn[i] = w + rate;
    out->stretch[i] = out->stretch[p] * own;
    out->carried[i] = out->carried[p];
  }
}

double RelativeSpeed(const MovingPoint& p, const MovingPoint& q, double carried) {
  const double seen = ((p.at1 - p.at0) - (q.at1 - q.at0)).norm() + 0.5 * (p.bend + q.bend);
  return std::min(p.speed + q.speed + carried, seen);
}

}  // namespace retarget::solver
