// Between the library's values and numpy's arrays, which have no copies where that can be.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "model/body/pose.h"
#include "model/rig/rig.h"
#include "tools/report/report.h"

namespace retarget::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

// [n, 3]; `name` is the argument's. Throws InputError.
std::vector<Vec3> PointsOf(const Array& array, const std::string& name);
Array ArrayOf(const std::vector<Vec3>& points);  // [n, 3]

// A clip on a body, worked out once: what its arrays look into. They cannot be written to.
struct Motion {
  double fps = 30;
  std::vector<std::string> nodes, links;
  py::ssize_t frames = 0;
  std::vector<double> positions, rotations, roots;

  Motion(const Body& body, const Clip& clip);
};

py::object JsonObject(const report::Json& json);  // dict, list, ...
py::object JsonObject(const std::string& text);

// Names, parents, offsets, local rotations and translations of a file's own joints, as a dict.
py::dict RigArrays(const RigMotion& motion);

// Adds the class Motion to the module.
void AddMotion(py::module_* module);

}  // namespace retarget::python
