#include "io/bvh/offsets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "model/geometry/quantile.h"

namespace retarget::io::bvh {
namespace {

bool HasPosition(const BvhFile& file, size_t joint) {
  return std::ranges::any_of(file.channels[joint],
                             [](int kind) { return kind < kFirstRotationChannel; });
}

// Median over the motion of a joint's distance from `place` along its position channels.
double DistanceFrom(const BvhFile& file, size_t joint, const Vec3& place) {
  constexpr size_t kSamples = 48;
  const auto& frames = file.motion.frames;
  const size_t step = std::max<size_t>(1, frames.size() / kSamples);
  std::vector<double> distances;
  for (size_t f = 0; f < frames.size(); f += step) {
    Vec3 off = Vec3::Zero();
    for (const int kind : file.channels[joint]) {
      if (kind < kFirstRotationChannel)
        off[kind] = frames[f].translation[joint][kind] - place[kind];
    }
    distances.push_back(off.norm());
  }
  return Median(std::move(distances));
}

// A root with an OFFSET may carry it in its channels, as usual, in a file of displacements too.
bool RootStandsAtOffset(const BvhFile& file, size_t root) {
  const Vec3& offset = file.motion.rig.joints[root].offset;
  const Vec3& at = file.motion.frames[0].translation[root];
  return (at - offset).norm() < at.norm();
}

}  // namespace

void AddOffsetsToDisplacements(BvhFile* file) {
  constexpr double kFar = 0.25;  // of the OFFSETs: displacements are small against bones
  auto& joints = file->motion.rig.joints;
  file->adds_offset.assign(joints.size(), false);
  double from_offset = 0, from_parent = 0, bones = 0;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].parent < 0 || !HasPosition(*file, j)) continue;
    bones += joints[j].offset.norm();
    from_offset += DistanceFrom(*file, j, joints[j].offset);
    from_parent += DistanceFrom(*file, j, Vec3::Zero());
  }
  if (!(from_parent < kFar * bones && from_parent < from_offset / 2)) return;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (!HasPosition(*file, j)) continue;
    if (joints[j].parent < 0 && RootStandsAtOffset(*file, j)) continue;
    file->adds_offset[j] = true;
    for (RigFrame& frame : file->motion.frames) {
      for (const int kind : file->channels[j]) {
        if (kind < kFirstRotationChannel) frame.translation[j][kind] += joints[j].offset[kind];
      }
    }
  }
  file->warnings.push_back(
      "the position channels below the root are near zero and the OFFSETs are not: they are read "
      "as "
      "displacements from the OFFSETs");
}

void CheckSecondOffsets(const Hierarchy& hierarchy, const std::string& name, BvhFile* file) {
  double from_first = 0, from_second = 0;
  size_t count = 0, line_of = 0;
  for (size_t j = 0; j < hierarchy.second_offset.size(); ++j) {
    const std::optional<Vec3>& second = hierarchy.second_offset[j];
    if (!second) continue;
    if (count++ == 0) line_of = j;
    // A root travels, and says nothing of its OFFSET.
    if (file->motion.rig.joints[j].parent < 0 || !HasPosition(*file, j)) continue;
    from_first += DistanceFrom(*file, j, file->motion.rig.joints[j].offset);
    from_second += DistanceFrom(*file, j, *second);
  }
  if (count == 0) return;
  if (from_second < from_first) {
    throw InputError(fmt::format(
        "{}:{}: found six numbers after OFFSET, of which the position channels follow the last "
        "three, expected the joint's place first",
        name, hierarchy.offset_line[line_of]));
  }
  file->warnings.push_back(
      fmt::format("{} joint{} six numbers after OFFSET: the first three are read, as the place",
                  count, count == 1 ? " has" : "s have"));
}

}  // namespace retarget::io::bvh
