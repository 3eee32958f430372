// Files of tools/web that are part of the program.
#pragma once

#include <string_view>

namespace retarget::report {

// The built page with its markers `<!--retarget:verdict-->`, `tables` and `data`; empty where the
// program was built without it (RETARGET_STUDIO=OFF).
std::string_view EmbeddedReportPage();

// The built studio page; empty where the program was built without it.
std::string_view EmbeddedStudioPage();

// Style sheets of the pages, as written.
std::string_view EmbeddedThemeCss();
std::string_view EmbeddedReportCss();

}  // namespace retarget::report
