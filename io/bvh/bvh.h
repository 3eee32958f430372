// Biovision hierarchy (BVH) files: a skeleton and its frames. FORMATS of the wild are many; this
// reader takes every dialect that can be read in only one way, and refuses the rest with the line.
//
// Conventions: R = R_first * R_second * R_third over a joint's rotation channels in file order
// (degrees). A position channel replaces its axis of the joint's OFFSET, unless the file as a whole
// can only mean that it is added (BvhFile::adds_offset).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

// Kinds of a channel: 0..2 = X, Y, Z position, 3..5 = X, Y, Z rotation.
inline constexpr int kFirstRotationChannel = 3;

struct BvhFile {
  RigMotion motion;                        // frame time snapped, see SnappedFrameTime
  std::vector<std::vector<int>> channels;  // kinds per joint, in file order
  std::vector<bool> adds_offset;           // [joints] position channels are added to its OFFSET
  std::string hierarchy_text;              // everything before "MOTION", byte for byte
  std::string frame_time_text;             // as written
  bool crlf = false;                       // the first line ends in CR LF
  std::vector<std::string> warnings;       // what was tolerated, one line each
};

// Reads a file. Throws InputError, one line `file:line: found what, expected what`; never
// allocates by a count that a file merely declares.
BvhFile ReadBvh(const std::string& path);

// The same from bytes; `name` stands for the file in messages.
BvhFile ParseBvh(std::string_view text, const std::string& name);

// The text of `original` with other frames (and frame time, if it differs). The hierarchy keeps
// its bytes: names, order, channels and line ends. Rotations become Euler angles in each joint's
// own channel order, of the equivalent triples the one nearest the previous frame, so that curves
// have no jumps of half or whole turns; at a gimbal lock the first angle stays as it was. A joint
// with one or two rotation channels gets the part of its rotation that these can hold.
// `offset_scale` multiplies the OFFSETs; frames are written as given.
// World positions come back within 1e-6 of the figure's size.
std::string FormatBvh(const BvhFile& original, const RigMotion& motion, double offset_scale = 1.0);

// The file with some of its joints alone, `joints` in order and with all that carry them: what
// FormatBvh writes has the others no more.
BvhFile CutBvh(const BvhFile& file, const std::vector<int>& joints);

// Writers round the frame time: a rate within 2e-4 of an integer (120.005, 29.9997) is that
// integer. Others (23.976) stay. In and out: s.
double SnappedFrameTime(double frame_time);

}  // namespace retarget::io
