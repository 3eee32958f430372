// What a motion file is about: which joint is which, the unit, the up axis, the owner's stature,
// and calibration poses at the start. Guesses are told to the user, and options override them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/recognition/option_words.h"
#include "model/rig/rig.h"

namespace retarget::io {

struct RecogniseOptions {
  std::optional<double> metres_per_unit;
  std::optional<char> up;                      // 'y' or 'z'
  std::optional<JointMap> map = std::nullopt;  // of a map file: nothing is guessed
  OptionWords words = {};                      // what messages call these
  double stature = 0;  // m, 0: not given; settles the unit where nothing else does
};

// Recognises the human of a motion. Throws InputError, one line that begins with `file_name`,
// where there is no frame, no human, more than one reading, or no plausible stature.
RigFacts Recognise(const RigMotion& motion, const RecogniseOptions& options,
                   const std::string& file_name);

// The bone at the body's chest node: the last spine bone that lies apart from both the neck and
// the root (CMU's Spine1 sits on the neck); -1 where none does.
int ChestBone(const RigMotion& motion, const JointMap& map);

// "m", "cm", "mm", "dm", "in", "cmu" (the unit of CMU's raw data, 0.45 in^-1: 0.0564 m) or a
// positive number of metres; nothing for other texts.
std::optional<double> ParseUnits(const std::string& text);

// For people: what was recognised, one fact a line, then the joints. `figures`: the names of all in
// the file, where there are several.
std::string MapTable(const RigFacts& facts, const RigMotion& motion,
                     const std::vector<std::string>& figures = {});

// For programs: an object {profile, confidence (0 to 1), units (metres per unit), unit_name, up,
// facing_deg, stature_m, frames, fps, joints: {project's name: bone}, virtual: [project's name],
// unmapped: [bone], t_pose_frames: [frame from 0], notes: [text], figures: [name]}.
std::string MapJson(const RigFacts& facts, const RigMotion& motion,
                    const std::vector<std::string>& figures = {});

}  // namespace retarget::io
