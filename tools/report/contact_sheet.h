// Pictures of a finished run: the same instants of its motions, one above the other.
#pragma once

#include <string>
#include <vector>

#include "io/render/image.h"
#include "model/body/template_posture.h"

namespace retarget::report {

// A column of a sheet.
struct SheetInstant {
  double share = 0.5;  // of the clip, 0 to 1
  double azimuth_deg =
      40;  // where from: 0 from the front of a as solved there, positive from his left
};

// Rows: source, simulated (where the run has it, if `baseline`), solved; columns: `instants`.
// Throws InputError where the folder holds no run.
io::Image ContactSheet(const std::string& folder, const std::vector<SheetInstant>& instants,
                       bool baseline, int width = 360, int height = 450);

// One instant of the solved motion, with a label above.
io::Image SolvedPicture(const std::string& folder, const SheetInstant& instant,
                        const std::string& label, int width, int height);

// A template posture from four sides: the front of a, his left, behind, his right.
io::Image TemplateSheet(const TemplatePosture& posture, int width = 360, int height = 420);

}  // namespace retarget::report
