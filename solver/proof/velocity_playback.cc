#include "solver/proof/velocity_playback.h"

#include <algorithm>
#include <cmath>

namespace retarget::solver {
namespace {

Mat3 CrossMatrix(const Vec3& w) {
  Mat3 m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

// The rotation matrix of a unit quaternion, written out.
Mat3 MatrixOf(const Quat& q) {
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  Mat3 m;
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return m;
}

// Rodrigues: the turn by `angle` about a unit axis.
Mat3 TurnBy(const Vec3& axis, double angle) {
  const Mat3 k = CrossMatrix(axis);
  const double half = std::sin(angle / 2);
  return Mat3::Identity() + std::sin(angle) * k + 2 * half * half * k * k;
}

}  // namespace

VelocityPlayback::VelocityPlayback(const ProofTask& task)
    : task_(task), used_(task.motion.nodes.size(), 0) {
  for (const std::vector<int>& figure : task.node) {
    for (int n : figure) {
      for (; n >= 0; n = task.motion.nodes[n].parent) used_[n] = 1;
    }
  }
  local_.resize(used_.size());
  state_.resize(used_.size());
}

void VelocityPlayback::Enter(int key) {
  const KeyedMotion& motion = task_.motion;
  const int next = std::min(key + 1, motion.num_keys() - 1);
  for (size_t i = 0; i < used_.size(); ++i) {
    if (!used_[i]) continue;
    const KeyedNode& node = motion.nodes[i];
    Local& l = local_[i];
    l = Local();
    l.t0 = node.translation;
    if (node.translation_track >= 0) {
      l.t0 = motion.translation_tracks[node.translation_track][key];
      l.dt = motion.translation_tracks[node.translation_track][next] - l.t0;
    }
    Quat q0 = node.rotation;
    if (node.rotation_track >= 0) {
      q0 = motion.rotation_tracks[node.rotation_track][key];
      Quat q1 = motion.rotation_tracks[node.rotation_track][next];
      // The vector part of q0^-1 q1 along the shorter arc.
      double w = q0.coeffs().dot(q1.coeffs());
      if (w < 0) {
        q1.coeffs() = -q1.coeffs();
        w = -w;
      }
      const Vec3 v = q0.w() * q1.vec() - q1.w() * q0.vec() - q0.vec().cross(q1.vec());
      const double sine = v.norm();
      if (sine > 0) {
        l.axis = v / sine;
        l.rate = 2 * std::atan2(sine, w);
      }
    }
    l.start = MatrixOf(q0);
  }
}

void VelocityPlayback::At(double u) {
  for (size_t i = 0; i < used_.size(); ++i) {
    if (!used_[i]) continue;
    const KeyedNode& node = task_.motion.nodes[i];
    const Local& l = local_[i];
    Frame& f = state_[i];
    const Vec3 t = l.t0 + u * l.dt;
    const Mat3 turned = l.rate > 0 ? Mat3(l.start * TurnBy(l.axis, u * l.rate)) : l.start;
    const Mat3 own = turned * node.stretch;
    const Mat3 own_change = turned * CrossMatrix(l.rate * l.axis) * node.stretch;
    const double size = node.stretch == Mat3::Identity() ? 1 : node.stretch.norm();
    if (node.parent < 0) {
      f = {{t, l.dt, 0}, own, own_change, l.rate, size};
      continue;
    }
    const Frame& up = state_[node.parent];
    // A bone is never longer than at one of its keys.
    const double bone = std::max(l.t0.norm(), (l.t0 + l.dt).norm());
    f.origin.p = up.origin.p + up.linear * t;
    f.origin.v = up.origin.v + up.change * t + up.linear * l.dt;
    f.origin.a = up.origin.a + up.size * (up.rates * up.rates * bone + 2 * up.rates * l.dt.norm());
    f.linear = up.linear * own;
    f.change = up.change * own + up.linear * own_change;
    f.rates = up.rates + l.rate;
    f.size = up.size * size;
  }
}

PointState VelocityPlayback::Held(const HoldPoint& point) const {
  if (point.figure == kWorld) return {point.offset, Vec3::Zero(), 0};
  const int n = task_.node[point.figure][point.node];
  const int parent = task_.motion.nodes[n].parent;
  const Frame& carrier = state_[parent < 0 ? n : parent];
  PointState out = state_[n].origin;
  out.p += carrier.linear * point.offset;
  out.v += carrier.change * point.offset;
  out.a += carrier.rates * carrier.rates * carrier.size * point.offset.norm();
  return out;
}

}  // namespace retarget::solver
