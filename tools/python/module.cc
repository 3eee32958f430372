// The Python module `retarget`: the library's face with numpy arrays (docs/python.md).
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "io/clip_file.h"
#include "io/files.h"
#include "model/body/path.h"
#include "model/geometry/polyline.h"
#include "solver/start/fit_template.h"
#include "tools/api/template_check.h"
#include "tools/python/arrays.h"
#include "tools/python/request.h"

namespace retarget::python {
namespace {

const char* NameOf(Status status) {
  switch (status) {
    case Status::kSolved:
      return "solved";
    case Status::kRequirementMissed:
      return "requirement_missed";
    case Status::kLimitReached:
      return "limit_reached";
    case Status::kInterrupted:
      break;
  }
  return "interrupted";
}

py::dict IterationDict(const solver::Iteration& i) {
  py::dict out;
  out["stage"] = i.stage;
  out["iteration"] = i.index;
  out["cost"] = i.cost;
  out["step_m"] = i.step_m;
  out["smallest_gli"] = i.smallest_gli;
  out["penetration_m"] = i.deepest_penetration_m;
  out["hold_m"] = i.hold_error_m;
  out["seconds"] = i.seconds;
  return out;
}

io::ClipOptions AsClip(const py::object& clip) {
  if (py::isinstance<io::ClipOptions>(clip)) return clip.cast<io::ClipOptions>();
  return ClipOf(clip, {});
}

Template AsTemplate(const py::object& posture) {
  if (py::isinstance<Template>(posture)) return posture.cast<Template>();
  return TemplateOf(posture);
}

std::unique_ptr<Result> RunFromPython(const py::object& clip_a, const py::object& clip_b,
                                      const py::object& posture, const py::dict& settings,
                                      double fps, const std::optional<std::pair<int, int>>& frames,
                                      double template_at, const std::string& show,
                                      const std::string& rest, bool page,
                                      const std::vector<std::string>& also,
                                      const py::object& progress) {
  Request request;
  request.clip = {AsClip(clip_a), AsClip(clip_b)};
  const Template chosen = AsTemplate(posture);
  request.template_path = chosen.name;
  request.template_text = chosen.text;
  request.settings = SettingsOf(settings);
  request.fps = fps;
  if (frames) request.frames = FrameRange{frames->first, frames->second};
  request.template_at = template_at;
  request.page = page;
  request.also = also;
  request.words = {.frames = "frames",
                   .template_at = "template_at",
                   .show = "show",
                   .rest = "rest",
                   .also = "also"};
  if (!(fps >= 1 && fps <= 1000)) throw InputError(fmt::format("fps {}: expected 1 to 1000", fps));
  if (show != "figures" && show != "characters") {
    throw InputError("show: expected \"figures\" or \"characters\", found \"" + show + "\"");
  }
  if (rest != "keep" && rest != "t-pose") {
    throw InputError("rest: expected \"keep\" or \"t-pose\", found \"" + rest + "\"");
  }
  request.show = show == "characters" ? Show::kCharacters : Show::kFigures;
  request.rest = rest == "t-pose" ? Rest::kTPose : Rest::kKeep;

  std::exception_ptr stopped;  // Ctrl-C, or what `progress` raised
  std::unique_ptr<Result> result;
  {
    const py::gil_scoped_release other_threads_run;
    result = std::make_unique<Result>(Run(request, [&](const solver::Iteration& iteration) {
      const py::gil_scoped_acquire gil;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (progress.is_none()) return true;
        const py::object answer = progress(IterationDict(iteration));
        return !(py::isinstance<py::bool_>(answer) && !answer.cast<bool>());
      } catch (...) {
        stopped = std::current_exception();
        return false;
      }
    }));
  }
  if (stopped) std::rethrow_exception(stopped);
  return result;
}

py::dict TanglesDict(const std::array<Body, 2>& body, const solver::TemplateTangles& tangles,
                     const std::vector<HandContact>& contacts) {
  report::Json out = {{"literal", report::Json::array()}, {"tags", report::Json::array()}};
  for (const Tangle& t : tangles.literal) {
    out["literal"].push_back(api::TangleJson(body[0], body[1], t));
  }
  for (const Tag& tag : tangles.tags) {
    report::Json entry = api::TangleJson(body[0], body[1], tag.tangle);
    entry["rho"] = tag.rho;
    entry["group_size"] = tag.group_size;
    out["tags"].push_back(entry);
  }
  out["contacts"] = api::ContactsJson(body, contacts);
  return JsonObject(out);
}

py::dict TanglesOf(const py::object& posture, const py::object& other, const py::dict& settings) {
  const Settings all = SettingsOf(settings);
  const TangleSettings& tangle = all.tangle;
  if (other.is_none()) {
    const Template chosen = AsTemplate(posture);
    return TanglesDict(chosen.posture.body, solver::FindTemplateTangles(chosen.posture, tangle),
                       HandContactsOf(chosen.posture, all.hand_contact.reach_m));
  }
  const Body body = StandardBody(AverageMeasures(1.75));
  const std::vector<Vec3> a = PointsOf(posture.cast<Array>(), "positions of a"),
                          b = PointsOf(other.cast<Array>(), "positions of b");
  for (const auto* nodes : {&a, &b}) {
    if (nodes->size() != body.nodes.size()) {
      throw InputError(
          fmt::format("expected {} node positions, found {}", body.nodes.size(), nodes->size()));
    }
  }
  const MatX table = SegmentGliTable(body, a, body, b);
  solver::TemplateTangles found;
  found.literal = FindTangles(body, body, table);
  found.tags = ReduceTangles(body, PosedFromNodes(body, a), body, PosedFromNodes(body, b),
                             found.literal, table, solver::ReductionOf(tangle));
  const std::array<Body, 2> bodies = {body, body};
  return TanglesDict(bodies, found,
                     FindHandContacts(bodies, {PosedFromNodes(body, a), PosedFromNodes(body, b)},
                                      all.hand_contact.reach_m));
}

py::object Gli(const Array& p, const Array& q, bool gradient) {
  const std::vector<Vec3> points_p = PointsOf(p, "p"), points_q = PointsOf(q, "q");
  if (points_p.size() < 2 || points_q.size() < 2) {
    throw InputError("gli: a polyline has two points or more");
  }
  if (!gradient) return py::float_(PolylineGli(points_p, points_q));
  const PathGli gli = PolylineGliWithGradient(points_p, points_q);
  return py::make_tuple(gli.value, ArrayOf(gli.gradient_p), ArrayOf(gli.gradient_q));
}

py::dict Motions(const Result& result, const std::array<Clip, 2>& clips) {
  py::dict out;
  for (int f = 0; f < 2; ++f) {
    out[report::kFigure[f]] = Motion(result.run.scene.body[f], clips[f]);
  }
  return out;
}

void AddClasses(py::module_* module) {
  py::class_<io::ClipOptions>(
      *module, "Clip",
      "A clip of one figure: BVH, glTF, VRM, VRMA or Acclaim, by path or as\n"
      "bytes, with what its file does not say.")
      .def(py::init([](const py::object& source, const py::kwargs& options) {
             return ClipOf(source, options);
           }),
           py::arg("source"))
      .def_readonly("path", &io::ClipOptions::path, "Path, or the name that messages use.")
      .def("__repr__", [](const io::ClipOptions& c) { return "retarget.Clip('" + c.path + "')"; })
      .def(
          "arrays",
          [](const io::ClipOptions& clip) {
            if (clip.bytes.empty()) {
              return RigArrays(io::ReadClipFile(io::ParseClipPath(clip.path), clip.amc_fps).motion);
            }
            const io::ClipPath path = io::ParseClipName(clip.path, !clip.skeleton_bytes.empty());
            return RigArrays(
                io::ParseClipFile(path, clip.bytes, clip.skeleton_bytes, clip.amc_fps).motion);
          },
          "The file's own joints, in its units and axes: a dict of names [J], parents [J] (-1: a\n"
          "root), offsets [J, 3], rotations [T, J, 4] (local, [x, y, z, w]), translations\n"
          "[T, J, 3] (local), fps.");

  py::class_<Template>(*module, "Template",
                       "A template posture: a path, or YAML as a text of several lines.")
      .def(py::init(&TemplateOf), py::arg("source"))
      .def_property_readonly("name", [](const Template& t) { return t.posture.name; })
      .def_property_readonly("description", [](const Template& t) { return t.posture.description; })
      .def_property_readonly("keywords", [](const Template& t) { return t.posture.keywords; })
      .def_readonly("text", &Template::text, "The YAML.")
      .def_property_readonly(
          "positions",
          [](const Template& t) {
            py::dict out;
            for (int f = 0; f < 2; ++f) {
              out[report::kFigure[f]] =
                  ArrayOf(PoseBody(t.posture.body[f], t.posture.pose[f]).node);
            }
            return out;
          },
          "Node positions of a and b, [21, 3] each (m).")
      .def("__repr__",
           [](const Template& t) { return "retarget.Template('" + t.posture.name + "')"; });

  py::class_<Result>(*module, "Result", "What a run comes to.")
      .def_property_readonly(
          "status", [](const Result& r) { return NameOf(r.status); },
          "\"solved\", \"requirement_missed\", \"limit_reached\" or \"interrupted\".")
      .def_property_readonly(
          "exit_code", [](const Result& r) { return ExitCodeOf(r.status); },
          "That of the command line: 0, 3, 4 or 130.")
      .def_property_readonly(
          "solved", [](const Result& r) { return Motions(r, r.solved()); },
          "{\"a\": Motion, \"b\": Motion} of the solved scene.")
      .def_property_readonly(
          "source", [](const Result& r) { return Motions(r, r.source()); },
          "The same of the placed clips before editing.")
      .def_property_readonly(
          "baseline", [](const Result& r) { return Motions(r, r.baseline()); },
          "The same of the forward simulation.")
      .def_property_readonly(
          "report", [](const Result& r) { return JsonObject(r.File("report.json")); },
          "report.json as a dict (docs/report.md).")
      .def_property_readonly(
          "metrics",
          [](const Result& r) {
            return JsonObject(
                report::Json::parse(r.File("report.json")).at("metrics").at("result"));
          },
          "Metrics of the solved scene, as report.json has them (docs/metrics.md).")
      .def_readonly("notes", &Result::notes, "What a user should know, a line each.")
      .def_property_readonly(
          "files",
          [](const Result& r) {
            py::dict out;
            for (const io::NamedBytes& file : r.files) {
              out[py::str(file.name)] = py::bytes(file.bytes);
            }
            return out;
          },
          "{name: bytes} of every file that the command line writes.")
      .def(
          "save",
          [](const Result& r, const py::object& folder, bool force) {
            std::vector<std::string> names;
            for (const io::NamedBytes& file : r.files) names.push_back(file.name);
            io::OutputSet output(PathText(folder), names, {}, force);
            for (const io::NamedBytes& file : r.files) output.Add(file.name, file.bytes);
            output.Commit();
          },
          py::arg("folder"), py::arg("force") = false,
          "Writes all files to a folder, all or none. What no run wrote is overwritten only with\n"
          "force.");
}

constexpr const char* kRunText = R"(Two clips and a template in, a solved and verified scene out.

clip_a, clip_b: a path, the bytes of a file, or a Clip.
template: a path, YAML as text, or a Template.
settings: {"weights.tangle": 20} or nested dicts; default_settings() shows all.
fps: of the scene; frames: (first, last) of it, half-open; template_at: s from the clips' starts.
show: what scene.glb shows, "figures" or "characters"; rest: "keep" or "t-pose" (BVH).
page: whether report.html is made; also: more files, ["npz", "csv"].
progress: called after each iteration with a dict (stage, iteration, cost, step_m, smallest_gli,
    penetration_m, hold_m, seconds); False stops the solve, the best so far is the result.

Other threads run meanwhile; Ctrl-C ends the solve and raises KeyboardInterrupt. What cannot be
done is an InputError, one line. Lengths are metres, times seconds, Y is up.)";

