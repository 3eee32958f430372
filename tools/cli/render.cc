// `retarget render`: a contact sheet of a run, source above result; or a template from four sides.
#include <fmt/format.h>

#include <filesystem>

#include "io/files.h"
#include "io/template_file.h"
#include "tools/cli/commands.h"
#include "tools/report/contact_sheet.h"

namespace retarget::cli {

int RunRender(const std::string& path, const std::string& out, bool force) {
  if (!std::filesystem::is_directory(path)) {
    io::WriteFile(out, io::EncodePng(report::TemplateSheet(io::ReadTemplate(path))), force);
    fmt::print("written to {}\n", out);
    return kDone;
  }
  constexpr int kColumns = 4;
  std::vector<report::SheetInstant> instants;
  for (int k = 0; k < kColumns; ++k) instants.push_back({(2.0 * k + 1) / (2.0 * kColumns)});
  io::WriteFile(out, io::EncodePng(report::ContactSheet(path, instants, false)), force);
  fmt::print("written to {}\n", out);
  return kDone;
}

}  // namespace retarget::cli
