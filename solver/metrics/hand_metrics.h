// Hands that hold or touch: how far from the surface of what they hold they are (docs/metrics.md).
#pragma once

#include <vector>

#include "solver/metrics/metrics_context.h"

namespace retarget::solver {

// A hand that holds, or touches, in the template. Segments are named by their outer nodes.
struct HoldingHand {
  int figure = 0;
  std::vector<int> segments;  // the hand and its forearm
  int to_figure = 0;
  std::vector<int> to;  // what is held: the segments at the held node, or the one that is touched
};

// One for every hold with a hand or wrist at an end (that of `from` first), and one for every hand
// contact. Holds to the world are none.
std::vector<HoldingHand> HoldingHands(const MetricsContext& subject);

// Gap from the surface of the hand or its forearm, the nearer, to the nearest surface of what it
// holds (m); 0 where they touch or overlap.
double HandGap(const MetricsContext& subject, const HoldingHand& hand, const NodePositions& node);

// The 95th percentile of the gap over the frames, largest of a figure's holding hands; NaN where
// none holds (m).
double HoldingHandGap(const MetricsContext& subject, int figure,
                      const std::vector<NodePositions>& frames);

}  // namespace retarget::solver
