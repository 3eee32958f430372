// How well the clips of a job fit its template, told before the solve: what differs, and which
// other instant or side would fit better.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/load_clip.h"
#include "solver/retarget.h"
#include "solver/start/clip_fit.h"
#include "tools/report/report.h"

namespace retarget::api {

struct FigureFit {
  solver::PostureDistance distance;  // at the instant that is laid into the template
  bool fits = true;                  // trunk and legs are as the figure's
  std::vector<std::string> differs;  // "stands where figure b lies"
  double best_at_s = 0;              // nearest instant of the solved frames, s from the starts
  double best_start_s = 0;           // nearest instant of the whole clip, s into it
  double best_distance = 0, best_start_distance = 0;  // there (PostureDistance::value)
  std::string sentence;                               // all of it; empty where nothing is wrong
};

struct JobFit {
  std::array<FigureFit, 2> figure;
  bool mirrored_fits_better = false;
  std::vector<std::string> warnings;  // for both clips, those of the solver first
};

// `offset_s`: of the first solved frame from the starts. Words: what messages call the options.
JobFit FitOfJob(const solver::RetargetInput& input, const std::array<io::LoadedClip, 2>& clips,
                const TangleSettings& settings, double offset_s, const std::string& template_at);

report::Json JobFitJson(const JobFit& fit);

}  // namespace retarget::api
