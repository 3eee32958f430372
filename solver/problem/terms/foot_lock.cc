#include "solver/problem/terms/foot_lock.h"

#include <algorithm>

namespace retarget::solver {

FootLock::FootLock(const Scene& scene) {
  for (int f = 0; f < 2; ++f) {
    for (const Contact& contact : scene.contacts[f]) {
      double height = 0;
      for (int t = contact.first; t <= contact.last; ++t) {
        height += PoseBody(scene.body[f], scene.source[f].frames[t]).node[contact.node].y();
      }
      height /= contact.last - contact.first + 1;
      planted_.push_back({f, contact, height});
    }
  }
}

int FootLock::row_slots(const Frame& frame) const {
  const auto stands = [&](const Planted& foot) { return foot.Stands(frame.t); };
  return 3 * static_cast<int>(std::count_if(planted_.begin(), planted_.end(), stands));
}

void FootLock::EvaluatePart(const Frame& frame, int anchor, Rows* rows) const {
  const Planted& foot = planted_[static_cast<size_t>(anchor)];
  if (!foot.Stands(frame.t)) return;
  const Vec3& p = frame.posed[foot.figure].node[foot.contact.node];
  const auto at = frame.anchor->col(anchor);
  const Vec3 place(at[0], foot.height, at[1]);
  for (int k = 0; k < 3; ++k) {
    const int row = rows->Add(p[k] - place[k]);
    rows->AddNode(row, foot.figure, foot.contact.node, Vec3::Unit(k));
    if (k != 1) rows->AddAnchor(row, anchor, k / 2, -1);
  }
}

}  // namespace retarget::solver
