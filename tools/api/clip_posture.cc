#include "tools/api/clip_posture.h"

#include <fmt/format.h>

#include "model/geometry/so3.h"

namespace retarget::api {
namespace {

// Upright as it is, over (0, z), with its front along `yaw`.
Pose Facing(const Pose& pose, double yaw, double z) {
  const Quat turn = YawRotation(yaw - YawOf(pose.rotation[0]));
  Vec3 shift = -(turn * pose.root_position);
  shift += Vec3(0, pose.root_position.y(), z);
  return Moved(pose, turn, shift);
}

}  // namespace

TemplatePosture PostureOfFrames(const std::array<const io::LoadedClip*, 2>& clip,
                                const std::array<int, 2>& frame, bool together) {
  TemplatePosture posture;
  posture.name = "from clips";
  for (int f = 0; f < 2; ++f) {
    const RigMotion& motion = clip[f]->file.motion;
    if (frame[f] < 0 || frame[f] >= motion.num_frames()) {
      throw InputError(fmt::format("frame {}: {} has frames 0 to {}", frame[f],
                                   clip[f]->options.path, motion.num_frames() - 1));
    }
    posture.body[f] = clip[f]->body;
    posture.pose[f] = clip[f]->binding->PoseOf(motion.frames[frame[f]]);
    if (!together) posture.pose[f] = Facing(posture.pose[f], f == 0 ? 0 : kPi, f == 0 ? -0.5 : 0.5);
    posture.supports[f] =
        StandingNodes(posture.body[f], PoseBody(posture.body[f], posture.pose[f]));
  }
  return posture;
}

}  // namespace retarget::api
