// Pieces of the studio's answers. Inner part of tools/studio/routes.h.
#pragma once

#include <string>

#include "tools/report/report.h"
#include "tools/studio/routes.h"

namespace retarget::studio {

StudioAnswer JsonAnswer(const report::Json& json);

// A parameter of the address. Throws InputError where it is not there.
const std::string& Parameter(const StudioRequest& request, const std::string& name);

}  // namespace retarget::studio
