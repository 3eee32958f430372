// The assembler puts the files' bytes into the program; CMake names them (tools/web/embed.cmake)
// and rebuilds this file when they change.
#include "tools/report/embedded_page.h"

#define RETARGET_EMBED(symbol, path)                                 \
  asm(".section .rodata\n"                                           \
      ".global " #symbol "_begin\n.global " #symbol "_end\n" #symbol \
      "_begin:\n"                                                    \
      ".incbin \"" path "\"\n" #symbol                               \
      "_end:\n"                                                      \
      ".byte 0\n.previous\n");                                       \
  extern "C" const char symbol##_begin[], symbol##_end[]

RETARGET_EMBED(retarget_theme_css, RETARGET_THEME_CSS);
RETARGET_EMBED(retarget_report_css, RETARGET_REPORT_CSS);
#ifdef RETARGET_REPORT_PAGE
RETARGET_EMBED(retarget_report_page, RETARGET_REPORT_PAGE);
#endif
#ifdef RETARGET_STUDIO_PAGE
RETARGET_EMBED(retarget_studio_page, RETARGET_STUDIO_PAGE);
#endif

namespace retarget::report {
namespace {

std::string_view Between(const char* begin, const char* end) {
  return std::string_view(begin, static_cast<size_t>(end - begin));
}

}  // namespace

std::string_view EmbeddedReportPage() {
#ifdef RETARGET_REPORT_PAGE
  return Between(retarget_report_page_begin, retarget_report_page_end);
#else
  return {};
#endif
}

std::string_view EmbeddedStudioPage() {
#ifdef RETARGET_STUDIO_PAGE
  return Between(retarget_studio_page_begin, retarget_studio_page_end);
#else
  return {};
#endif
}

std::string_view EmbeddedThemeCss() {
  return Between(retarget_theme_css_begin, retarget_theme_css_end);
}

std::string_view EmbeddedReportCss() {
  return Between(retarget_report_css_begin, retarget_report_css_end);
}

}  // namespace retarget::report
