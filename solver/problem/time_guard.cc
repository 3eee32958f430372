#include "solver/problem/time_guard.h"

#include "solver/problem/parallel.h"

namespace retarget::solver {

Way WayBetween(const Scene& scene, const MatX& edit, int from, int to) {
  std::array<Pose, 2> before, after;
  for (int f = 0; f < 2; ++f) {
    EditedPose(scene, f, from, edit, &before[f]);
    EditedPose(scene, f, to, edit, &after[f]);
  }
  return WayBetween(scene.body, before, after);
}

std::vector<char> FramesThatGoThrough(const Scene& scene, const MatX& edit,
                                      const std::vector<NodePositions>& nodes, bool dips,
                                      int threads) {
  std::vector<char> through(nodes.empty() ? 0 : nodes.size() - 1, 0);
  ParallelFor(static_cast<int>(through.size()), threads, [&](int t, int) {
    if (!MayMeetOnTheWay(scene.body, nodes[t], nodes[t + 1])) return;
    const Way way = WayBetween(scene, edit, t, t + 1);
    through[t] = dips ? !way.IsClear() : way.jump.size > kPassThroughGli;
  });
  return through;
}

}  // namespace retarget::solver
