// The class Solver: a solve that is made step by step.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <functional>
#include <utility>

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

namespace penumbra {
namespace {

namespace py = pybind11;

using SolverPointer = std::unique_ptr<PythonSolver>;

SolverPointer MakeSolver(const PythonScene& scene, const py::kwargs& given) {
  auto solver = std::make_unique<PythonSolver>();
  solver->scene = scene;
  PipelineOptions& solving = solver->scene.arguments.solving;
  TakeKeywords("Solver", given, SolveKeywords(&solving));
  CheckSolveKeywords(given, solving, *scene.scene);
  solver->pipeline = std::make_unique<Pipeline>(*scene.scene, solving);
  solver->options = OptionsUsed(solver->scene.arguments, &solver->pipeline->resolved());
  return solver;
}

// Works with the pipeline in the background.
void Work(PythonSolver& solver, const py::object& progress,
          const std::function<void(Pipeline&, const ExecutionContext&)>& work) {
  RunInBackground(progress, [&](const ExecutionContext& context) {
    const std::lock_guard lock(solver.busy);
    if (!solver.pipeline) throw InputError("the solver is finished; make another, or use its solution");
    work(*solver.pipeline, context);
  });
}

std::string NameOfNext(const PythonSolver& solver, const Pipeline& pipeline) {
  if (!solver.linked) return "link";
  const std::optional<SolverStep> next = pipeline.NextStep();
  return next ? std::string(StepName(*next)) : "";
}

py::object NameOrNone(const std::string& name) {
  return name.empty() ? py::object(py::none()) : py::object(py::str(name));
}

py::object Next(PythonSolver& solver) {
  std::string name;
  const auto lock = LockWithoutGil(solver.busy);
  if (solver.pipeline) name = NameOfNext(solver, *solver.pipeline);
  return NameOrNone(name);
}

py::object Step(PythonSolver& solver, const py::object& progress) {
  std::string name;
  Work(solver, progress, [&](Pipeline& pipeline, const ExecutionContext& context) {
    name = NameOfNext(solver, pipeline);
    if (!solver.linked) {
      pipeline.Link(context);
      solver.linked = !context.Cancelled();
    } else if (const std::optional<SolverStep> next = pipeline.NextStep()) {
      pipeline.Step(*next, context);
    }
  });
  return NameOrNone(name);
}

std::shared_ptr<PythonSolution> Finish(PythonSolver& solver, const py::object& progress) {
  bool done = false;
  Work(solver, progress, [&](Pipeline& pipeline, const ExecutionContext& context) {
    RunPlan plan;
    plan.kind = MeshKind::kInterpolant;
    RunStages(plan, &pipeline, context);
    done = !context.Cancelled();
    solver.linked = solver.linked || done;
  });
  const auto lock = LockWithoutGil(solver.busy);
  if (!solver.pipeline) throw InputError("another thread has finished the solver");
  return std::make_shared<PythonSolution>(solver.scene, std::move(solver.pipeline), std::move(solver.options),
                                          false);
}

// Needs the light of a step.
void DemandLink(const PythonSolver& solver) {
  if (!solver.linked) throw InputError("nothing is linked yet; call step() first");
}

PythonMesh MeshOfStep(PythonSolver& solver, const std::string& kind, const py::object& progress) {
  const std::vector<std::pair<std::string, MeshKind>> kinds = {{"flat", MeshKind::kFlat},
                                                               {"gouraud", MeshKind::kGouraud},
                                                               {"gouraud-mesh", MeshKind::kGouraudMesh},
                                                               {"interpolant", MeshKind::kInterpolant}};
  std::optional<MeshKind> wanted;
  for (const auto& [name, value] : kinds)
    if (name == kind) wanted = value;
  if (!wanted)
    throw InputError(
        fmt::format("there is no mesh '{}'; give flat, gouraud, gouraud-mesh or interpolant", kind));
  std::shared_ptr<const IrradianceMesh> mesh;
  Work(solver, progress, [&](Pipeline& pipeline, const ExecutionContext& context) {
    DemandLink(solver);
    pipeline.BuildMesh(*wanted, context, true);
    mesh = std::make_shared<const IrradianceMesh>(pipeline.mesh());  // the next step makes another
  });
  return {mesh, solver.scene.scene};
}

py::array_t<double> IrradianceOfStep(PythonSolver& solver, const py::object& points,
                                     const py::object& normals, const py::object& progress) {
  const std::vector<ProbePoint> list = ProbePointsOf(points, normals);
  std::vector<Measurement> measured;
  Work(solver, progress, [&](Pipeline& pipeline, const ExecutionContext& context) {
    DemandLink(solver);
    const PointIrradiance irradiance(pipeline.solution(), pipeline.visibility(), pipeline.options().point);
    measured = Prober(pipeline.scene(), irradiance, nullptr, false).Measure(list, context);
  });
  CheckMeasurements(measured);
  return ArrayOfRows(measured.size(), [&](std::size_t i) { return measured[i].exact; });
}

// The light that all faces receive.
py::tuple ReceivedFlux(PythonSolver& solver) {
  const auto lock = LockWithoutGil(solver.busy);
  if (!solver.pipeline) throw InputError("the solver is finished; make another, or use its solution");
  DemandLink(solver);
  Rgb flux = Rgb::Zero();
  const std::vector<Patch>& patches = solver.scene.scene->patches;
  for (std::size_t i = 0; i < patches.size(); ++i)
    flux += patches[i].area * solver.pipeline->solution().irradiance[i];  // element i is the root of patch i
  return py::make_tuple(flux[0], flux[1], flux[2]);
}

py::object ReportOfSteps(PythonSolver& solver) {
  const auto lock = LockWithoutGil(solver.busy);
  if (!solver.pipeline) throw InputError("the solver is finished; make another, or use its solution");
  return py::module_::import("json").attr("loads")(
      ReportJson({solver.options, 0, solver.pipeline->report()}));
}

constexpr const char* kSolverDoc = R"(Solver(scene, **options)

A solve that is made step by step, to look at the light in between. The options are those of solve().

