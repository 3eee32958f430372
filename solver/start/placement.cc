#include "solver/start/placement.h"

#include <algorithm>
#include <limits>

#include "model/body/shape.h"
#include "model/geometry/so3.h"

namespace retarget::solver {

Pose Placed(const Pose& pose, const Placement& placement) {
  return Moved(pose, YawRotation(placement.yaw), placement.shift);
}

Clip Placed(const Clip& clip, const Placement& placement) {
  Clip out = clip;
  for (Pose& pose : out.frames) pose = Placed(pose, placement);
  return out;
}

Placement PlaceAt(const Body& body, const Clip& clip, int frame, const Pose& target,
                  const std::vector<Contact>& contacts) {
  const Pose& pose = clip.frames[frame];
  Placement placement;
  placement.yaw = YawOf(target.rotation[0] * pose.rotation[0].conjugate());
  placement.shift = target.root_position - YawRotation(placement.yaw) * pose.root_position;
  placement.shift.y() = 0;
  const std::vector<double> radius = NodeRadii(body);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Contact& contact : contacts) {
    for (int t = contact.first; t <= contact.last; ++t) {
      const PosedBody posed = PoseBody(body, clip.frames[t]);
      lowest = std::min(lowest, posed.node[contact.node].y() - radius[contact.node]);
    }
  }
  if (std::isfinite(lowest)) placement.shift.y() = -lowest;
  return placement;
}

}  // namespace retarget::solver
