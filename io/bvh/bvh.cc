// Reading; bvh_write.cc writes.
#include "io/bvh/bvh.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <set>
#include <utility>

#include "io/bvh/hierarchy.h"
#include "io/bvh/offsets.h"
#include "io/text/cursor.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "model/geometry/euler_angles.h"

namespace retarget::io {
namespace {

using bvh::Cursor;
using bvh::kMaxNumber;
using bvh::NumberFault;

// A bound that no real file reaches, so that a damaged one cannot ask for all memory.
constexpr size_t kMaxJointFrames = 20'000'000;

// Strips `words` and a colon from the front of a line, blanks anywhere; false if they are not
// there.
bool StripHeader(std::string_view* line, std::initializer_list<std::string_view> words) {
  for (std::string_view word : words) {
    *line = bvh::Trimmed(*line);
    if (!bvh::SameWord(line->substr(0, word.size()), word)) return false;
    line->remove_prefix(word.size());
  }
  *line = bvh::Trimmed(*line);
  if (!line->starts_with(':')) return false;
  line->remove_prefix(1);
  *line = bvh::Trimmed(*line);
  return true;
}

double ReadFrameCount(Cursor* cursor) {
  std::string_view line;
  cursor->NextLine(&line);
  const std::string_view whole = line;
  if (!StripHeader(&line, {"Frames"})) cursor->FailAtToken(whole, "Frames: and their number");
  double count = 0;
  const NumberFault fault = bvh::ParseNumber(line, &count);
  if (fault == NumberFault::kTooLarge) return kMaxNumber;  // only compared with what is there
  if (fault != NumberFault::kNone || count < 0) {
    cursor->FailAtToken(whole, "Frames: and their number");
  }
  return count;
}

double ReadFrameTime(Cursor* cursor, std::string* as_written) {
  std::string_view line;
  cursor->NextLine(&line);
  const std::string_view whole = line;
  const char* expected = "Frame Time: and seconds greater than zero";
  if (!StripHeader(&line, {"Frame", "Time"})) cursor->FailAtToken(whole, expected);
  const double frame_time = cursor->Number(line, expected);
  if (frame_time < 1 / kMaxNumber) cursor->FailAtToken(whole, expected);
  *as_written = std::string(line);
  return frame_time;
}

// Reads the numbers of one frame into `row`, whose size is the number of channels.
void ReadRow(const Cursor& cursor, std::string_view line, std::vector<double>* row) {
  const auto is_separator = [](char c) { return bvh::IsSpace(c) || c == ','; };
  size_t count = 0;
  for (size_t at = 0; at < line.size();) {
    if (is_separator(line[at])) {
      ++at;
      continue;
    }
    const size_t begin = at;
    while (at < line.size() && !is_separator(line[at])) ++at;
    const double value = cursor.Number(line.substr(begin, at - begin), "a number");
    if (count < row->size()) (*row)[count] = value;
    ++count;
  }
  if (count != row->size()) {
    cursor.Fail(fmt::format("{} numbers", count), fmt::format("{}, one per channel", row->size()));
  }
}

RigFrame FrameOfRow(const BvhFile& file, const std::vector<double>& row) {
  const auto& joints = file.motion.rig.joints;
  RigFrame frame;
  frame.translation.resize(joints.size());
  frame.rotation.assign(joints.size(), Quat::Identity());
  size_t at = 0;
  for (size_t j = 0; j < joints.size(); ++j) {
    frame.translation[j] = joints[j].offset;
    for (int kind : file.channels[j]) {
      const double value = row[at++];
      if (kind < kFirstRotationChannel) {
        frame.translation[j][kind] = value;
      } else {
        frame.rotation[j] =
            frame.rotation[j] * AxisTurn(kind - kFirstRotationChannel, value * kDegree);
      }
    }
  }
  return frame;
}

void ReadFrames(Cursor* cursor, double declared, BvhFile* file) {
  size_t num_channels = 0;
  for (const auto& kinds : file->channels) num_channels += kinds.size();
  if (num_channels == 0) cursor->Fail("no channel in any joint", "position and rotation channels");
  RigMotion& motion = file->motion;
  std::vector<double> row(num_channels);
  std::string_view line;
  while (cursor->NextLine(&line)) {
    ReadRow(*cursor, line, &row);
    if ((motion.frames.size() + 1) * motion.rig.joints.size() > kMaxJointFrames) {
      cursor->Fail("too many frames",
                   fmt::format("at most {} joints times frames", kMaxJointFrames));
    }
    motion.frames.push_back(FrameOfRow(*file, row));
  }
  if (motion.frames.empty()) cursor->Fail("no frames", "at least one line of numbers");
  if (declared != static_cast<double>(motion.frames.size())) {
    file->warnings.push_back(
        fmt::format("{:.0f} frames declared, {} found and used", declared, motion.frames.size()));
  }
}

// Joints with fewer than three rotation channels.
void LimitTurns(BvhFile* file) {
  for (size_t j = 0; j < file->channels.size(); ++j) {
    RigJoint& joint = file->motion.rig.joints[j];
    for (const int kind : file->channels[j]) {
      if (kind >= kFirstRotationChannel) {
        joint.turn_axes.push_back(Vec3::Unit(kind - kFirstRotationChannel));
      }
    }
    joint.turns_freely = joint.turn_axes.size() == 3;
    if (joint.turns_freely) joint.turn_axes.clear();
  }
}

void WarnOfDuplicateNames(BvhFile* file) {
  std::set<std::string_view> seen, told;
  for (const RigJoint& joint : file->motion.rig.joints) {
    if (!seen.insert(joint.name).second && told.insert(joint.name).second && told.size() <= 5) {
      file->warnings.push_back("joint name " + QuotedWord(joint.name) + " occurs more than once");
    }
  }
}

}  // namespace

double SnappedFrameTime(double frame_time) {
  const double rate = std::round(1 / frame_time);
  return rate >= 1 && std::abs(1 / frame_time - rate) <= 2e-4 * rate ? 1 / rate : frame_time;
}

BvhFile ParseBvh(std::string_view text, const std::string& name) {
  Cursor cursor(text, name);
  const bvh::Hierarchy hierarchy = bvh::ReadHierarchy(&cursor);
  BvhFile file;
  file.motion.rig = hierarchy.rig;
  file.channels = hierarchy.channels;
  file.warnings = hierarchy.warnings;
  file.hierarchy_text = std::string(text.substr(0, hierarchy.motion_begin));
  const size_t first_end = text.find('\n');
  file.crlf = first_end != std::string_view::npos && first_end > 0 && text[first_end - 1] == '\r';
  LimitTurns(&file);
  const double declared = ReadFrameCount(&cursor);
  file.motion.frame_time = SnappedFrameTime(ReadFrameTime(&cursor, &file.frame_time_text));
  ReadFrames(&cursor, declared, &file);
  bvh::CheckSecondOffsets(hierarchy, name, &file);
  bvh::AddOffsetsToDisplacements(&file);
  WarnOfDuplicateNames(&file);
  return file;
}

BvhFile ReadBvh(const std::string& path) {
  return ParseBvh(ReadFilledFile(path, "a BVH file"), path);
}

}  // namespace retarget::io
