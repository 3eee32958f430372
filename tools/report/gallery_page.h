// The index page of a gallery of holds.
#pragma once

#include <string>
#include <vector>

#include "tools/report/report.h"

namespace retarget::report {

struct GalleryEntry {
  std::string name;  // of the hold, and of its folder beside the page
  std::string text;  // about it, Markdown paragraphs; may be empty
  Json report;
};

// One page: a table of all holds against what is required, then each with its strip
// (NAME/strip.png), text and metrics and a link to NAME/report.html.
std::string FormatGallery(const std::vector<GalleryEntry>& entries);

// A run in one line: "met, tags 2, s GLI 0.94 (simulated 0.94), ...".
std::string GalleryLine(const Json& report);

}  // namespace retarget::report
