// What feet do outside their contacts, and where contacts begin and end (docs/metrics.md).
#pragma once

#include <vector>

#include "solver/metrics/metrics_context.h"

namespace retarget::solver {

// A foot node counts as near the floor while its capsule's lowest point is under this (m).
inline constexpr double kNearFloor = 0.06;

// A run of frames in which a foot node is in no contact, and how far it travels over the floor near
// it, from the end of the contact before to the begin of the next.
struct Swing {
  int node = 0;
  int first = 0, last = 0;  // frames outside, both included
  double travel_m = 0;
  double source_m = 0;  // the same swing of the source
};

// The first or last frame of a contact inside the clip.
struct ContactEdge {
  int node = 0;
  int frame = 0;
  double acceleration = 0;  // m/s^2, largest within kEdgeReach frames either way
  double source = 0;        // the same of the source
};
inline constexpr int kEdgeReach = 4;

// Swings of the foot nodes of one figure that come near the floor in the motion or in the source.
// `motion` and `source`: node places per frame.
std::vector<Swing> MeasureSwings(const MetricsContext& subject, int figure,
                                 const std::vector<NodePositions>& motion,
                                 const std::vector<NodePositions>& source);

std::vector<ContactEdge> MeasureEdges(const MetricsContext& subject, int figure, double fps,
                                      const std::vector<NodePositions>& motion,
                                      const std::vector<NodePositions>& source);

}  // namespace retarget::solver
