// FormatBvh of io/bvh/bvh.h.
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <iterator>

#include "io/bvh/bvh.h"
#include "io/bvh/hierarchy.h"
#include "io/text/cursor.h"
#include "model/geometry/euler_angles.h"

namespace retarget::io {
namespace {

// Rotation channels of a joint in file order, filled up to three axes.
std::array<int, 3> RotationAxes(const std::vector<int>& kinds) {
  std::vector<int> axes;
  for (int kind : kinds) {
    if (kind >= kFirstRotationChannel) axes.push_back(kind - kFirstRotationChannel);
  }
  return CompleteAxes(axes);
}

void AppendNumber(double value, std::string* out) {
  constexpr double kHalfOfLastDigit = 5e-8;
  if (std::abs(value) < kHalfOfLastDigit) value = 0;  // no "-0.0000000"
  fmt::format_to(std::back_inserter(*out), "{:.7f}", value);
}

// One frame's numbers; `angles` are each joint's of the frame before, and are replaced.
void AppendFrame(const BvhFile& original, const RigFrame& frame, double offset_scale,
                 std::vector<Vec3>* angles, std::string* out) {
  for (size_t j = 0; j < original.channels.size(); ++j) {
    const std::array<int, 3> axes = RotationAxes(original.channels[j]);
    Vec3& triple = (*angles)[j];
    triple = EulerAngles(frame.rotation[j].normalized().toRotationMatrix(), axes, triple);
    Vec3 position = frame.translation[j];
    if (!original.adds_offset.empty() && original.adds_offset[j]) {
      position -= offset_scale * original.motion.rig.joints[j].offset;
    }
    int next_angle = 0;
    for (int kind : original.channels[j]) {
      if (out->back() != '\n') out->push_back(' ');
      AppendNumber(kind < kFirstRotationChannel ? position[kind] : triple[next_angle++] / kDegree,
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
    AppendFrame(original, frame, offset_scale, &angles, &out);
    out += end;
  }
  return out;
}

}  // namespace retarget::io
