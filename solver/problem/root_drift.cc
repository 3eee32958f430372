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

// Adds whole turns to angles: no step is longer than pi, and that at `frame` lies within pi.
void Unwrap(int frame, std::vector<double>* angles) {
  std::vector<double>& a = *angles;
  for (size_t t = 1; t < a.size(); ++t) a[t] = a[t - 1] + std::remainder(a[t] - a[t - 1], 2 * kPi);
  const double turns = 2 * kPi * std::round(a[frame] / (2 * kPi));
  for (double& angle : a) angle -= turns;
}

// Value at frame t of the straight line that fits the series about t best, near frames most: at
// the ends, where the window is one-sided, it follows a drift that a mean would lag behind.
Vec3 SlowPart(const std::vector<Vec3>& series, int t, double fps) {
  const int reach = static_cast<int>(3 * kSlow * fps);
  double w0 = 0, w1 = 0, w2 = 0;
  Vec3 m0 = Vec3::Zero(), m1 = Vec3::Zero();
  for (int k = -reach; k <= reach; ++k) {
    if (t + k < 0 || t + k >= static_cast<int>(series.size())) continue;
    const double u = k / (kSlow * fps), w = std::exp(-0.5 * u * u);
    w0 += w, w1 += w * u, w2 += w * u * u;
    m0 += w * series[t + k];
    m1 += w * u * series[t + k];
  }
  const double determinant = w0 * w2 - w1 * w1;
  if (determinant < 1e-9 * w0 * w0) return m0 / w0;
  return (w2 * m0 - w1 * m1) / determinant;
}

// What is left of a drift of this size once the limbs bear their part.
double BeyondPlay(double size, double play) { return size > play ? 1 - play / size : 0; }

// The slow part of a series less that at the template's frame, and less what the limbs can bear.
std::vector<Vec3> Drift(const Scene& scene, const std::vector<Vec3>& series, double play) {
  const Vec3 laid = SlowPart(series, scene.template_frame, scene.fps());
  std::vector<Vec3> drift;
  for (int t = 0; t < scene.num_frames(); ++t) {
    const Vec3 slow = SlowPart(series, t, scene.fps()) - laid;
    drift.push_back(BeyondPlay(slow.norm(), play) * slow);
  }
  return drift;
}

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
  const std::vector<double> heading = HeadingsOf(scene, 0), heading_b = HeadingsOf(scene, 1);
  std::vector<double> turn;  // of b against a
  std::vector<Vec3> turns, apart;
  for (size_t t = 0; t < frames; ++t) turn.push_back(heading_b[t] - heading[t]);
  Unwrap(scene.template_frame, &turn);
  for (const double angle : turn) turns.emplace_back(0, angle, 0);
  turns = Drift(scene, turns, kPlayTurn);
  const Vec3 wanted = scene.posture.pose[1].root_position - scene.posture.pose[0].root_position;
  for (size_t t = 0; t < frames; ++t) {
    // Half way between the two headings, once both figures have been turned.
    const double met = heading[t] + share * turns[t].y() + 0.5 * (turn[t] - turns[t].y());
    const Vec3 is =
        scene.source[1].frames[t].root_position - scene.source[0].frames[t].root_position;
    apart.push_back(is - YawRotation(met) * wanted);
    apart.back().y() = 0;
  }
  apart = Drift(scene, apart, kPlay);
  for (size_t t = 0; t < frames; ++t) {
    shifts[0][t] = {share * turns[t].y(), share * apart[t]};
    shifts[1][t] = {(share - 1) * turns[t].y(), (share - 1) * apart[t]};
  }
  return shifts;
}

std::vector<double> HeadingsOf(const Scene& scene, int figure) {
  std::vector<double> headings;
  const Quat laid = scene.posture.pose[figure].rotation[0].conjugate();
  for (const Pose& pose : scene.source[figure].frames) {
    headings.push_back(YawOf(pose.rotation[0] * laid));
  }
  Unwrap(scene.template_frame, &headings);
  return headings;
}

}  // namespace retarget::solver
