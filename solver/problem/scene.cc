#include "solver/problem/scene.h"

#include "model/geometry/so3.h"

namespace retarget::solver {

void EditOf(const Scene& scene, int figure, int t, const Pose& pose, int beside, MatX* edit) {
  const Pose& source = scene.source[figure].frames[t];
  const RootShift base = scene.BaseOf(figure, t);
  const int first = scene.FirstCoordinate(figure);
  edit->col(t).segment<3>(first) = pose.root_position - source.root_position - base.shift;
  for (size_t l = 0; l < source.rotation.size(); ++l) {
    const long c = first + 3 + 3 * static_cast<long>(l);
    const Quat from = l == 0 ? YawRotation(base.yaw) * source.rotation[0] : source.rotation[l];
    const Vec3 near = beside == t ? Vec3::Zero() : Vec3(edit->col(beside).segment<3>(c));
    edit->col(t).segment<3>(c) = LogSo3Near(from.conjugate() * pose.rotation[l], near);
  }
}

void EditedPose(const Scene& scene, int figure, int t, const MatX& edit, Pose* pose) {
  const Pose& source = scene.source[figure].frames[t];
  const double* x = edit.col(t).data() + scene.FirstCoordinate(figure);
  pose->root_position = source.root_position + Eigen::Map<const Vec3>(x);
  pose->rotation.resize(source.rotation.size());
  for (size_t l = 0; l < source.rotation.size(); ++l) {
    pose->rotation[l] = source.rotation[l] * ExpSo3(Eigen::Map<const Vec3>(x + 3 + 3 * l));
  }
  if (scene.base[figure].empty()) return;
  const RootShift base = scene.BaseOf(figure, t);
  pose->root_position += base.shift;
  pose->rotation[0] = YawRotation(base.yaw) * pose->rotation[0];
}

Pose ShiftedRoot(const Pose& source, const RootShift& shift) {
  Pose out = source;
  out.root_position += shift.shift;
  out.rotation[0] = YawRotation(shift.yaw) * source.rotation[0];
  return out;
}

Unknowns UnknownsFromPoses(const Scene& scene, const std::array<Clip, 2>& poses) {
  Unknowns u;
  u.edit.resize(scene.num_coordinates(), scene.num_frames());
  u.anchor.setZero(2, static_cast<long>(scene.contacts[0].size() + scene.contacts[1].size()));
  int anchor = 0;
  for (int f = 0; f < 2; ++f) {
    std::vector<PosedBody> posed(scene.num_frames());
    const auto set = [&](int t, int beside) {
      EditOf(scene, f, t, poses[f].frames[t], beside, &u.edit);
      PoseBody(scene.body[f], poses[f].frames[t], &posed[t]);
    };
    const int middle = scene.template_frame;
    set(middle, middle);
    for (int t = middle + 1; t < scene.num_frames(); ++t) set(t, t - 1);
    for (int t = middle - 1; t >= 0; --t) set(t, t + 1);
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
      EditedPose(scene, f, t, unknowns.edit, &out[f].frames[t]);
    }
  }
  return out;
}

}  // namespace retarget::solver
