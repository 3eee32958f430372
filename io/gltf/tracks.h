// The tracks of a glTF animation: values over time, and at which times to take them. Inner part of
// io/gltf/clip.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/gltf/accessor.h"
#include "model/geometry/types.h"

namespace retarget::io {

// One animated property of a node. Before the first key and after the last it holds their values.
struct GltfTrack {
  enum class Kind { kLinear, kStep, kCubic };
  Kind kind = Kind::kLinear;
  std::vector<double> times;   // [keys] s, ascending
  std::vector<double> values;  // [keys x width], of splines [keys x 3 x width]: tangents in between
  size_t width = 3;            // 4: a unit quaternion x, y, z, w

  // Value of key `k`, without its tangents.
  const double* Key(size_t k) const;
  Vec3 Translation(double time) const;
  Quat Rotation(double time) const;
  // Whether all keys have the first one's value, within `tolerance` per number, and no curve leaves
  // it in between.
  bool IsConstant(double tolerance) const;
};

// Tracks by node; an absent one is not animated.
struct GltfTracks {
  std::map<int, GltfTrack> translation, rotation, scale;
};

// Reads what moves nodes; other channels (weights, pointers) are left aside. Throws InputError
// where a key is not what it should be; quaternions a little off unit length are mended and noted.
GltfTracks ReadTracks(const tinygltf::Animation& animation, GltfAccessors* accessors,
                      const std::string& name, std::vector<std::string>* notes);

// Times of the frames of a motion: every track's keys where these lie evenly, else an even grid at
// the highest rate found, or at a multiple of it that meets all keys, at most 240 per second.
// Splines and steps slower than 30 per second get a multiple of their rate, because frames are
// joined by straight lines.
struct FrameTimes {
  std::vector<double> times;  // s
  double frame_time = 1.0 / 30;
  bool are_keys = false;  // all frames stand at keys and all keys at frames
};
FrameTimes ChooseFrameTimes(const std::vector<const GltfTrack*>& tracks, const std::string& name);

}  // namespace retarget::io
