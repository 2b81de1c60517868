// The function solve() and the class Solution.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <utility>

#include "apps/camera_arguments.h"
#include "apps/export_file.h"
#include "apps/options_used.h"
#include "apps/report.h"
#include "apps/solve_run.h"
#include "python/arrays.h"
#include "python/background_work.h"
#include "python/bindings.h"
#include "python/python_errors.h"
#include "python/python_mesh.h"
#include "python/python_solution.h"
#include "python/solve_keywords.h"
#include "solver/base/check.h"
#include "solver/base/whole_file.h"
#include "solver/visibility/exact/occlusion_methods.h"

namespace penumbra {
namespace {

namespace py = pybind11;

using SolutionPointer = std::shared_ptr<PythonSolution>;

// The texts of JSON as objects of Python.
py::object FromJson(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

void WarnOfMissedError(const PythonSolution& solution) {
  const PipelineReport& report = solution.pipeline().report();
  for (const std::string& warning : report.warnings) Warn(warning);
  const std::string missed = MissedErrorMessage(report);
  if (!missed.empty()) Warn(fmt::format("{}: warning: {}", solution.scene().arguments.scene, missed));
}

SolutionPointer Solve(const PythonScene& scene, const py::kwargs& given) {
  py::object progress = py::none();
  bool measure = false;
  PythonScene solved = scene;
  PipelineOptions& solving = solved.arguments.solving;
  std::vector<Keyword> keywords = SolveKeywords(&solving);
  keywords.push_back(BoolKeyword("measure", &measure));
  keywords.push_back(ObjectKeyword("progress", &progress));
  TakeKeywords("solve", given, keywords);
  CheckSolveKeywords(given, solving, *scene.scene);
  SolutionPointer solution;
  RunInBackground(progress, [&](const ExecutionContext& context) {
    auto pipeline = std::make_unique<Pipeline>(*scene.scene, solving);
    RunPlan plan;
    plan.kind = MeshKind::kInterpolant;
    plan.measure = measure;
    RunStages(plan, pipeline.get(), context);
    nlohmann::ordered_json options = OptionsUsed(solved.arguments, &pipeline->resolved());
    solution = std::make_shared<PythonSolution>(solved, std::move(pipeline), std::move(options), measure);
  });
  WarnOfMissedError(*solution);
  return solution;
}

std::vector<Measurement> MeasurePoints(const PythonSolution& solution, const std::vector<ProbePoint>& points,
                                       const ProbeRequest& request, const py::object& progress) {
  const std::vector<std::string> methods = OcclusionNames();
  if (std::find(methods.begin(), methods.end(), request.method) == methods.end())
    throw InputError(
        fmt::format("there is no method '{}'; give one of {}", request.method, fmt::join(methods, ", ")));
  std::vector<Measurement> measurements;
  RunInBackground(progress, [&](const ExecutionContext& context) {
    measurements = solution.Probe(points, request, context);
  });
  CheckMeasurements(measurements);
  const std::string warning = SurroundingsWarning(measurements);
  if (!warning.empty()) Warn(warning);
  return measurements;
}

py::array_t<double> Column(const std::vector<Measurement>& measurements, Rgb Measurement::*member) {
  return ArrayOfRows(measurements.size(), [&](std::size_t i) { return measurements[i].*member; });
}

py::tuple TellIrradiance(const PythonSolution& solution, const py::object& points, const py::object& normals,
                         const std::string& method, const py::object& progress) {
  const std::vector<Measurement> measured =
      MeasurePoints(solution, ProbePointsOf(points, normals), {method, false}, progress);
  return py::make_tuple(Column(measured, &Measurement::exact), Column(measured, &Measurement::interpolated));
}

py::dict Probe(const PythonSolution& solution, const py::object& points, const py::object& normals,
               const std::string& method, const py::object& progress) {
  const std::vector<Measurement> measured =
      MeasurePoints(solution, ProbePointsOf(points, normals), {method, true}, progress);
  const auto count = static_cast<py::ssize_t>(measured.size());
  py::array_t<std::int32_t> patch(count);
  py::array_t<double> gradient({count, py::ssize_t{3}, py::ssize_t{3}});
  double* out = gradient.mutable_data();
  for (std::size_t i = 0; i < measured.size(); ++i) {
    patch.mutable_data()[i] = measured[i].footing.face;
    for (int channel = 0; channel < 3; ++channel)
      for (int axis = 0; axis < 3; ++axis) *out++ = measured[i].gradient(channel, axis);
  }
  py::dict all;
  all["patch"] = patch;
  all["exact"] = Column(measured, &Measurement::exact);
  all["interpolated"] = Column(measured, &Measurement::interpolated);
  all["direct"] = Column(measured, &Measurement::direct);
  all["gradient"] = gradient;
  return all;
}

PythonMesh MeshOf(const SolutionPointer& solution) {
  return {std::shared_ptr<const IrradianceMesh>(solution, &solution->pipeline().mesh()),
          solution->scene().scene};
}

void MeasureSolution(PythonSolution& solution, const py::object& progress) {
  RunInBackground(progress, [&](const ExecutionContext& context) {
    const std::lock_guard lock(solution.Busy());
    solution.Measure(context);
  });
}

py::object Measure(PythonSolution& solution, const py::object& progress) {
  MeasureSolution(solution, progress);
  WarnOfMissedError(solution);
  const auto lock = LockWithoutGil(solution.Busy());
  return FromJson(ReportJson({solution.options(), 0, solution.pipeline().report()}));
}

py::object Report(const PythonSolution& solution) {
  const auto lock = LockWithoutGil(solution.Busy());
  return FromJson(ReportJson({solution.options(), 0, solution.pipeline().report()}));
}

void Save(PythonSolution& solution, const py::object& path, const py::object& progress) {
  const std::string to = BytesOf(path);
  CheckCanWrite(to);
  MeasureSolution(solution, progress);
  const auto lock = LockWithoutGil(solution.Busy());
  // Other modules, too, use HDF5 under Python's lock: it takes one thread at a time.
  WriteWholeFile(to, solution.FileBytes());
}

void ExportSolution(const PythonSolution& solution, const py::object& path, const py::object& exposure,
                    const py::object& camera) {
  const std::string to = BytesOf(path);
  if (ExportFormatError(to) || !ExportsMesh(to))
    throw InputError(fmt::format(
        "{}: error: {}", to, ExportFormatError(to).value_or("a scene is written to it; use Scene.save()")));
  const Scene& scene = *solution.scene().scene;
  ExportMesh(to, {scene, solution.pipeline().mesh(),
                  camera.is_none() ? ChooseCamera(scene, {}) : camera.cast<Camera>(),
                  exposure.is_none() ? std::nullopt : std::optional(exposure.cast<double>())});
}

std::string SolveDoc() {
  return R"(solve(scene, *, error=0.02, measure=False, progress=None, **options) -> Solution

Computes the light in a scene.

error: the relative error of what is shown that 99 points in 100 shall not exceed; all else follows from it.
measure: measure the error and the energy balance as well, which Solution.measure() does later.
progress: a function (phase: str, fraction: float), called now and then; what it raises ends the work.

Ctrl-C ends the work. Other threads of Python run meanwhile, and several may solve at once.
Raises TypeError for an option that is not there, InputError for a value that cannot be; warns with PenumbraWarning
if the error asked for is seen to be missed. None as the value of an option leaves the default.

All options, with their units, as on the command line with '_' instead of '-'; options() returns the list:
)" + OptionsText();
}

constexpr const char* kIrradianceDoc =
    R"(irradiance(points, normals, method="auto", progress=None) -> (exact, interpolated)

Irradiance at points in W/m^2, as the command `probe` tells, to the bit: two arrays of shape (n, 3), of red, green
and blue.

points: positions [m], of shape (n, 3) or (3,). A point may lie on a face or in space, as a light meter.
normals: where the meter looks, of the same shape, of any length; or one for all, (3,).
method: how occlusion is found: "auto", the fastest exact one; "clipping", "backprojection" and "vertex-tracing"
    are exact, too; "sampled".

exact is the irradiance from the whole scene, with exact form factors and exact visibility. interpolated is the value
of the mesh where a point lies on the front of a face, else nan.
Raises InputError for arrays of another shape; warns of points behind faces, inside solids or far outside.)";

constexpr const char* kProbeDoc = R"(probe(points, normals, method="auto", progress=None) -> dict

As irradiance(), with more about each point:
"patch": the number of the face on whose front the point lies, else -1, of shape (n,);
"exact", "interpolated": as irradiance() gives them;
"direct": the part of exact that comes directly from what emits [W/m^2], of shape (n, 3);
"gradient": of exact by the point's position, its normal fixed [W/m^3], of shape (n, 3, 3): channel, axis.)";

void BindFiles(py::class_<PythonSolution, SolutionPointer>& solution) {
  solution
      .def("save", &Save, py::arg("path"), py::arg("progress") = py::none(),
           "save(path, progress=None)\n\nWrites the solution to a file, which Solution.load() and the "
           "command line "
           "read. Measures the error first,\nunless that has been done. Raises InputError if the file cannot "
           "be "
           "written; an old file then stays whole.")
      .def_static(
          "load", [](const py::object& path) { return PythonSolution::Load(BytesOf(path)); }, py::arg("path"),
          "load(path) -> Solution\n\nReads a file that save() or `penumbra solve -o` wrote. Raises "
          "InputError if it "
          "is none, or damaged.")
      .def("export", &ExportSolution, py::arg("path"), py::arg("exposure") = py::none(),
           py::arg("camera") = py::none(),
           "export(path, exposure=None, camera=None)\n\nThe camera, a Camera, goes into formats that hold "
           "one. Writes the mesh with its light for other programs, by the ending "
           "of the "
           "path, for example .vtu, .ply or .glb.\nexposure: brightness per W/m^2 where the format holds "
           "colours; "
           "metered if None. Raises InputError.");
}

}  // namespace

