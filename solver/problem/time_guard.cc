#include "solver/problem/time_guard.h"

#include "solver/problem/parallel.h"

namespace retarget::solver {
namespace {

// Of GLI from frame to frame (turns). Less cannot hold a pass-through, which changes it by one, but
// where the limbs undo most of that in the same frame; more may be a quick motion, and the instants
// in between decide.
constexpr double kSuspicious = 0.25;

std::array<Pose, 2> PosesAt(const Scene& scene, const Unknowns& unknowns, int t) {
  std::array<Pose, 2> poses;
  for (int f = 0; f < 2; ++f) EditedPose(scene, f, t, unknowns.edit, &poses[f]);
  return poses;
}

}  // namespace

bool GoesThroughAfter(const Scene& scene, const Unknowns& unknowns, int t) {
  return LargestGliJumpBetween(scene.body, PosesAt(scene, unknowns, t),
                               PosesAt(scene, unknowns, t + 1))
             .size > kPassThroughGli;
}

std::vector<char> GoesThrough(const Scene& scene, const Unknowns& unknowns,
                              const std::vector<NodePositions>& nodes, int threads) {
  std::vector<char> through(nodes.empty() ? 0 : nodes.size() - 1, 0);
  ParallelFor(static_cast<int>(through.size()), threads, [&](int t, int) {
    through[t] = LargestGliJumpOnTheWay(scene.body, nodes[t], nodes[t + 1]).size > kSuspicious &&
                 GoesThroughAfter(scene, unknowns, t);
  });
  return through;
}

}  // namespace retarget::solver
