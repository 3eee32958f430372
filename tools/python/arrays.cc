#include "tools/python/arrays.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace retarget::python {
namespace {

// A view of `values`, which `owner` keeps.
py::array View(const std::vector<double>& values, const std::vector<py::ssize_t>& shape,
               const py::object& owner) {
  py::array_t<double> view(shape, values.data(), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

void Append(const Quat& rotation, std::vector<double>* out) {
  for (const double x : {rotation.x(), rotation.y(), rotation.z(), rotation.w()}) {
    out->push_back(x);
  }
}

void Append(const Vec3& point, std::vector<double>* out) {
  out->insert(out->end(), point.data(), point.data() + 3);
}

Array Copied(const std::vector<double>& values, const std::vector<py::ssize_t>& shape) {
  return Array(shape, values.data());
}

}  // namespace

std::vector<Vec3> PointsOf(const Array& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InputError(name + ": expected an array of points, [n, 3]");
  }
  std::vector<Vec3> points;
  for (py::ssize_t k = 0; k < array.shape(0); ++k) {
    points.emplace_back(array.at(k, 0), array.at(k, 1), array.at(k, 2));
    if (!points.back().allFinite()) {
      throw InputError(fmt::format("{}: point {} is not finite", name, k));
    }
  }
  return points;
}

Array ArrayOf(const std::vector<Vec3>& points) {
  std::vector<double> values;
  for (const Vec3& point : points) Append(point, &values);
  return Copied(values, {static_cast<py::ssize_t>(points.size()), 3});
}

Motion::Motion(const Body& body, const Clip& clip) : fps(clip.fps), frames(clip.num_frames()) {
  for (const Node& node : body.nodes) nodes.push_back(node.name);
  for (const Link& link : body.links) links.push_back(link.name);
  for (const Pose& pose : clip.frames) {
    for (const Vec3& node : PoseBody(body, pose).node) Append(node, &positions);
    for (const Quat& rotation : pose.rotation) Append(rotation, &rotations);
    Append(pose.root_position, &roots);
  }
}

py::object JsonObject(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

py::object JsonObject(const report::Json& json) { return JsonObject(json.dump()); }

py::dict RigArrays(const RigMotion& motion) {
  const auto joints = static_cast<py::ssize_t>(motion.rig.num_joints());
  const auto frames = static_cast<py::ssize_t>(motion.num_frames());
  std::vector<std::string> names;
  std::vector<int> parents;
  std::vector<double> offsets, rotations, translations;
  for (const RigJoint& joint : motion.rig.joints) {
    names.push_back(joint.name);
    parents.push_back(joint.parent);
    Append(joint.offset, &offsets);
  }
  for (const RigFrame& frame : motion.frames) {
    for (const Quat& rotation : frame.rotation) Append(rotation, &rotations);
    for (const Vec3& translation : frame.translation) Append(translation, &translations);
  }
  py::dict out;
  out["names"] = names;
  out["parents"] = parents;
  out["offsets"] = Copied(offsets, {joints, 3});
  out["rotations"] = Copied(rotations, {frames, joints, 4});
  out["translations"] = Copied(translations, {frames, joints, 3});
  out["fps"] = 1 / motion.frame_time;
  return out;
}

void AddMotion(py::module_* module) {
  py::class_<Motion>(*module, "Motion",
                     "The motion of one figure on the 20-segment body: arrays that are views of\n"
                     "the result and cannot be written to. Metres, Y up.")
      .def_readonly("fps", &Motion::fps, "Frames per second; frame k is at k / fps.")
      .def_readonly("nodes", &Motion::nodes, "Names of the J = 21 nodes.")
      .def_readonly("links", &Motion::links, "Names of the L = 19 links that turn.")
      .def("__len__", [](const Motion& m) { return m.frames; })
      .def_property_readonly(
          "positions",
          [](const py::object& self) {
            const Motion& m = self.cast<const Motion&>();
            return View(m.positions, {m.frames, static_cast<py::ssize_t>(m.nodes.size()), 3}, self);
          },
          "Node positions in the world, [T, J, 3] (m).")
      .def_property_readonly(
          "rotations",
          [](const py::object& self) {
            const Motion& m = self.cast<const Motion&>();
            return View(m.rotations, {m.frames, static_cast<py::ssize_t>(m.links.size()), 4}, self);
          },
          "Rotations of the links as unit quaternions [x, y, z, w], [T, L, 4]: [:, 0] is the\n"
          "root's in the world, every other is child in parent, against the T-pose.")
      .def_property_readonly(
          "root",
          [](const py::object& self) {
            const Motion& m = self.cast<const Motion&>();
            return View(m.roots, {m.frames, 3}, self);
          },
          "Root position in the world, [T, 3] (m).");
}

}  // namespace retarget::python
