#include "model/rig/t_pose_frame.h"

#include "model/body/body.h"
#include "model/body/pose.h"

namespace retarget {

RigFrame TPoseFrame(const Rig& rig, const RigBinding& binding, const Vec3& place) {
  const Body& body = binding.body();
  Pose pose = RestPose(body);
  const PosedBody posed = PoseBody(body, pose);
  const double ankles =
      (posed.node[body.FindNode("left_ankle")].y() + posed.node[body.FindNode("right_ankle")].y()) /
      2;
  pose.root_position +=
      Vec3(place.x() - pose.root_position.x(), kAnkleHeight * body.stature - ankles,
           place.z() - pose.root_position.z());
  RigFrame rest;
  for (const RigJoint& joint : rig.joints) {
    rest.translation.push_back(joint.offset);
    rest.rotation.push_back(joint.rest_rotation);
  }
  return binding.Apply(rest, pose);
}

}  // namespace retarget
