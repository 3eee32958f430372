#include "solver/problem/terms/pose_tracking.h"

namespace retarget::solver {

PoseTracking::PoseTracking(const Scene& scene, const JointWeights& weights) {
  for (int f = 0; f < 2; ++f) {
    for (const Link& link : scene.body[f].links) {
      share_[f].push_back(JointShare(weights, link.name));
    }
  }
}

void PoseTracking::EvaluatePart(const Frame& frame, int, Rows* rows) const {
  for (int f = 0; f < 2; ++f) {
    const int first = frame.scene->FirstCoordinate(f);
    for (size_t l = 1; l < share_[f].size(); ++l) {
      for (int k = 0; k < 3; ++k) {
        const int c = first + 3 + 3 * static_cast<int>(l) + k;
        rows->AddCoordinate(c, share_[f][l] * frame.x[c], share_[f][l]);
      }
    }
  }
}

}  // namespace retarget::solver
