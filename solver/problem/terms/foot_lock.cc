#include "solver/problem/terms/foot_lock.h"

namespace retarget::solver {

FootLock::FootLock(const Scene& scene) : planted_(scene.num_frames()) {
  int anchor = 0;
  for (int f = 0; f < 2; ++f) {
    for (const Contact& contact : scene.contacts[f]) {
      double height = 0;
      for (int t = contact.first; t <= contact.last; ++t) {
        height += PoseBody(scene.body[f], scene.source[f].frames[t]).node[contact.node].y();
      }
      height /= contact.last - contact.first + 1;
      for (int t = contact.first; t <= contact.last; ++t) {
        planted_[t].push_back({f, contact.node, anchor, height});
      }
      ++anchor;
    }
  }
}

void FootLock::Evaluate(const Frame& frame, Rows* rows) const {
  for (const Planted& foot : planted_[frame.t]) {
    const Vec3& p = frame.posed[foot.figure].node[foot.node];
    const auto anchor = frame.anchor->col(foot.anchor);
    const Vec3 place(anchor[0], foot.height, anchor[1]);
    for (int k = 0; k < 3; ++k) {
      const int row = rows->Add(p[k] - place[k]);
      rows->AddNode(row, foot.figure, foot.node, Vec3::Unit(k));
      if (k != 1) rows->AddAnchor(row, foot.anchor, k / 2, -1);
    }
  }
}

}  // namespace retarget::solver
