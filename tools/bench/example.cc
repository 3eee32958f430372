#include "tools/bench/example.h"

#include <algorithm>
#include <cmath>

#include "io/load_clip.h"
#include "io/template_file.h"
#include "tools/bench/ping_pong.h"

namespace retarget {

solver::RetargetInput LoadExample(const std::string& folder, int num_frames) {
  constexpr double kFps = 30;
  solver::RetargetInput input;
  input.posture = io::ReadTemplate(folder + "/template.yaml");
  for (int f = 0; f < 2; ++f) {
    io::ClipOptions options;
    options.option = std::string(1, "ab"[f]);
    options.path = folder + "/" + options.option + ".bvh";
    const io::LoadedClip clip = io::LoadClip(options);
    const int available = static_cast<int>(std::floor(clip.duration() * kFps + 1e-3)) + 1;
    input.body[f] = clip.binding->body();
    input.clip[f] = clip.Resampled(kFps, 0, available);
  }
  // Both turn round at the same instant.
  const int common = std::min(input.clip[0].num_frames(), input.clip[1].num_frames());
  for (Clip& clip : input.clip) {
    clip.frames.resize(static_cast<size_t>(common));
    clip = PingPong(clip, num_frames);
  }
  return input;
}

}  // namespace retarget
