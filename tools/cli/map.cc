// retarget map: what is recognised in a clip.
#include <fmt/format.h>

#include "io/load_clip.h"
#include "io/recognition/recognise.h"
#include "tools/cli/commands.h"

namespace retarget::cli {

int RunMap(const io::ClipOptions& options, bool json, bool yaml) {
  if (yaml) {
    fmt::print("{}", io::MapOfClip(options));
    return kDone;
  }
  const io::LoadedClip clip = io::RecogniseClip(options);
  fmt::print("{}", json ? io::MapJson(clip.facts, clip.file.motion, clip.file.figures)
                        : io::MapTable(clip.facts, clip.file.motion, clip.file.figures));
  return kDone;
}

}  // namespace retarget::cli