void BindSolution(py::module_& module) {
  static const std::string solve_doc = SolveDoc();
  module.def("solve", &Solve, py::arg("scene"), solve_doc.c_str());
  module.def(
      "options", &DescribeOptions,
      "options() -> dict\n\nThe options of solve(): {name: {\"kind\", \"unit\", \"default\", \"choices\", "
      "\"solver\", \"group\", \"help\"}}.\nThe default is None where it follows from other options.");
  py::class_<PythonSolution, SolutionPointer> solution(
      module, "Solution",
      "The light in a scene, as solve() or Solution.load() gives it. Several threads may use it.");
  solution
      .def("irradiance", &TellIrradiance, py::arg("points"), py::arg("normals"), py::arg("method") = "auto",
           py::arg("progress") = py::none(), kIrradianceDoc)
      .def("probe", &Probe, py::arg("points"), py::arg("normals"), py::arg("method") = "auto",
           py::arg("progress") = py::none(), kProbeDoc)
      .def("measure", &Measure, py::arg("progress") = py::none(),
           "measure(progress=None) -> dict\n\nMeasures the error at random points and the energy balance, "
           "unless "
           "that has been done, and returns the report.")
      .def_property_readonly("scene", &PythonSolution::scene, "The scene.")
      .def_property_readonly("mesh", &MeshOf, "The mesh that is shown, with its interpolants: a Mesh.")
      .def_property_readonly(
          "report", &Report,
          "Times, counts, iterations, energy balance and error, as `--report` writes them: a dict. "
          "Error and energy\nare there after measure().")
      .def_property_readonly(
          "options",
          [](const PythonSolution& s) {
            return FromJson(
                s.options().dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
          },
          "All options that the solve used, those that were left out, too: a dict.")
      .def("__repr__", [](const PythonSolution& s) {
        return fmt::format("<penumbra.Solution of '{}': {} triangles>", InPythonWords(s.scene().scene->name),
                           s.pipeline().mesh().triangles.size());
      });
  BindFiles(solution);
}

}  // namespace penumbra
