// FormatBvh of io/bvh.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>

#include "io/bvh.h"
#include "io/bvh_hierarchy.h"
#include "io/bvh_text.h"

namespace retarget {
namespace {

// The axes of R_i(a) R_j(b) R_k(c).
struct EulerOrder {
  int i, j, k;
  double sign;  // +1 if (i, j, k) is an even permutation of (x, y, z)
  explicit EulerOrder(const std::array<int, 3>& axes)
      : i(axes[0]), j(axes[1]), k(axes[2]), sign((j - i + 3) % 3 == 1 ? 1.0 : -1.0) {}
};

double NearestTurn(double angle, double previous) {
  return angle + 2 * kPi * std::round((previous - angle) / (2 * kPi));
}

// The angles b and c that complete a given first angle a.
Vec3 CompleteAngles(const Mat3& r, const EulerOrder& o, double a) {
  const Mat3 rest = Eigen::AngleAxisd(-a, Vec3::Unit(o.i)).toRotationMatrix() * r;  // R_j(b) R_k(c)
  return {a, std::atan2(o.sign * rest(o.i, o.k), rest(o.k, o.k)),
          std::atan2(o.sign * rest(o.j, o.i), rest(o.j, o.j))};
}

// Angles (rad) with r = R_i(a) R_j(b) R_k(c), of all such triples the nearest to `previous`.
Vec3 EulerAngles(const Mat3& r, const EulerOrder& o, const Vec3& previous) {
  // Below it the first angle is noise, and any choice of it errs by less than this (rad).
  constexpr double kGimbalLock = 1e-7;
  const bool locked = std::hypot(r(o.j, o.k), r(o.k, o.k)) < kGimbalLock;
  const double a = locked ? previous[0] : std::atan2(-o.sign * r(o.j, o.k), r(o.k, o.k));
  Vec3 best = Vec3::Zero();
  double best_distance = -1;
  for (double first : {a, a + kPi}) {
    Vec3 triple = CompleteAngles(r, o, first);
    for (int n = 0; n < 3; ++n) triple[n] = NearestTurn(triple[n], previous[n]);
    const double distance = (triple - previous).squaredNorm();
    if (best_distance < 0 || distance < best_distance) {
      best = triple;
      best_distance = distance;
    }
  }
  return best;
}

// Rotation channels of a joint in file order, filled up to three axes.
std::array<int, 3> RotationAxes(const std::vector<int>& kinds) {
  std::array<int, 3> axes = {-1, -1, -1};
  size_t n = 0;
  const auto add = [&](int axis) {
    if (std::find(axes.begin(), axes.end(), axis) == axes.end()) axes[n++] = axis;
  };
  for (int kind : kinds) {
    if (kind >= kFirstRotationChannel) add(kind - kFirstRotationChannel);
  }
  for (int axis = 0; axis < 3; ++axis) add(axis);
  return axes;
}

void AppendNumber(double value, std::string* out) {
  constexpr double kHalfOfLastDigit = 5e-8;
  if (std::abs(value) < kHalfOfLastDigit) value = 0;  // no "-0.0000000"
  fmt::format_to(std::back_inserter(*out), "{:.7f}", value);
}

// One frame's numbers; `angles` are each joint's of the frame before, and are replaced.
void AppendFrame(const BvhFile& original, const RigFrame& frame, std::vector<Vec3>* angles,
                 std::string* out) {
  for (size_t j = 0; j < original.channels.size(); ++j) {
    const std::array<int, 3> axes = RotationAxes(original.channels[j]);
    Vec3& triple = (*angles)[j];
    triple =
        EulerAngles(frame.rotation[j].normalized().toRotationMatrix(), EulerOrder(axes), triple);
    int next_angle = 0;
    for (int kind : original.channels[j]) {
      if (out->back() != '\n') out->push_back(' ');
      AppendNumber(kind < kFirstRotationChannel ? frame.translation[j][kind]
                                                : triple[next_angle++] / kDegree,
                   out);
    }
  }
}

std::string ScaledHierarchy(const std::string& text, double scale) {
  const std::string whole = text + "MOTION";
  bvh::Cursor cursor(whole, "hierarchy");
  const bvh::Hierarchy hierarchy = bvh::ReadHierarchy(&cursor);
  std::string out;
  size_t at = 0;
  for (const auto& [begin, end] : hierarchy.offset_numbers) {
    double value = 0;
    bvh::ParseNumber(std::string_view(text).substr(begin, end - begin), &value);
    out += text.substr(at, begin - at);
    AppendNumber(value * scale, &out);
    at = end;
  }
  return out + text.substr(at);
}

}  // namespace

std::string FormatBvh(const BvhFile& original, const RigMotion& motion, double offset_scale) {
  assert(motion.rig.joints.size() == original.channels.size());
  std::string out = offset_scale == 1.0 ? original.hierarchy_text
                                        : ScaledHierarchy(original.hierarchy_text, offset_scale);
  const std::string_view end = original.crlf ? "\r\n" : "\n";
  const std::string frame_time = motion.frame_time == original.motion.frame_time
                                     ? original.frame_time_text
                                     : fmt::format("{:.10g}", motion.frame_time);
  out += fmt::format("MOTION{}Frames: {}{}Frame Time: {}{}", end, motion.frames.size(), end,
                     frame_time, end);
  std::vector<Vec3> angles(original.channels.size(), Vec3::Zero());
  for (const RigFrame& frame : motion.frames) {
    AppendFrame(original, frame, &angles, &out);
    out += end;
  }
  return out;
}

}  // namespace retarget
