// Template postures as YAML, format version 1; docs/template_format.md describes it.
#pragma once

#include <string>

#include "model/body/template_posture.h"

namespace retarget::io {

// Reads a template on bodies of StandardBody's table. Strict: InputError with file:line and dotted
// path on unknown, missing or repeated keys, wrong types and values out of range.
TemplatePosture ReadTemplate(const std::string& path);
// The same of a text; `name` stands for the file in messages.
TemplatePosture ParseTemplate(const std::string& text, const std::string& name);

// The posture as YAML that reads back to it within 1e-6 rad and m. Bodies must have the links and
// nodes of StandardBody; of their lengths and radii everything is kept, of masses, joint limits and
// locked links nothing. A hold's relative rotation is not written: it is that of the posture.
std::string FormatTemplate(const TemplatePosture& posture);

}  // namespace retarget::io
