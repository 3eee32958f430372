// From a motion file to a clip of the body: read, recognise, bind, resample.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/bvh.h"
#include "io/recognise.h"
#include "model/rig_binding.h"

namespace retarget {

struct ClipOptions {
  std::string path;
  std::string option;   // "a" or "b": which options messages name
  double start = 0;     // s into the clip
  double stature = 0;   // m, 0: the clip's own
  std::string units;    // as given, empty: guess
  std::string up;       // "y", "z", empty: guess
  std::string map;      // path of a joint map, empty: guess
  int skip_frames = 0;  // dropped from the beginning
};

struct LoadedClip {
  ClipOptions options;
  BvhFile file;  // without the skipped frames
  RigFacts facts;
  std::unique_ptr<RigBinding> binding;
  std::string hash;  // of the file's bytes

  double duration() const {  // s from the first to the last frame
    return (file.motion.num_frames() - 1) * file.motion.frame_time;
  }
  // Poses at start + k / fps for output frames k in [first, last).
  Clip Resampled(double fps, int first, int last) const;
};

// Throws InputError.
LoadedClip LoadClip(const ClipOptions& options);
// Reads and recognises only.
LoadedClip RecogniseClip(const ClipOptions& options);
// The clip's joint map as a file to edit: a draft where the figure is refused.
std::string MapOfClip(const ClipOptions& options);

}  // namespace retarget
