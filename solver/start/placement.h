// Lays a clip into the template's world: a turn about the vertical, a horizontal shift, and a
// constant height at which the lowest planted foot capsule stands on the floor.
#pragma once

#include <vector>

#include "model/body/contact.h"
#include "model/body/pose.h"

namespace retarget::solver {

struct Placement {
  double yaw = 0;             // rad
  Vec3 shift = Vec3::Zero();  // m, after the turn
};

Pose Placed(const Pose& pose, const Placement& placement);
Clip Placed(const Clip& clip, const Placement& placement);

// The placement that brings frame `frame` of the clip to `target`: same heading of the root, same
// horizontal place.
Placement PlaceAt(const Body& body, const Clip& clip, int frame, const Pose& target,
                  const std::vector<Contact>& contacts);

}  // namespace retarget::solver
