// The paper's forward simulation (Ho and Komura 2007, section 5): both figures as rigid bodies with
// gravity, joint torques towards the captured motion, tangle forces, contacts, and holds and
// planted feet as constraints,
//   M qdd = V + G + tau_PD + tau_tangle + tau_collision,  0 = C qdd + Cdot qdot   (Eq. 4, 5).
// It starts in the template posture, settles towards the frame that is laid into the template until
// it rests, then plays the clips from there to the end and, where the template does not lie at the
// beginning, from there back to the beginning. Its motion is the baseline that the spacetime solve
// is compared with, and one of the starts it can take.
#pragma once

#include <array>
#include <string>

#include "model/settings.h"
#include "solver/problem/scene.h"

namespace retarget::solver {

enum class SimulationStatus {
  kCompleted,
  kDiverged,
  kFell,
  kLostTangle,
  kPassedThrough,
  kTrackingLost
};
const char* NameOf(SimulationStatus status);

struct SimulationResult {
  std::array<Clip, 2> motion;  // as many frames as the scene; where it broke off, the last held
  SimulationStatus status = SimulationStatus::kCompleted;
  std::string message;  // one sentence: how it went
  int frame = -1;       // that the message names; -1: none
  double settle_s = 0;  // simulated, until at rest
  bool settled = false;
  double settle_distance_m = 0;  // mean distance of a node from the template posture when at rest
  int frames_simulated = 0;
  double seconds = 0;    // spent
  double simulated = 0;  // s of simulated time
};

// Never throws for what happens in the simulated world: a run that diverges, falls, strays or loses
// its hold says so in `status`.
SimulationResult Simulate(const Scene& scene, const SimulationSettings& settings);

}  // namespace retarget::solver
