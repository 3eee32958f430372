// Bodies and poses of template postures. Inner part of io/template_file.h.
#pragma once

#include <string>

#include "io/text/yaml_reader.h"
#include "model/body/body.h"
#include "model/body/pose.h"

namespace retarget::io {

inline constexpr double kMaxPosition = 1000;  // m, of positions

// Three numbers of at most `most`.
Vec3 ReadVector(const YamlValue& value, double most, const std::string& unit);

// One figure: its body (`stature` or `lengths`, and `radii`) and its pose.
void ReadFigure(const YamlValue& value, Body* body, Pose* pose);

}  // namespace retarget::io
