// What the words of a joint's name say, in any order and under any marks: side and part of the
// body. Inner part of io/recognition/joint_profiles.h, for rigs that follow no known convention.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

enum class BodyPart {
  kNone,    // the words name no part of the body
  kHelper,  // twist, IK target, end, finger of a toe, hair: a bone that plays no joint
  kTrunk,
  kNeck,
  kHead,
  kClavicle,
  kShoulder,  // "shoulder": the collar bone or the upper arm
  kArm,       // "arm": the upper arm or, after a shoulder, the forearm
  kUpperArm,
  kForearm,
  kWrist,
  kHand,
  kMiddleFinger,
  kFinger,
  kHip,  // "left hip": the thigh, or a bone above it
  kThigh,
  kLeg,  // "leg": the thigh or the shin
  kShin,
  kAnkle,
  kFoot,  // "foot": the ankle or, after an ankle, the toe
  kToe
};

enum class BodySide { kNone, kLeft, kRight };

struct JointWords {
  BodyPart part = BodyPart::kNone;
  BodySide side = BodySide::kNone;
};

// "L_armUpper0001_bind_JNT": a left upper arm.
JointWords ReadJointWords(std::string_view name);
std::vector<JointWords> ReadJointWords(const Rig& rig);

}  // namespace retarget::io
