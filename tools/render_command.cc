// `retarget render DIR`: a contact sheet of a run, source above result.
#include <fmt/format.h>

#include "tools/commands.h"
#include "tools/contact_sheet.h"
#include "tools/files.h"

namespace retarget {

int RunRender(const std::string& folder, const std::string& out, bool force) {
  constexpr int kColumns = 4;
  std::vector<SheetInstant> instants;
  for (int k = 0; k < kColumns; ++k) instants.push_back({(2.0 * k + 1) / (2.0 * kColumns)});
  WriteFile(out, EncodePng(ContactSheet(folder, instants, false)), force);
  fmt::print("written to {}\n", out);
  return kDone;
}

}  // namespace retarget
