#include "solver/terms/foot_lock.h"

namespace retarget {

FootLock::FootLock(const Scene& scene) : planted_(scene.num_frames()) {
  int anchor = 0;
  for (int f = 0; f < 2; ++f) {
    for (const Contact& contact : scene.contacts[f]) {
      for (int t = contact.first; t <= contact.last; ++t) {
        planted_[t].push_back({f, contact.node, anchor});
      }
      ++anchor;
    }
  }
}

void FootLock::Evaluate(const Frame& frame, Rows* rows) const {
  for (const Planted& foot : planted_[frame.t]) {
    const Vec3& p = frame.posed[foot.figure].node[foot.node];
    const auto anchor = frame.anchor->col(foot.anchor);
    for (int k = 0; k < 3; ++k) {
      const int row = rows->Add(p[k] - anchor[k]);
      rows->AddNode(row, foot.figure, foot.node, Vec3::Unit(k));
      rows->AddAnchor(row, foot.anchor, k, -1);
    }
  }
}

}  // namespace retarget
