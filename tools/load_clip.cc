#include "tools/load_clip.h"

#include <fmt/format.h>

#include <utility>

#include "io/map_file.h"
#include "tools/files.h"

namespace retarget {

Clip LoadedClip::Resampled(double fps, int first, int last) const {
  Clip clip;
  clip.fps = fps;
  for (int k = first; k < last; ++k) {
    clip.frames.push_back(binding->PoseOf(SampleRig(file.motion, options.start + k / fps)));
  }
  return clip;
}

namespace {

LoadedClip ReadClip(const ClipOptions& options) {
  LoadedClip clip;
  clip.options = options;
  const std::string bytes = ReadFile(options.path);
  clip.hash = HashOf(bytes);
  clip.file = ParseBvh(bytes, options.path);
  return clip;
}

// What the options and the map file say, the options first.
RecogniseOptions RecogniseOptionsOf(const ClipOptions& options, const Rig& rig) {
  RecogniseOptions recognise;
  if (!options.map.empty()) {
    MapFile file = ReadMap(options.map, rig);
    recognise = {file.metres_per_unit, file.up, std::move(file.map)};
  }
  if (!options.units.empty()) {
    recognise.metres_per_unit = ParseUnits(options.units);
    if (!recognise.metres_per_unit) {
      throw InputError(fmt::format("--units-{} {}: expected cm, m, mm, in, cmu or metres per unit",
                                   options.option, options.units));
    }
  }
  if (!options.up.empty()) recognise.up = options.up[0];
  return recognise;
}

}  // namespace

std::string MapOfClip(const ClipOptions& options) {
  const RigMotion motion = ReadClip(options).file.motion;
  const RecogniseOptions recognise = RecogniseOptionsOf(options, motion.rig);
  try {
    return FormatMap(motion, Recognise(motion, recognise, options.path));
  } catch (const InputError& refusal) {
    return FormatMapDraft(motion, refusal.what());
  }
}

LoadedClip RecogniseClip(const ClipOptions& options) {
  LoadedClip clip = ReadClip(options);
  RigMotion& motion = clip.file.motion;
  clip.facts = Recognise(motion, RecogniseOptionsOf(options, motion.rig), options.path);
  clip.facts.notes.insert(clip.facts.notes.begin(), clip.file.warnings.begin(),
                          clip.file.warnings.end());
  if (options.skip_frames >= motion.num_frames()) {
    throw InputError(fmt::format("--skip-frames-{} {}: {} has only {} frames", options.option,
                                 options.skip_frames, options.path, motion.num_frames()));
  }
  motion.frames.erase(motion.frames.begin(), motion.frames.begin() + options.skip_frames);
  return clip;
}

LoadedClip LoadClip(const ClipOptions& options) {
  LoadedClip clip = RecogniseClip(options);
  const int chest = ChestBone(clip.file.motion, clip.facts.map);
  try {
    clip.binding =
        std::make_unique<RigBinding>(clip.file.motion, clip.facts, chest, options.stature);
  } catch (const InputError& error) {
    throw InputError(options.path + ": " + error.what());
  }
  if (options.start > clip.duration() + 1e-9) {
    throw InputError(fmt::format("--start-{} {}: {} is only {:.3f} s long", options.option,
                                 options.start, options.path, clip.duration()));
  }
  return clip;
}

}  // namespace retarget
