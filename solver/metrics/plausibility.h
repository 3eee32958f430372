// What a person could not do, or would not have done: how far a motion is from what was captured
// where that says that the clip does not suit the template. Definitions: docs/metrics.md.
#pragma once

#include <limits>
#include <vector>

#include "solver/metrics/frame_metrics.h"

namespace retarget::solver {

// The largest value of a clip, with frame and node; NaN: there was nothing to measure.
struct WorstAt {
  double value = std::numeric_limits<double>::quiet_NaN();
  int frame = -1;
  int node = 0;
};

struct Plausibility {
  WorstAt pose_error_m;     // mean over the nodes of no tagged path, of a frame; node: the furthest
  WorstAt trunk_tilt_deg;   // of root to neck against the source; not of a carried figure
  WorstAt floating_m;       // of the lowest point over the floor, or over the source's; likewise
  WorstAt joint_limit_deg;  // beyond the end of a joint's range, or beyond the source's own value
  WorstAt jerk_ratio;       // mean jerk to its own source's; frame and node of the largest jerk
};

// A source that hardly moves is taken for one of this jerk (m/s^3): mean of a person who stands
// still, as captured.
inline constexpr double kStillJerk = 20;

// The nodes over which pose errors are averaged: those of no tagged path, or all but the root where
// every one is on such a path.
std::vector<int> UntaggedNodes(const MetricsContext& subject, int figure);
// Mean over nodes and frames of the norm of the third difference (m/s^3); NaN under four frames.
double MeanJerk(const std::vector<NodePositions>& frames, int figure, double fps);

// Of a figure, against the source's node places per frame.
Plausibility MeasurePlausibility(const MetricsContext& subject, int figure,
                                 const FrameMetrics& series,
                                 const std::vector<NodePositions>& source);

}  // namespace retarget::solver
