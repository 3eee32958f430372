// What Python says of a run, as a request to the library.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "tools/api/retarget.h"

namespace retarget::python {

namespace py = pybind11;

// Settings of a dict: {"weights.tangle": 20} or {"weights": {"tangle": 20}}. Throws InputError.
Settings SettingsOf(const py::dict& settings);
// Every setting with its default, as nested dicts.
py::dict DefaultSettings();

// A clip: a path, or bytes with a name for messages. `options`: fields of io::ClipOptions by name.
io::ClipOptions ClipOf(const py::object& source, const py::kwargs& options);

// A template posture: a path, or YAML as text of several lines.
struct Template {
  std::string name, text;  // name: what messages call it
  TemplatePosture posture;
};
Template TemplateOf(const py::object& source);

// A path as text; of a str the same.
std::string PathText(const py::object& path);

}  // namespace retarget::python
