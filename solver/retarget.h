// The whole way from two clips and a template to a solved scene.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/settings.h"
#include "solver/optimizer/spacetime.h"
#include "solver/simulation/simulation.h"
#include "solver/start/fit_template.h"
#include "solver/start/placement.h"

namespace retarget::solver {

struct RetargetInput {
  std::array<Body, 2> body;
  std::array<Clip, 2> clip;  // as captured (m, Y up), one rate and one number of frames
  TemplatePosture posture;
  int template_frame = 0;  // laid into the template
  // Turns that the clips' own rigs cannot make, per frame; empty where they can make all.
  std::array<std::vector<std::vector<LockedAxis>>, 2> locked_axes = {};
};

// Which initial guess the solve took (solve.start), and why.
struct StartChoice {
  Start requested = Start::kSimulated;
  Start used = Start::kSimulated;  // never kBest
  std::string reason;              // one sentence
  // Cost at the end of the solve from each start that was tried.
  std::optional<double> simulated_cost, template_cost;
};

struct RetargetResult {
  TemplateTangles tangles;
  Scene scene;
  std::array<Placement, 2> placement;
  SimulationResult simulation;  // the baseline
  StartChoice start;
  double start_seconds = 0;  // spent on the initial guess, the simulation left out
  SolveResult solve;
  std::array<Clip, 2> solved;
  std::vector<TermCost> costs;
  std::vector<std::string> warnings;
};

// Fits the template, finds the tangles, places the clips, detects the contacts, simulates, chooses
// a start and solves. Files are not its business.
RetargetResult Retarget(const RetargetInput& input, const Settings& settings,
                        const Progress& progress);

// All but the simulation and the solve: what the problem would be.
RetargetResult Prepare(const RetargetInput& input, const Settings& settings);

}  // namespace retarget::solver
