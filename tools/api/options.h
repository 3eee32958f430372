// What is asked of a run.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/load_clip.h"

namespace retarget::api {

// Where settings come from: a file, and single ones over it.
struct SettingsOptions {
  std::string config_path;       // empty: the defaults
  std::vector<std::string> set;  // "key=value"
};

struct RetargetOptions {
  std::array<io::ClipOptions, 2> clip;
  std::string template_path, config_path, out = "out", frames;
  std::vector<std::string> set;
  std::string show = "figures";  // of scene.glb: "figures" or "characters"
  double fps = 30, template_at = 0;
  int threads = -1;                // -1: as configured
  std::string progress = "table";  // on stderr: "table" (on a terminal only), or "json" lines
  bool json = false, force = false;
  bool quiet = false;  // says nothing of the result
};

}  // namespace retarget::api
