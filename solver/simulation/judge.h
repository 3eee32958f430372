// What became of a simulation that ran to its end: whether it kept the tags, went through limbs, or
// strayed. It decides whether the run can be a start of the solve.
#pragma once

#include "solver/simulation/simulation.h"

namespace retarget::solver {

// Where a root was furthest from where the control wanted it.
struct Stray {
  double share = 0, distance_m = 0;  // share of the stature
  int figure = 0, frame = 0;
};

// Sets status and message of a result whose other members are complete; one that broke off keeps
// its status.
void ClassifySimulation(const Scene& scene, const Stray& stray, SimulationResult* result);

}  // namespace retarget::solver
