// The field's metrics of a two-figure motion, from geometry alone (definitions: docs/metrics.md).
#pragma once

#include <array>
#include <vector>

#include "solver/metrics/frame_metrics.h"

namespace retarget::solver {

struct TangleMetrics {
  double min_signed_gli = 0;          // over the frames (turns)
  double min_signed_gli_between = 0;  // the same at 4x sub-sampling
  int frames_below_half = 0;
  int worst_frame = 0;
};

struct FigureMetrics {
  double self_penetration_m = 0;
  double floor_m = 0;
  int floor_frame = 0, floor_node = 0;
  double foot_drift_m = 0;
  int foot_drift_frame = 0, foot_drift_node = 0;
  double foot_speed_max = 0;               // m/s, inside contacts
  double foot_speed_over_1cm_percent = 0;  // of stance frames
  double pose_error_cm = 0;                // mean over nodes of no tagged path
  double joint_edit_deg = 0;               // mean over nodes' links and frames
  double jerk = 0;                         // m/s^3
  double jerk_ratio_own = 1;               // to its own source
  double jerk_ratio_larger = 1;            // to the larger of the two sources
  double length_error_percent = 0;         // of segments, neck-shoulder exempt
  std::vector<double> path_m;              // per node, relative to the root
};

struct Metrics {
  std::vector<TangleMetrics> tangles;
  double tangle_kept_percent = 100;  // frames in which every tag is above one half
  double smallest_gli = 0;           // over all tags and frames; 0 without tags
  double smallest_gli_between = 0;
  std::vector<PassThrough> pass_throughs;
  double penetration_m = 0;          // largest, frames
  double penetration_between_m = 0;  // largest, 4x
  int penetration_frame = 0;
  int penetration_node_a = 0, penetration_node_b = 0;
  double penetration_over_1cm_percent = 0;  // of frames
  std::vector<double> hold_m;               // largest error per hold
  std::vector<int> hold_frame;
  std::array<FigureMetrics, 2> figure;
};

// Measures `motion`; `source` (the placed, unedited clips) is what edits and jerk are compared
// with.
Metrics Measure(const MetricsContext& subject, const MotionView& motion, const MotionView& source);
// The same from a series that has been measured already, and the source's node places per frame.
Metrics MetricsOf(const MetricsContext& subject, const FrameMetrics& series,
                  const std::vector<NodePositions>& source);

}  // namespace retarget::solver
