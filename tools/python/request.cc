#include "tools/python/request.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <functional>
#include <map>

#include "io/text/nearest_name.h"
#include "io/text/read_file.h"

namespace retarget::python {
namespace {

// A value as `--set` takes it.
std::string TextOf(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::string text;
    for (const py::handle& item : value) text += (text.empty() ? "" : " ") + TextOf(item);
    return text;
  }
  return py::str(value);
}

void Set(const std::string& prefix, const py::dict& values, Settings* settings) {
  for (const auto& [key, value] : values) {
    const std::string name = prefix + std::string(py::str(key));
    if (py::isinstance<py::dict>(value)) {
      Set(name + ".", py::reinterpret_borrow<py::dict>(value), settings);
    } else {
      io::SetByName(settings, name + "=" + TextOf(value), "settings");
    }
  }
}

using Setter = std::function<void(io::ClipOptions*, const py::handle&)>;

template <typename T>
Setter Field(T io::ClipOptions::*field) {
  return
      [field](io::ClipOptions* clip, const py::handle& value) { clip->*field = value.cast<T>(); };
}

const std::map<std::string, Setter>& ClipFields() {
  static const Setter units = [](io::ClipOptions* clip, const py::handle& value) {
    clip->units = std::string(py::str(value));  // 0.01, too
  };
  static const auto path = [](std::string io::ClipOptions::*field) -> Setter {
    return [field](io::ClipOptions* clip, const py::handle& value) {
      clip->*field = PathText(py::reinterpret_borrow<py::object>(value));
    };
  };
  static const std::map<std::string, Setter> fields = {
      {"start", Field(&io::ClipOptions::start)},
      {"stature", Field(&io::ClipOptions::stature)},
      {"units", units},
      {"up", Field(&io::ClipOptions::up)},
      {"map", path(&io::ClipOptions::map)},
      {"repair", Field(&io::ClipOptions::repair_jumps)},
      {"keep_in_place", Field(&io::ClipOptions::keep_in_place)},
      {"skip_frames", Field(&io::ClipOptions::skip_frames)},
      {"ik_targets", Field(&io::ClipOptions::ik_targets)},
      {"amc_fps", Field(&io::ClipOptions::amc_fps)},
      {"character", path(&io::ClipOptions::character)},
      {"character_map", path(&io::ClipOptions::character_map)},
      {"skeleton_bytes",
       [](io::ClipOptions* clip, const py::handle& value) {
         clip->skeleton_bytes = std::string(py::reinterpret_borrow<py::bytes>(value));
       }},
      {"name", Field(&io::ClipOptions::path)}};
  return fields;
}

}  // namespace

std::string PathText(const py::object& path) {
  return py::str(py::module_::import("os").attr("fspath")(path));
}

Settings SettingsOf(const py::dict& settings) {
  Settings out;
  Set("", settings, &out);
  return out;
}

py::dict DefaultSettings() {
  py::dict out;
  const Settings defaults;
  VisitSettings(defaults, [&](const std::string& key, const auto& value, auto&&...) {
    const size_t dot = key.find('.');
    const py::str group = key.substr(0, dot);
    if (!out.contains(group)) out[group] = py::dict();
    out[group][py::str(key.substr(dot + 1))] = Written(value);
  });
  return out;
}

io::ClipOptions ClipOf(const py::object& source, const py::kwargs& options) {
  io::ClipOptions clip;
  clip.words = {.units = "units",
                .stature = "stature",
                .up = "up",
                .skip_frames = "skip_frames",
                .start = "start",
                .repair = "repair",
                .travel = "keep_in_place",
                .ik_targets = "ik_targets",
                .character = "character",
                .map_by_hand = "`retarget map {} --yaml > clip.map.yaml`, edit it, give it as map"};
  if (py::isinstance<py::bytes>(source)) {
    clip.bytes = std::string(source.cast<py::bytes>());
    clip.path = "clip";
  } else {
    clip.path = PathText(source);
  }
  for (const auto& [key, value] : options) {
    const std::string name = py::str(key);
    const auto field = ClipFields().find(name);
    if (field == ClipFields().end()) {
      std::vector<std::string> names;
      for (const auto& [known, setter] : ClipFields()) names.push_back(known);
      throw InputError(fmt::format("unknown option \"{}\"{}", name, io::Suggestion(name, names)));
    }
    if (value.is_none()) continue;
    try {
      field->second(&clip, value);
    } catch (const py::cast_error&) {
      throw InputError(fmt::format("{}: found {}", name, std::string(py::repr(value))));
    }
  }
  return clip;
}

Template TemplateOf(const py::object& source) {
  Template out;
  const bool is_text =
      py::isinstance<py::str>(source) && source.cast<std::string>().find('\n') != std::string::npos;
  out.name = is_text ? "template" : PathText(source);
  out.text = is_text ? source.cast<std::string>() : io::ReadFile(out.name);
  out.posture = io::ParseTemplate(out.text, out.name);
  return out;
}

}  // namespace retarget::python
