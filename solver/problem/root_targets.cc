#include "solver/problem/root_targets.h"

#include "solver/problem/root_drift.h"

namespace retarget::solver {

std::vector<RelativeRoot> RelativeRootTargets(const Scene& scene, int figure) {
  std::vector<RelativeRoot> targets;
  if (scene.root[figure] == RootReference::kOwnClip) return targets;
  const Pose& self = scene.posture.pose[figure];
  const Pose& partner = scene.posture.pose[1 - figure];
  const Pose& start = scene.source[figure].frames[scene.template_frame];
  const Quat partner_inverse = partner.rotation[0].conjugate();
  const Quat start_inverse = start.rotation[0].conjugate();
  for (const Pose& pose : scene.source[figure].frames) {
    // X_T X_clip(t0)^-1 X_clip(t), then into the partner's frame.
    const Quat moved_rotation = self.rotation[0] * start_inverse * pose.rotation[0];
    const Vec3 moved =
        self.root_position +
        self.rotation[0] * (start_inverse * (pose.root_position - start.root_position));
    targets.push_back({partner_inverse * (moved - partner.root_position),
                       (partner_inverse * moved_rotation).normalized()});
  }
  return targets;
}

std::array<std::vector<RootShift>, 2> EditBase(const Scene& scene) {
  std::array<std::vector<RootShift>, 2> base = RootDriftCorrection(scene);
  for (int f = 0; f < 2; ++f) {
    if (scene.root[f] == RootReference::kOwnClip) continue;
    const std::vector<double> headings = HeadingsOf(scene, 1 - f);
    for (size_t t = 0; t < headings.size(); ++t) base[f][t] = {headings[t], Vec3::Zero()};
  }
  return base;
}

}  // namespace retarget::solver
