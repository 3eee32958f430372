// From a motion file to a clip of the body: read, recognise, bind, resample.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/clip_file.h"
#include "io/clip_options.h"
#include "io/recognition/recognise.h"
#include "model/rig/binding.h"

namespace retarget::io {

struct LoadedClip {
  ClipOptions options;
  ClipFile file;  // without the skipped frames; of the character, where there is one
  RigFacts facts;
  std::unique_ptr<RigBinding> binding;
  Body body;                // the binding's, with the radii of the character's skin
  bool skin_radii = false;  // whether there is a skin
  std::string hash;         // of the files' bytes
  // Of a character: whose motion it has taken over.
  std::optional<RigFacts> motion_facts;
  std::string motion_hash;

  double duration() const {  // s from the first to the last frame
    return (file.motion.num_frames() - 1) * file.motion.frame_time;
  }
  // Poses at start + k / fps for output frames k in [first, last).
  Clip Resampled(double fps, int first, int last) const;
  // The same frames: turns that the rig cannot make; empty where it can make all.
  std::vector<std::vector<LockedAxis>> LockedAxes(double fps, int first, int last) const;
};

// Reads, recognises and binds; where the options name a character, its body takes over the motion:
// the same joint rotations, the root's path scaled by the length of the legs. Throws InputError.
LoadedClip LoadClip(const ClipOptions& options);
// Reads and recognises only.
LoadedClip RecogniseClip(const ClipOptions& options);
// The clip's joint map as a file to edit: a draft where the figure is refused.
std::string MapOfClip(const ClipOptions& options);

}  // namespace retarget::io
