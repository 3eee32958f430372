#include "io/playback/playback.h"

#include "io/playback/players.h"

namespace retarget::io {

Played Play(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
            const std::vector<double>& times) {
  if (file.format == "glTF") return playback::PlayGltf(file, joints, times);
  if (file.format == "Acclaim") return playback::PlayAcclaim(file, joints, times);
  return playback::PlayBvh(file, joints, times);
}

namespace playback {

Affine Between(const LocalTransform& a, const LocalTransform& b, double share) {
  const Vec3 t = (1 - share) * a.translation + share * b.translation;
  const Quat q = share == 0 ? a.rotation : a.rotation.slerp(share, b.rotation);
  const Vec3 s = (1 - share) * a.scale + share * b.scale;
  return Eigen::Translation3d(t) * q * Eigen::Scaling(s);
}

std::vector<int> IndicesOf(const std::vector<PlayedJoint>& joints,
                           const std::vector<std::string>& names, const std::string& file) {
  std::vector<int> out;
  for (const PlayedJoint& joint : joints) {
    int found = joint.node < static_cast<int>(names.size()) ? joint.node : -1;
    for (size_t n = 0; n < names.size() && found < 0; ++n) {
      if (names[n] == joint.name) found = static_cast<int>(n);
    }
    if (found < 0) throw InputError(file + ": has no joint " + joint.name);
    out.push_back(found);
  }
  return out;
}

Played PlayFrames(const std::vector<int>& parent,
                  const std::vector<std::vector<LocalTransform>>& frames, double frame_time,
                  const std::vector<int>& joints, const std::vector<double>& times) {
  Played out;
  const double last = static_cast<double>(frames.size()) - 1;
  out.seconds = last * frame_time;
  for (const double time : times) {
    double at = std::min(std::max(time / frame_time, 0.0), last);
    // A time that is a key's but for rounding.
    if (std::abs(at - std::round(at)) < 1e-6) at = std::round(at);
    const size_t k = static_cast<size_t>(at);
    const size_t next = std::min(k + 1, frames.size() - 1);
    std::vector<Affine> world(parent.size());
    for (size_t j = 0; j < parent.size(); ++j) {
      const Affine own = Between(frames[k][j], frames[next][j], at - static_cast<double>(k));
      world[j] = parent[j] < 0 ? own : world[static_cast<size_t>(parent[j])] * own;
    }
    out.position.emplace_back();
    for (const int j : joints) {
      out.position.back().push_back(world[static_cast<size_t>(j)].translation());
    }
  }
  return out;
}

}  // namespace playback
}  // namespace retarget::io
