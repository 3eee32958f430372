// retarget config: every setting with its default, unit and meaning.
#include <fmt/format.h>

#include "io/settings_file.h"
#include "tools/cli/commands.h"

namespace retarget::cli {

int RunConfig(const SettingsOptions& settings) {
  fmt::print("{}", io::FormatSettings(SettingsOf(settings)));
  return kDone;
}

}  // namespace retarget::cli
