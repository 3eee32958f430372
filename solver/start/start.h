// The initial guess of the spacetime solve that needs no simulation.
#pragma once

#include <array>

#include "solver/problem/problem.h"

namespace retarget::solver {

// The template-relative start: the template posture, carried frame by frame through the clip. The
// pair is laid into the template at scene.template_frame; from there a quasi-static pass
// (solver/start/quasi_static.h) goes outwards, each frame starting where its neighbour ended.
Unknowns TemplateStart(const Problem& problem);

// Both figures in the template posture relative to each other in every frame, carried along by the
// mean of the two clips' root motions (or by the leader's, where one follows its partner); joints
// that no tag or hold depends on as captured.
std::array<Clip, 2> TemplateRelativePoses(const Scene& scene);

}  // namespace retarget::solver
