// How the command line names its options in messages of layers that do not know it.
#include <fmt/format.h>

#include "tools/cli/commands.h"

namespace retarget::cli {

io::OptionWords ProgramWords() {
  return {.units = "--units",
          .stature = "--stature",
          .up = "--up",
          .skip_frames = "--skip-frames",
          .start = "--start",
          .repair = "--repair",
          .travel = "--travel",
          .ik_targets = "--ik-targets",
          .character = "--character",
          .map_by_hand =
              "`retarget map {} --yaml > a.map.yaml`, edit it, give it with --map-a "
              "a.map.yaml"};
}

std::string WriteRefusalText(const io::WriteRefusal& refusal) {
  using Kind = io::WriteRefusal::Kind;
  switch (refusal.kind()) {
    case Kind::kFileExists:
      return fmt::format("{}; give --force to overwrite it", refusal.what());
    case Kind::kForeignFiles:
      return fmt::format("--out {}; choose another folder or give --force", refusal.what());
    case Kind::kInput:
      return fmt::format("--out {}; choose another folder", refusal.what());
    case Kind::kNoFolder:
      break;
  }
  return fmt::format("--out {}", refusal.what());
}

}  // namespace retarget::cli
