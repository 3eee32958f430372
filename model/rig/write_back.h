// Puts an edited motion back onto the rig it came from, at the rig's own key rate.
#pragma once

#include <functional>

#include "model/body/pose.h"
#include "model/rig/binding.h"

namespace retarget {

// The edit between two clips of one body, at any instant: rotation vectors per joint and the root's
// translation, by Catmull-Rom splines through the frames. With equal clips it is exactly zero.
class EditCurve {
 public:
  EditCurve(const Clip& before, const Clip& after);
  // `pose` with the edit at `time` (s from the first frame) applied.
  Pose Apply(const Pose& pose, double time) const;
  bool is_zero() const { return is_zero_; }

 private:
  double fps_;
  bool is_zero_ = true;
  std::vector<std::vector<Vec3>> edit_;  // [frames][1 + links]: translation, then rotation vectors
};

// A captured frame with a solved posture in place of its own (RigBinding::Fitted), and what does
// not hang from the root placed with the figure: `place`, a rigid motion, lays a captured pose into
// the scene.
RigFrame WrittenFrame(const RigBinding& binding, const RigFrame& captured,
                      const std::function<Pose(const Pose&)>& place, const Pose& solved);

// The solved motion on the rig, keyed at the rig's own rate over the solved span: key i at
// `start` + i * frame_time of the captured motion. `place` lays a captured pose into the scene;
// `source` is the placed clip at the output rate and `solved` the result. Where they differ the
// rig's joints are brought to the solved body's nodes (RigBinding::Fitted), also where the captured
// ones stood apart from it; a motion that is not edited at all comes back just as it was.
RigMotion WriteBack(const RigMotion& captured, const RigBinding& binding, double start,
                    const std::function<Pose(const Pose&)>& place, const Clip& source,
                    const Clip& solved);

}  // namespace retarget
