// Indices of the standard body's links, in the order of model/body/body.cc.
#pragma once

namespace retarget {

enum StandardLink {
  kRoot,
  kWaist,
  kChest,
  kNeck,
  kHead,
  kLeftClavicle,
  kLeftShoulder,
  kLeftElbow,
  kLeftWrist,
  kRightClavicle,
  kRightShoulder,
  kRightElbow,
  kRightWrist,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kNumLinks
};

}  // namespace retarget
