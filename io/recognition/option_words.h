// What messages call the options with which a user overrides a guess. Fields of io::ClipOptions,
// unless a program says what it calls them.
#pragma once

#include <string>

namespace retarget::io {

struct OptionWords {
  std::string units = "ClipOptions::units";
  std::string stature = "ClipOptions::stature";
  std::string up = "ClipOptions::up";
  std::string skip_frames = "ClipOptions::skip_frames";
  std::string start = "ClipOptions::start";
  std::string repair = "ClipOptions::repair_jumps";
  std::string travel = "ClipOptions::travel";
  std::string ik_targets = "ClipOptions::ik_targets";
  std::string character = "ClipOptions::character";
  // How a figure is mapped by hand; {} stands for its file.
  std::string map_by_hand = "write its map (MapOfClip), edit it, give it as ClipOptions::map";
};

}  // namespace retarget::io
