// Pose, its forward kinematics, and clips of poses.
#pragma once

#include <vector>

#include "model/body/body.h"
#include "model/geometry/types.h"

namespace retarget {

// Where a body is and how it bends. rotation[0] is the root's rotation in the world; rotation[l] of
// every other link is child in parent, relative to the canonical rest pose.
struct Pose {
  Vec3 root_position = Vec3::Zero();  // m
  std::vector<Quat> rotation;         // one per link
};

// The rest pose of `body`: T-pose at the origin.
Pose RestPose(const Body& body);

// A pose worked out in the world.
struct PosedBody {
  std::vector<Mat3> rotation;  // of every link, link to world
  std::vector<Vec3> centre;    // joint centre of every link (m); [0] is the root
  std::vector<Vec3> node;      // position of every node (m)
};

// Forward kinematics.
PosedBody PoseBody(const Body& body, const Pose& pose);
// The same into existing storage, for inner loops.
void PoseBody(const Body& body, const Pose& pose, PosedBody* out);

// A turn that a link cannot make on the rig that it is for: `direction` is unit, in the link's own
// frame at some pose.
struct LockedAxis {
  int link = 0;
  Vec3 direction = Vec3::UnitX();
};

// A motion at a fixed rate: frame k is at time k / fps.
struct Clip {
  double fps = 30;
  std::vector<Pose> frames;
  int num_frames() const { return static_cast<int>(frames.size()); }
};

// Linear in the root position, shortest-arc spherical-linear in every rotation; u in [0, 1].
Pose Interpolate(const Pose& a, const Pose& b, double u);

// The rigid motion p -> R p + t applied to the whole figure.
Pose Moved(const Pose& pose, const Quat& rotation, const Vec3& translation);

}  // namespace retarget
