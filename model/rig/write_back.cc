#include "model/rig/write_back.h"

#include <algorithm>
#include <cmath>

#include "model/geometry/so3.h"

namespace retarget {

EditCurve::EditCurve(const Clip& before, const Clip& after) : fps_(before.fps) {
  for (int t = 0; t < before.num_frames(); ++t) {
    const Pose& p = before.frames[t];
    const Pose& q = after.frames[t];
    std::vector<Vec3> edit = {q.root_position - p.root_position};
    for (size_t l = 0; l < p.rotation.size(); ++l) {
      edit.push_back(LogSo3(p.rotation[l].conjugate() * q.rotation[l]));
    }
    for (const Vec3& v : edit) is_zero_ = is_zero_ && v.norm() < 1e-9;
    edit_.push_back(std::move(edit));
  }
}

Pose EditCurve::Apply(const Pose& pose, double time) const {
  const int last = static_cast<int>(edit_.size()) - 1;
  const double at = std::clamp(time * fps_, 0.0, static_cast<double>(last));
  const int k = std::min(static_cast<int>(at), std::max(last - 1, 0));
  const double u = at - k;
  const std::vector<Vec3>& p0 = edit_[std::max(k - 1, 0)];
  const std::vector<Vec3>& p1 = edit_[k];
  const std::vector<Vec3>& p2 = edit_[std::min(k + 1, last)];
  const std::vector<Vec3>& p3 = edit_[std::min(k + 2, last)];
  const double u2 = u * u, u3 = u2 * u;
  const auto value = [&](const Vec3& v0, const Vec3& v1, const Vec3& v2, const Vec3& v3) -> Vec3 {
    const Vec3 m1 = 0.5 * (v2 - v0), m2 = 0.5 * (v3 - v1);
    return (2 * u3 - 3 * u2 + 1) * v1 + (u3 - 2 * u2 + u) * m1 + (3 * u2 - 2 * u3) * v2 +
           (u3 - u2) * m2;
  };
  Pose out = pose;
  out.root_position += value(p0[0], p1[0], p2[0], p3[0]);
  for (size_t l = 0; l < pose.rotation.size(); ++l) {
    // Counted from frame k: an edit of half a turn has two vectors, and from frame to frame the
    // shorter may change from one to the other.
    const Quat base = ExpSo3(p1[l + 1]);
    const auto turn = [&](const std::vector<Vec3>& p) {
      return LogSo3(base.conjugate() * ExpSo3(p[l + 1]));
    };
    out.rotation[l] =
        pose.rotation[l] * base * ExpSo3(value(turn(p0), Vec3::Zero(), turn(p2), turn(p3)));
  }
  return out;
}

namespace {

RigFrame PlacedFrame(const RigBinding& binding, const RigFrame& captured,
                     const std::function<Pose(const Pose&)>& place) {
  const Pose there = binding.PoseOf(captured), placed = place(there);
  const Quat turn = placed.rotation[0] * there.rotation[0].conjugate();
  return binding.Placed(captured, turn, placed.root_position - turn * there.root_position);
}

}  // namespace

RigFrame WrittenFrame(const RigBinding& binding, const RigFrame& captured,
                      const std::function<Pose(const Pose&)>& place, const Pose& solved) {
  return binding.Fitted(PlacedFrame(binding, captured, place), solved);
}

RigMotion WriteBack(const RigMotion& captured, const RigBinding& binding, double start,
                    const std::function<Pose(const Pose&)>& place, const Clip& source,
                    const Clip& solved) {
  const EditCurve edit(source, solved);
  const double span = (source.num_frames() - 1) / source.fps;
  const int keys = static_cast<int>(std::floor(span / captured.frame_time + 1e-6)) + 1;
  RigMotion out;
  out.rig = captured.rig;
  out.frame_time = captured.frame_time;
  for (int i = 0; i < keys; ++i) {
    const double time = i * captured.frame_time;
    const RigFrame frame = SampleRig(captured, start + time);
    const Pose pose = edit.Apply(place(binding.PoseOf(frame)), time);
    out.frames.push_back(edit.is_zero() ? binding.Apply(PlacedFrame(binding, frame, place), pose)
                                        : WrittenFrame(binding, frame, place, pose));
  }
  return out;
}

}  // namespace retarget
