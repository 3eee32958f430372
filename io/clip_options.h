// Which clip is meant, and what its file does not say.
#pragma once

#include <string>

#include "io/recognition/option_words.h"

namespace retarget::io {

struct ClipOptions {
  std::string path;            // as ParseClipPath takes it
  std::string option;          // "a" or "b": added to the words, empty: there is one clip
  double start = 0;            // s into the clip
  double stature = 0;          // m, 0: the clip's own
  std::string units;           // as given, empty: as the file says, or guess
  std::string up;              // "y", "z", empty: as the file says, or guess
  std::string map;             // path of a joint map, empty: guess
  bool any_animation = false;  // of several, none of them selected, the first
  bool repair_jumps = false;   // interpolate frames that stand apart from the motion
  bool keep_in_place = false;  // a clip that strides in place stays there
  int skip_frames = 0;         // dropped from the beginning
  // "follow": targets of inverse kinematics and other loose bones go with the bones that they are
  // for (RigFacts::followers); "keep": they are only placed with the figure.
  std::string ik_targets = "follow";
  double amc_fps = 120;       // of Acclaim motions, which do not say
  std::string character;      // path of a character that takes over the motion, empty: none
  std::string character_map;  // joint map of the character
  // The file itself where it is in memory already; `path` is then what messages call it, with the
  // selection that some formats need. Of Acclaim the motion, with its skeleton apart.
  std::string bytes = {}, skeleton_bytes = {};
  OptionWords words = {};  // what messages call these options
  // The option as messages name it.
  std::string Named(const std::string& word) const {
    return option.empty() ? word : word + "-" + option;
  }
};

}  // namespace retarget::io
