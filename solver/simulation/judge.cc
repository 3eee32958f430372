#include "solver/simulation/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/body/pass_through.h"
#include "model/body/path.h"

namespace retarget::solver {
namespace {

// A root that is as far off its target as that of a figure that fell, in any direction (share of
// the stature; kFallen of simulation.cc).
constexpr double kTrackingLost = 0.35;
// A tag is lost where its s GLI stays below half of what counts as tangled ...
constexpr double kLostGli = 0.5 * kTangleThreshold;  // turns
// ... from some frame to either end of the clip, for at least this long: at the ends a tangle may
// just be closing or opening.
constexpr double kLostTime = 0.5;  // s

void Stop(SimulationResult* result, SimulationStatus status, const std::string& message,
          int frame) {
  result->status = status;
  result->message = message;
  result->frame = frame;
}

std::array<PosedBody, 2> PosedAt(const Scene& scene, const SimulationResult& result, int t) {
  return {PoseBody(scene.body[0], result.motion[0].frames[t]),
          PoseBody(scene.body[1], result.motion[1].frames[t])};
}

// Lost for good: gone from some frame to either end of the clip.
void ClassifyTags(const Scene& scene, SimulationResult* result) {
  const int least = static_cast<int>(std::ceil(kLostTime * scene.fps()));
  for (const TangleTarget& held : scene.tangles) {
    const auto lost_at = [&](int t) {
      const std::array<PosedBody, 2> posed = PosedAt(scene, *result, t);
      return held.sign * GliOfPaths(scene.body[0], posed[0].node, held.tag.tangle.a, scene.body[1],
                                    posed[1].node, held.tag.tangle.b) <
             kLostGli;
    };
    int first = scene.num_frames(), last = -1;
    while (first > 0 && lost_at(first - 1)) --first;
    while (last + 1 < first && lost_at(last + 1)) ++last;
    const bool at_end = scene.num_frames() - first >= std::min(least, scene.num_frames());
    if (!at_end && last + 1 < least) continue;
    Stop(result, SimulationStatus::kLostTangle,
         "it lost the tag " + TangleText(scene.body[0], scene.body[1], held.tag.tangle) +
             " for good " +
             (at_end ? "at frame " + std::to_string(first)
                     : "before frame " + std::to_string(last + 1)),
         at_end ? first : last + 1);
    return;
  }
}

void ClassifyPassThroughs(const Scene& scene, SimulationResult* result) {
  const auto poses_at = [&](int t) -> std::array<Pose, 2> {
    return {result->motion[0].frames[t], result->motion[1].frames[t]};
  };
  for (int t = 1; t < scene.num_frames(); ++t) {
    const GliJump jump = WayBetween(scene.body, poses_at(t - 1), poses_at(t)).jump;
    if (jump.size > kPassThroughGli) {
      Stop(result, SimulationStatus::kPassedThrough,
           scene.body[0].nodes[jump.node_a].name + " of a went through " +
               scene.body[1].nodes[jump.node_b].name + " of b at frame " + std::to_string(t),
           t);
      return;
    }
  }
}

// A figure that stumbled and is dragged along shows nothing of its motion: no start for a solve.
void ClassifyStray(const Stray& stray, SimulationResult* result) {
  if (stray.share < kTrackingLost) return;
  char text[100];
  std::snprintf(text, sizeof text, "%s strayed %.2f m from its way at frame %d",
                stray.figure == 0 ? "a" : "b", stray.distance_m, stray.frame);
  Stop(result, SimulationStatus::kTrackingLost, text, stray.frame);
}

}  // namespace

void ClassifySimulation(const Scene& scene, const Stray& stray, SimulationResult* result) {
  const auto fine = [&] { return result->status == SimulationStatus::kCompleted; };
  if (!fine()) {
    result->message += "; " + std::to_string(result->frames_simulated) + " of " +
                       std::to_string(scene.num_frames()) + " frames were simulated";
    return;
  }
  ClassifyTags(scene, result);
  if (fine()) ClassifyPassThroughs(scene, result);
  if (fine()) ClassifyStray(stray, result);
  if (fine()) result->message = "it ran to the end";
}

}  // namespace retarget::solver