    solver = penumbra.Solver(scene, error=0.05)
    while solver.step():
        print(solver.flux)
    solution = solver.finish()

Raises what solve() raises.)";

}  // namespace

void BindSolver(py::module_& module) {
  py::class_<PythonSolver, SolverPointer>(module, "Solver", kSolverDoc)
      .def(py::init(&MakeSolver), py::arg("scene"), kSolverDoc)
      .def("step", &Step, py::arg("progress") = py::none(),
           "step(progress=None) -> str or None\n\nMakes the next step, and returns its name: \"link\" finds "
           "what sees "
           "what; \"iterate\" gathers light and refines;\n\"correct\" makes the light exact. None if no step "
           "was left. "
           "After Ctrl-C the light is that of the step before.")
      .def("finish", &Finish, py::arg("progress") = py::none(),
           "finish(progress=None) -> Solution\n\nMakes all steps that are left, refines the light and makes "
           "the mesh. "
           "The solution is that of solve(), to the bit.\nThe solver can do no more afterwards.")
      .def("mesh", &MeshOfStep, py::arg("kind") = "interpolant", py::arg("progress") = py::none(),
           "mesh(kind=\"interpolant\", progress=None) -> Mesh\n\nA mesh of the light after the last step, "
           "not refined "
           "by what it shows. kind: \"flat\" (a value for each element),\n\"gouraud\", \"gouraud-mesh\" or "
           "\"interpolant\".")
      .def("irradiance", &IrradianceOfStep, py::arg("points"), py::arg("normals"),
           py::arg("progress") = py::none(),
           "irradiance(points, normals, progress=None) -> array\n\nExact irradiance [W/m^2] from the light "
           "after the "
           "last step, of shape (n, 3); see Solution.irradiance().")
      .def_property_readonly("next", &Next,
                             "The name of the step that step() will make; None if none is left.")
      .def_property_readonly("flux", &ReceivedFlux,
                             "The light that all faces receive after the last step [W]: (r, g, b).")
      .def_property_readonly("report", &ReportOfSteps,
                             "As Solution.report: `counts` and `iterations` tell of the steps so far.");
}

}  // namespace penumbra
