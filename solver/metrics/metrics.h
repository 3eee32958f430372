// The field's metrics of a two-figure motion, from geometry alone (definitions: docs/metrics.md).
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "solver/metrics/foot_metrics.h"
#include "solver/metrics/frame_metrics.h"
#include "solver/metrics/plausibility.h"

namespace retarget::solver {

// The value of a metric that there is nothing to measure for (NaN): never 0, which would be a
// verdict.
inline constexpr double kNothingMeasured = std::numeric_limits<double>::quiet_NaN();

struct TangleMetrics {
  double min_signed_gli = 0;          // over the frames (turns)
  double min_signed_gli_between = 0;  // the same at 4x sub-sampling
  int frames_below_half = 0;
  int worst_frame = 0;
  double smallest() const { return std::min(min_signed_gli, min_signed_gli_between); }
};

struct FigureMetrics {
  double self_penetration_m = 0;
  double floor_m = 0;
  int floor_frame = 0, floor_node = 0;
  double foot_drift_m = kNothingMeasured;  // of planted nodes; without contacts there is none
  int foot_drift_frame = -1, foot_drift_node = 0;
  double foot_speed_max = kNothingMeasured;               // m/s, inside contacts
  double foot_speed_over_1cm_percent = kNothingMeasured;  // of stance frames
  // 95th percentile over the frames, of the hand that holds or touches and is furthest off
  // (hand_metrics.h)
  double holding_hand_gap_m = kNothingMeasured;
  std::vector<Swing> swings;
  std::vector<ContactEdge> edges;
  double pose_error_cm = kNothingMeasured;      // mean over nodes of no tagged path
  double joint_edit_deg = kNothingMeasured;     // mean over nodes' links and frames
  double jerk = kNothingMeasured;               // m/s^3; needs four frames
  double jerk_ratio_own = kNothingMeasured;     // to its own source, where that has any
  double jerk_ratio_larger = kNothingMeasured;  // to the larger of the two sources
  double length_error_percent = 0;              // of segments, neck-shoulder exempt
  Plausibility plausible;
  std::vector<double> path_m;  // per node, relative to the root
};

struct Metrics {
  std::vector<TangleMetrics> tangles;
  double tangle_kept_percent = kNothingMeasured;  // frames in which every tag is above one half
  double smallest_gli = kNothingMeasured;         // over all tags and frames; none without tags
  double smallest_gli_between = kNothingMeasured;
  std::vector<PassThrough> pass_throughs;
  double penetration_m = 0;          // largest, frames
  double penetration_between_m = 0;  // largest, 4x
  int penetration_frame = 0;
  int penetration_node_a = 0, penetration_node_b = 0;
  double penetration_over_1cm_percent = 0;  // of frames
  double deepest_m() const { return std::max(penetration_m, penetration_between_m); }
  std::vector<double> hold_m;  // largest error per hold
  std::vector<int> hold_frame;
  std::array<FigureMetrics, 2> figure;
};

// The swing whose near-floor travel exceeds its source's by most, and the edge whose acceleration
// is the largest multiple of its source's (of kLeastEdge where that is less); null where there is
// none.
const Swing* WorstSwing(const FigureMetrics& metrics);
const ContactEdge* WorstEdge(const FigureMetrics& metrics);
inline constexpr double kLeastEdge = 3;  // m/s^2: a foot that is set down softly

// Measures `motion`; `source` (the placed, unedited clips) is what edits and jerk are compared
// with.
Metrics Measure(const MetricsContext& subject, const MotionView& motion, const MotionView& source);
// The same from a series that has been measured already, and the source's node places per frame.
Metrics MetricsOf(const MetricsContext& subject, const FrameMetrics& series,
                  const std::vector<NodePositions>& source);

}  // namespace retarget::solver
