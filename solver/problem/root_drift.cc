#include "solver/problem/root_drift.h"

#include <cmath>

#include "model/geometry/so3.h"

namespace retarget::solver {
namespace {

// Standard deviation of the window that tells drift from motion (s): a step of a walk takes about
// as long, so what sways with the steps is motion.
constexpr double kSlow = 0.5;
// So much of a drift the limbs can bear, by bending or turning a little further: it is left to
// them.
constexpr double kPlay = 0.1;       // m
constexpr double kPlayTurn = 0.25;  // rad

// How b's root differs from where it belongs beside a's: a turn, and x and z (m).
struct Parting {
  double yaw = 0, x = 0, z = 0;
};

double HeadingOf(const Scene& scene, int figure, const Pose& pose) {
  return YawOf(pose.rotation[0] * scene.posture.pose[figure].rotation[0].conjugate());
}

std::vector<Parting> Partings(const Scene& scene) {
  const Vec3 apart = scene.posture.pose[1].root_position - scene.posture.pose[0].root_position;
  std::vector<Parting> out;
  for (int t = 0; t < scene.num_frames(); ++t) {
    const Pose &a = scene.source[0].frames[t], &b = scene.source[1].frames[t];
    const double heading_a = HeadingOf(scene, 0, a);
    const double turn = std::remainder(HeadingOf(scene, 1, b) - heading_a, 2 * kPi);
    // Between the two headings, where both look once they have met.
    const Vec3 wanted = YawRotation(heading_a + 0.5 * turn) * apart;
    const Vec3 off = b.root_position - a.root_position - wanted;
    Parting now{turn, off.x(), off.z()};
    if (!out.empty()) now.yaw += 2 * kPi * std::round((out.back().yaw - now.yaw) / (2 * kPi));
    out.push_back(now);
  }
  return out;
}

// Value at frame t of the straight line that fits the partings about t best, near frames most: at
// the ends, where the window is one-sided, it follows a drift that a mean would lag behind.
Parting SlowPart(const std::vector<Parting>& partings, int t, double fps) {
  const int reach = static_cast<int>(3 * kSlow * fps);
  double w0 = 0, w1 = 0, w2 = 0;
  Parting s0, s1;
  for (int k = -reach; k <= reach; ++k) {
    if (t + k < 0 || t + k >= static_cast<int>(partings.size())) continue;
    const double u = k / (kSlow * fps), w = std::exp(-0.5 * u * u);
    const Parting& p = partings[t + k];
    w0 += w, w1 += w * u, w2 += w * u * u;
    s0.yaw += w * p.yaw, s0.x += w * p.x, s0.z += w * p.z;
    s1.yaw += w * u * p.yaw, s1.x += w * u * p.x, s1.z += w * u * p.z;
  }
  const double determinant = w0 * w2 - w1 * w1;
  if (determinant < 1e-9 * w0 * w0) return {s0.yaw / w0, s0.x / w0, s0.z / w0};
  const auto at = [&](double m0, double m1) { return (w2 * m0 - w1 * m1) / determinant; };
  return {at(s0.yaw, s1.yaw), at(s0.x, s1.x), at(s0.z, s1.z)};
}

// What is left of a drift of this size once the limbs bear their part.
double BeyondPlay(double size, double play) { return size > play ? 1 - play / size : 0; }

// Horizontal way of a root (m).
double TravelOf(const Clip& clip) {
  double travel = 0;
  for (size_t t = 1; t < clip.frames.size(); ++t) {
    const Vec3 step = clip.frames[t].root_position - clip.frames[t - 1].root_position;
    travel += std::hypot(step.x(), step.z());
  }
  return travel;
}

}  // namespace

std::array<std::vector<RootShift>, 2> RootDriftCorrection(const Scene& scene) {
  const size_t frames = static_cast<size_t>(scene.num_frames());
  std::array<std::vector<RootShift>, 2> shifts;
  for (auto& shift : shifts) shift.assign(frames, {});
  const bool own =
      scene.root[0] == RootReference::kOwnClip && scene.root[1] == RootReference::kOwnClip;
  if (!own || scene.tangles.empty() || frames < 2) return shifts;
  const double a = TravelOf(scene.source[0]), b = TravelOf(scene.source[1]);
  const double share = a + b > 0 ? a / (a + b) : 0.5;
  const std::vector<Parting> partings = Partings(scene);
  const Parting laid = SlowPart(partings, scene.template_frame, scene.fps());
  for (size_t t = 0; t < frames; ++t) {
    const Parting slow = SlowPart(partings, static_cast<int>(t), scene.fps());
    double yaw = slow.yaw - laid.yaw;
    Vec3 drift(slow.x - laid.x, 0, slow.z - laid.z);
    yaw *= BeyondPlay(std::abs(yaw), kPlayTurn);
    drift *= BeyondPlay(drift.norm(), kPlay);
    shifts[0][t] = {share * yaw, share * drift};
    shifts[1][t] = {(share - 1) * yaw, (share - 1) * drift};
  }
  return shifts;
}

Pose ShiftedRoot(const Pose& source, const RootShift& shift) {
  Pose out = source;
  out.root_position += shift.shift;
  out.rotation[0] = YawRotation(shift.yaw) * source.rotation[0];
  return out;
}

}  // namespace retarget::solver
