// `retarget mirror CLIP`: left and right exchanged, on the same rig, in the same format.
#include "model/rig/mirror.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/files.h"
#include "tools/cli/commands.h"

namespace retarget::cli {

int RunMirror(const io::ClipOptions& options, const std::string& out, bool force) {
  namespace fs = std::filesystem;
  const io::LoadedClip clip = io::RecogniseClip(options);
  const RigMotion motion =
      Mirrored(clip.file.motion, Counterparts(clip.file.motion.rig, clip.facts.map));
  const fs::path path(out);
  const std::vector<io::NamedBytes> files = io::FormatClipFile(clip.file, motion, path.stem(), 1);
  if (files[0].name != path.filename()) {
    throw InputError(fmt::format("--out {}: expected a name that ends in {}, the clip's format",
                                 out, fs::path(files[0].name).extension().string()));
  }
  for (const io::NamedBytes& file : files) {
    io::WriteFile(path.parent_path() / file.name, file.bytes, force);
  }
  fmt::print("written to {}\n", out);
  return kDone;
}

}  // namespace retarget::cli
