// report.html: one file for people, which opens from disk without network.
#pragma once

#include <string>

#include "tools/report/report.h"

namespace retarget::report {

struct ReportPageData {
  const Json& report;        // report.json (docs/report.md)
  const Json& series;        // curves by frame, for the plots
  std::string source_glb;    // bytes of the written scenes
  std::string baseline_glb;  // empty: there is no baseline
  std::string result_glb;
};

// The page with players and plots where the program was built with it (RETARGET_STUDIO), else the
// plain one. The page's report carries its sentences under "verdict".
std::string FormatReportPage(const ReportPageData& data);

// The page without players: verdict, tables, and plots that stand still. Needs no scenes.
std::string FormatPlainPage(const Json& report, const Json& series);

}  // namespace retarget::report
