// One player per format. Inner part of io/playback/playback.h.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "io/playback/playback.h"

namespace retarget::io::playback {

using Affine = Eigen::Affine3d;

struct LocalTransform {
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();
};
Affine Between(const LocalTransform& a, const LocalTransform& b, double share);

// Of each joint its node, or the first of `names` that is its own. Throws InputError.
std::vector<int> IndicesOf(const std::vector<PlayedJoint>& joints,
                           const std::vector<std::string>& names, const std::string& file);

// Frames at an even rate. `parent` [joints], before its children; `frames` [frames][joints].
Played PlayFrames(const std::vector<int>& parent,
                  const std::vector<std::vector<LocalTransform>>& frames, double frame_time,
                  const std::vector<int>& joints, const std::vector<double>& times);

Played PlayBvh(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
               const std::vector<double>& times);
Played PlayAcclaim(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
                   const std::vector<double>& times);
Played PlayGltf(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
                const std::vector<double>& times);

}  // namespace retarget::io::playback
