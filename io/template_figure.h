// Bodies and poses of template postures. Inner part of io/template_file.h.
#pragma once

#include "io/text/document.h"
#include "model/body/body.h"
#include "model/body/pose.h"

namespace retarget::io {

// One figure: its body (`stature` or `lengths`, and `radii`) and its pose.
void ReadFigure(const Value& value, Body* body, Pose* pose);

}  // namespace retarget::io
