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
  double stride_m = 0;  // how much further apart than in the source its two footprints are (or
                        // the places at the clip's ends)
};

// The first or last frame of a contact inside the clip.
struct ContactEdge {
  int node = 0;
  int frame = 0;
  double acceleration = 0;  // m/s^2, largest within kEdgeReach frames either way
  double source = 0;        // the same of the source
  double stride_m = 0;      // of the swing that it ends or begins
  double swing_s = 0;       // the time from footprint to footprint
  double led_m_s = 0;       // how much faster than in the source the root moves over the floor
};

// What a longer stride itself asks for: this share of it passes near the floor under a foot that is
// lifted for it, and so much acceleration, times length over time squared, a movement of least jerk
// from rest to rest (T. Flash and N. Hogan, "The coordination of arm movements", 1985: 10 / sqrt
// 3).
inline constexpr double kStrideNearFloor = 0.25;
inline constexpr double kStrideAcceleration = 5.7735;
// What being led along asks for (1/s): a swinging foot is about 2.4 times as fast as its body, and
// takes up that speed within kEdgeReach frames of a thirtieth of a second.
inline constexpr double kLedAcceleration = 18;
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
