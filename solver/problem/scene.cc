#include "solver/problem/scene.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

void EditOf(const Pose& source, const Pose& pose, double* x) {
  Eigen::Map<Vec3> translation(x);
  translation = pose.root_position - source.root_position;
  for (size_t l = 0; l < source.rotation.size(); ++l) {
    Eigen::Map<Vec3> delta(x + 3 + 3 * l);
    delta = LogSo3(source.rotation[l].conjugate() * pose.rotation[l]);
  }
}

void EditedPose(const Pose& source, const double* x, Pose* pose) {
  pose->root_position = source.root_position + Eigen::Map<const Vec3>(x);
  pose->rotation.resize(source.rotation.size());
  for (size_t l = 0; l < source.rotation.size(); ++l) {
    pose->rotation[l] = source.rotation[l] * ExpSo3(Eigen::Map<const Vec3>(x + 3 + 3 * l));
  }
}

Unknowns UnknownsFromPoses(const Scene& scene, const std::array<Clip, 2>& poses) {
  Unknowns u;
  u.edit.resize(scene.num_coordinates(), scene.num_frames());
  u.anchor.setZero(2, static_cast<long>(scene.contacts[0].size() + scene.contacts[1].size()));
  int anchor = 0;
  for (int f = 0; f < 2; ++f) {
    std::vector<PosedBody> posed(scene.num_frames());
    for (int t = 0; t < scene.num_frames(); ++t) {
      EditOf(scene.source[f].frames[t], poses[f].frames[t],
             u.edit.col(t).data() + scene.FirstCoordinate(f));
      PoseBody(scene.body[f], poses[f].frames[t], &posed[t]);
    }
    for (const Contact& contact : scene.contacts[f]) {
      Vec3 mean = Vec3::Zero();
      for (int t = contact.first; t <= contact.last; ++t) mean += posed[t].node[contact.node];
      mean /= contact.last - contact.first + 1;
      u.anchor.col(anchor++) << mean.x(), mean.z();
    }
  }
  return u;
}

std::array<Clip, 2> EditedClips(const Scene& scene, const Unknowns& unknowns) {
  std::array<Clip, 2> out;
  for (int f = 0; f < 2; ++f) {
    out[f].fps = scene.source[f].fps;
    out[f].frames.resize(scene.num_frames());
    for (int t = 0; t < scene.num_frames(); ++t) {
      EditedPose(scene.source[f].frames[t], unknowns.edit.col(t).data() + scene.FirstCoordinate(f),
                 &out[f].frames[t]);
    }
  }
  return out;
}

}  // namespace retarget::solver
