// The solved scene as data: what `Request::also` asks for (docs/data_out.md).
#pragma once

#include <string>

#include "solver/metrics/frame_metrics.h"
#include "solver/retarget.h"

namespace retarget::api {

// Positions, rotations, contacts, tags and names of both figures as arrays (a .npz of numpy's).
std::string FormatSceneNpz(const solver::RetargetResult& result,
                           const solver::FrameMetrics& series);

// Node positions and s GLI of the tags, a line for each frame.
std::string FormatSceneCsv(const solver::RetargetResult& result,
                           const solver::FrameMetrics& series);

}  // namespace retarget::api
