// What a two-figure motion shows frame by frame, from geometry alone: the curves of the report, and
// what the metrics are the extremes of (definitions: docs/metrics.md).
#pragma once

#include <array>
#include <vector>

#include "solver/metrics/metrics_context.h"

namespace retarget::solver {

// Overlap of two capsules, each named by its segment's outer node.
struct Overlap {
  double depth_m = 0;  // 0: none
  int node_1 = 0, node_2 = 0;
};

struct FigureValues {
  Overlap self_penetration;
  double floor_m = 0;  // of the lowest capsule point below the floor
  int floor_node = 0;
  double length_error_percent = 0;  // largest of the segments, neck-shoulder exempt
};

// What one instant shows, or the worst of several.
struct InstantMetrics {
  std::vector<double> gli;  // s GLI per tag (turns)
  Overlap penetration;      // deepest between the bodies: node_1 of a, node_2 of b
  std::vector<double> hold_m;
  std::array<FigureValues, 2> figure;
};

// A limb went through a limb between this frame and the next.
struct PassThrough {
  int frame = 0;
  int node_a = 0, node_b = 0;
};

// How far the joint that ends at a node turns beyond its limits, or beyond the source where that
// goes further (deg); 0: within.
struct BeyondLimit {
  double deg = 0;
  int node = 0;
};

struct FrameMetrics {
  double fps = 30;
  std::vector<InstantMetrics> at;       // the frames
  std::vector<InstantMetrics> between;  // worst of the instants between a frame and the next, one
                                        // fewer; self-penetration is not looked for there
  std::vector<PassThrough> pass_throughs;
  // Largest speed of a planted node since the frame before (m/s); 0 where nothing is planted.
  std::array<std::vector<double>, 2> foot_speed;
  // Turn of each of TrackedJoints against the source (deg). [joints][frames]
  std::array<std::vector<std::vector<double>>, 2> tracking_deg;
  std::array<std::vector<BeyondLimit>, 2> beyond_limit;  // the worst joint of each frame
  std::vector<NodePositions> node;

  int num_frames() const { return static_cast<int>(at.size()); }
};

// Measures `motion` at its frames and at three instants between each two; `source` (the placed,
// unedited clips) is what joints are compared with.
FrameMetrics MeasureFrames(const MetricsContext& subject, const MotionView& motion,
                           const MotionView& source);

// The nodes whose carrying link differs from their parent node's, one per joint.
std::vector<int> TrackedJoints(const Body& body);

// Speed (m/s) of a planted node from frame t - 1 to t, t in (contact.first, contact.last].
double PlantedSpeed(const FrameMetrics& series, int figure, const Contact& contact, int t);

}  // namespace retarget::solver
