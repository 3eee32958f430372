// Acclaim motion: a skeleton (ASF) and the frames that play on it (AMC), two text files.
//
// A bone begins where its parent ends: the joint called like a bone stands at the bone's START, and
// turns the bone and all beyond it. With the bone's axes C (its `axis` line) and M the turns by its
// degrees of freedom, the joint's rotation is C M C^-1, the identity in the rest pose. Both `axis`
// and `dof` name turns about fixed axes, the first turn first: for `dof rx ry rz`, M = Rz Ry Rx.
// (M. Schafer, "Acclaim Skeleton File Definition V1.10", 1995; Vicon's notes on it at CMU.)
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/rig/rig.h"

namespace retarget::io {

// Kinds of a degree of freedom: 0..2 = tx, ty, tz, 3..5 = rx, ry, rz.
inline constexpr int kFirstRotationDof = 3;

struct AcclaimBone {
  std::vector<int> dofs;  // kinds in file order; none for a rigid bone
  Quat axes = Quat::Identity();
};

struct AcclaimFile {
  RigMotion motion;                // joint 0 is the root; offsets and frames in the files' length
  std::vector<AcclaimBone> bones;  // per joint
  std::vector<int> amc_order;      // joints with degrees of freedom, as a frame lists them
  double length_unit = 1;          // `:units length`; CMU's 0.45 makes a unit 0.0254 / 0.45 m
  bool degrees = true;             // of the motion, else radians
  double first_frame = 1;          // number of the first frame
  std::string asf_text;            // the skeleton, byte for byte
  std::string amc_header;          // everything before the first frame, byte for byte
  bool crlf = false;               // the motion's first line ends in CR LF
  std::vector<std::string> warnings;  // what was assumed or tolerated, one line each
};

// The files name no frame rate. CMU captured at 120 per second.
inline constexpr double kAcclaimFps = 120;

// Reads both files. A bone that a frame leaves out stays as it was in the frame before, at first at
// rest; frames are played one after the other even where numbers are missing between them. Throws
// InputError, one line `file:line: found what, expected what`; never allocates by a declared count.
AcclaimFile ReadAcclaim(const std::string& asf_path, const std::string& amc_path,
                        double fps = kAcclaimFps);

// The same from bytes; the names stand for the files in messages.
AcclaimFile ParseAcclaim(std::string_view asf_text, const std::string& asf_name,
                         std::string_view amc_text, const std::string& amc_name,
                         double fps = kAcclaimFps);

// A motion file for the skeleton of `original`: same header, bones, order of values, angle unit and
// line ends; frames count on from the original's first. Angles are continuous from frame to frame,
// as in FormatBvh. What bones have too few degrees of freedom for is lost; the others then make
// good what they can, so that the joints come nearest to where the motion has them. `scale` is that
// of FormatAsf; frames are written as given.
std::string FormatAmc(const AcclaimFile& original, const RigMotion& motion, double scale = 1.0);

// The skeleton's text with its lengths multiplied by `scale`; with 1 its very bytes.
std::string FormatAsf(const AcclaimFile& original, double scale = 1.0);

}  // namespace retarget::io
