#include "io/clip_repair.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/text/quoted.h"
#include "model/body/travel.h"
#include "model/rig/jumps.h"

namespace retarget::io {

void TreatJumps(LoadedClip* clip) {
  const ClipOptions& options = clip->options;
  RigMotion& motion = clip->file.motion;
  const std::vector<JumpRun> runs = FindJumps(motion, clip->facts.map);
  const auto note = [&](const std::string& text) { clip->facts.notes.push_back(text); };
  constexpr size_t kShown = 4;
  for (size_t n = 0; n < std::min(runs.size(), kShown); ++n) {
    const JumpRun& run = runs[n];
    const std::string joint = "'" + Printable(motion.rig.joints[run.joint].name) + "'";
    if (run.is_cut()) {
      note(
          fmt::format("the motion jumps from frame {} to {}: {} turns at {:.0f} rad/s, faster than "
                      "a person can; the capture flips, or two motions were cut "
                      "together there",
                      run.last, run.first, joint, run.speed));
      continue;
    }
    const std::string frames = run.first == run.last
                                   ? fmt::format("frame {} stands", run.first)
                                   : fmt::format("frames {} to {} stand", run.first, run.last);
    const std::string what = fmt::format(
        "{} apart from the motion ({} turns at {:.0f} rad/s, faster "
        "than a person can)",
        frames, joint, run.speed);
    if (options.repair_jumps) {
      note(what + ": interpolated, as asked for");
    } else {
      note(fmt::format("{}: {} interpolates{}", what, options.Named(options.words.repair),
                       run.first > 0 ? ""
                                     : fmt::format(", {} {} leaves out",
                                                   options.Named(options.words.skip_frames),
                                                   options.skip_frames + run.last + 1)));
    }
  }
  if (runs.size() > kShown) note(fmt::format("and {} more such jumps", runs.size() - kShown));
  if (options.repair_jumps) RepairJumps(runs, &motion);
}

void RecoverTravel(LoadedClip* clip) {
  RigMotion& motion = clip->file.motion;
  Clip poses;
  poses.fps = 1 / motion.frame_time;
  for (const RigFrame& frame : motion.frames) poses.frames.push_back(clip->binding->PoseOf(frame));
  const Travel travel = FindTravel(clip->body, poses, ContactSettings());
  if (!travel.clear()) return;
  const std::string option = clip->options.Named(clip->options.words.travel);
  if (clip->options.keep_in_place) {
    clip->facts.notes.push_back(fmt::format(
        "it seems to walk in place: its standing foot slides at {:.2f} m/s, and is left "
        "so as asked for ({} keep)",
        travel.sliding_speed, option));
    return;
  }
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    Pose moved = poses.frames[t];
    moved.root_position += travel.offset[t];
    motion.frames[t] = clip->binding->Apply(motion.frames[t], moved);
  }
  clip->facts.notes.push_back(
      fmt::format("it walks in place: its way was recovered from the standing foot, {:.1f} m at "
                  "{:.2f} m/s on average; {} keep leaves it in place",
                  travel.offset.back().norm(), travel.speed, option));
}

}  // namespace retarget::io
