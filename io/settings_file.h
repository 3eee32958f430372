// Settings as YAML: the table of VisitSettings with its groups as nested maps.
//   weights: {tangle: 30}
//   solve:
//     backend: ceres
// Functions that read throw InputError on unknown or repeated keys, wrong types and values out of
// range, with the place, the dotted key and the nearest valid name.
#pragma once

#include <string>

#include "model/settings.h"

namespace retarget::io {

// The defaults, and over them the keys of the file. An empty file is all defaults.
Settings ReadSettings(const std::string& path);
// The same of a text; `name` stands for the file in messages.
Settings ParseSettings(const std::string& text, const std::string& name);

// Applies one "weights.tangle=20"; `name` is what messages call it. Leaves `settings` alone if it
// throws.
void SetByName(Settings* settings, const std::string& assignment,
               const std::string& name = "setting");

// Every key, each with its default, unit and meaning as a comment. Reads back to equal settings.
std::string FormatSettings(const Settings& settings);

}  // namespace retarget::io