constexpr const char* kTanglesText =
    R"(What is tangled in a posture (Ho and Komura 2007, Algorithm 1).

template: a path, YAML as text, or a Template; or the node positions of a, [21, 3] (m), and
other: those of b.
Returns {"literal": [{"a": [from, to], "b": [from, to], "gli": turns}, ...],
"tags": [the same with rho and group_size, ...]}.)";

constexpr const char* kGliText = R"(The Gauss Linking Integral of two polylines (turns).

p: [m, 3], q: [n, 3], any unit of length. With gradient=True a tuple (value, d value / d p [m, 3],
d value / d q [n, 3]), in turns per unit. 0 for segments that touch or lie in one plane.)";

}  // namespace
}  // namespace retarget::python

PYBIND11_MODULE(_retarget, module) {
  using namespace retarget;
  using namespace retarget::python;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  AddMotion(&module);
  AddClasses(&module);
  const py::dict none;
  module.attr("__version__") = Version();
  module.def("run", &RunFromPython, py::arg("clip_a"), py::arg("clip_b"), py::arg("template"),
             py::arg("settings") = none, py::kw_only(), py::arg("fps") = 30.0,
             py::arg("frames") = py::none(), py::arg("template_at") = 0.0,
             py::arg("show") = "figures", py::arg("rest") = "keep", py::arg("page") = true,
             py::arg("also") = std::vector<std::string>(), py::arg("progress") = py::none(),
             kRunText);
  module.def("tangles", &TanglesOf, py::arg("template"), py::arg("other") = py::none(),
             py::arg("settings") = none, kTanglesText);
  module.def("gli", &Gli, py::arg("p"), py::arg("q"), py::kw_only(), py::arg("gradient") = false,
             kGliText);
  module.def("default_settings", &DefaultSettings,
             "Every setting with its default, as nested dicts.");
}
