// The way over the floor that a clip "in place" has lost: its feet stride, its root stays. Such a
// clip is as if walked on a treadmill, whose speed is that of the standing foot.
#pragma once

#include <vector>

#include "model/body/body.h"
#include "model/body/pose.h"
#include "model/settings.h"

namespace retarget {

struct Travel {
  // Horizontal, per frame from the first (m): added to the root, standing feet stand. Empty where
  // the feet do not say clearly that it is missing.
  std::vector<Vec3> offset;
  double speed = 0;          // mean (m/s)
  double sliding_speed = 0;  // of the lowest foot node as captured, median (m/s)
  bool clear() const { return !offset.empty(); }
};

// Clear it is where the lowest foot slides fast and nowhere comes to rest, the root goes almost
// nowhere, and with the offset the feet come to rest in a good part of the frames.
Travel FindTravel(const Body& body, const Clip& clip, const ContactSettings& settings);

}  // namespace retarget
