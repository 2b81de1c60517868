// mesh/pipeline/pipeline.h
//
// The offline half from a scene to its irradiance mesh, as stages that the command line, the viewer and the
// experiments drive alike: visibility, links, iterations, discontinuities, triangulations, interpolants.

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/interpolants/triangle_error.h"
#include "mesh/interpolants/triangle_quality.h"
#include "mesh/pipeline/discontinuity_list.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/diagnostics.h"
#include "solver/transport/solvers/energy.h"
#include "solver/transport/solvers/light_solver.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// What refinement goes by (thesis 4.4).
enum class RefineBy : std::uint8_t {
  kTransport,       // the error of links alone; the mesh has the solution's leaves
  kRepresentation,  // the error of what is shown, over a coarse solution
  kBoth,
};

// What a user may set. Everything left out follows from `error` and the scene.
struct PipelineOptions {
  double error = 0.02;  // asked for: 99th percentile of |shown - true| / max(true, 1 % of the channel's mean)
  std::optional<double> eps;                       // [W/m^2] thesis, Appendix A, 1
  std::optional<double> min_area;                  // [m^2] Appendix A, 2
  std::optional<double> min_discontinuity_weight;  // [W/m^2] Appendix A, 4
  std::optional<double> min_wanted_weight;         // [W/m^2] DiscontinuityOptions::min_wanted_weight
  int max_leaf_dsets = 10;                         // Appendix A, 5
  // Which discontinuities the mesh gets. The weight is the thesis's where its minimum is given, for that is
  // on its scale; else the irradiance weight.
  std::string discontinuities = "ranked";  // DiscontinuityOptions::choice
  std::optional<DiscontinuityWeight> weight;
  bool keep_hidden_discontinuities = false;
  double triple_edge_tolerance = 0;       // DiscontinuityOptions::triple_edge_tolerance [m]
  int corner_divisions = 0;               // DiscontinuityOptions::corner_divisions
  std::optional<double> relative_cutoff;  // Appendix A, 7
  int error_samples = 1;                  // Appendix A, 8: MeasureTriangles()
  RefineBy refine = RefineBy::kBoth;
  int max_corrections = 2;  // SolverOptions::max_corrections
  // SolverOptions::source_error. Where it is given, sources are not cut by the interpolants.
  std::optional<double> source_error;
  int max_iterations = 100;
  // SolverOptions of these names.
  std::string form_factors = "cubature";
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";
  bool multigrid = false;
  // Limits to Solve(), which then ends with the last whole step: in the dark, where that was not even
  // linking. They go on for BuildMesh(), which leaves out refining by what is shown, or where there was no
  // time for interpolants shows the mean of each leaf, and for Measure(), which leaves out the rest.
  std::optional<double> time_limit;    // [s]
  std::optional<double> memory_limit;  // [bytes] of the whole process
  // The share of that which is kept for what is made of a solution that a limit has ended: a mesh of its
  // leaves, and a file.
  double memory_kept = 0.1;
  // When that time began, reading included; left out, it begins with Solve().
  std::optional<std::chrono::steady_clock::time_point> limits_from;
  int bounces = 0;                  // whose mean irradiance is reported
  PointIrradianceOptions point;     // Appendix A, 9 and 10
  std::size_t error_points = 1000;  // random points that measure the interpolants' error; 0 leaves it out
  std::uint64_t seed = 1;
  std::string solver = "hierarchical";  // its name in LightSolvers()
  DenseOptions dense;                   // of the solver `dense`
};

// The values that a solve works with.
struct ResolvedOptions {
  SolverOptions solver;
  DiscontinuityOptions discontinuities;
  // Interpolants, once they are made of a solution, refine its light where the solver lets them
  // (Pipeline::RefinesLight). What --refine transport asks for stays as the links made it, and corrections by
  // --source-error stay as they cut it.
  bool refine_light = true;
};
// Throws InputError if a method is named that does not exist.
ResolvedOptions Resolve(const Scene& scene, const PipelineOptions& options);

// How the interpolants of a mesh are made.
enum class MeshKind {
  kFlat,         // quadtree leaves, the constant basis
  kGouraud,      // quadtree leaves, exact irradiance at the vertices, linear
  kGouraudMesh,  // the discontinuity mesh, linear
  kInterpolant,  // the discontinuity mesh, quadratic
};

struct Phase {
  std::string name;
  double seconds = 0;
};

struct PipelineReport {
  std::vector<Phase>
      phases;  // load (by the caller), link, iterate, discontinuities, triangulate, interpolate
  struct Counts {
    std::size_t patches = 0, emitters = 0, elements = 0, leaves = 0, links = 0, links_visible = 0,
                links_partial = 0, discontinuities = 0, dsets_active = 0, most_merged = 0, triangles = 0,
                interpolants = 0, point_evaluations = 0;
  } counts;
  std::vector<IterationReport> iterations;
  std::optional<SolverReport::Dense> dense;
  EnergyBalance energy;
  LinkDiagnostics links;
  ViewDiagnostics views;
  TriangleQuality quality;
  std::vector<Rgb> bounces;  // mean irradiance by bounce, if it was asked for [W/m^2]
  RepresentationError interpolant_error;
  // The 99th percentile of the relative error of irradiance, exact but for 2 % of the error asked for, from
  // the solution's sources against that from the interpolants as sources.
  double solution_error_estimate = 0;
  RepresentationError whole_error;     // of the interpolants, against the latter
  std::vector<PartError> part_errors;  // the same for each part of the scene that is seen
  double error_asked = 0;
  bool error_met = false;
  std::vector<std::string> unmet;     // what missed the target, and why; one line each
  std::vector<std::string> warnings;  // what looks wrong in the scene; one line each
};

// What the stages made, apart from what is quickly made anew.
struct PipelineState {
  PatchVisibility visibility;
  RadiositySolution solution;
  MeshKind mesh_kind = MeshKind::kInterpolant;
  IrradianceMesh mesh;
  PipelineReport report;
};

// Runs the stages and keeps what they made. The scene must outlive it.
class Pipeline {
 public:
  Pipeline(const Scene& scene, const PipelineOptions& options);
  // Shows what another one, with this scene and these options, had solved and meshed. BuildMesh() makes other
  // kinds of it; Relight() goes on from it; other steps of the solver drop it, and begin anew.
  Pipeline(const Scene& scene, const PipelineOptions& options, PipelineState state);
  ~Pipeline();

  const Scene& scene() const;
  const PipelineOptions& options() const;
  const ResolvedOptions& resolved() const;

  // Stages link and iterate: Link(), and the solver's steps until it has none left (SolveStepByStep). Goes on
  // from wherever the steps below have led. Cancelled, it leaves the solution of the last whole step. The
  // observer, if any, is told of each step. Throws InputError if a dense system is too large.
  void Solve(const ExecutionContext& context, const StepObserver& observer = {});

  // The same step by step, for who wants to look at what each one made. A step that is cancelled leaves
  // solution and report as they were before it, unless it says otherwise.
  //
  // What sees what, and the links between the roots: dark but for what surfaces emit. The other steps begin
  // with this one where it was left out, or was cancelled, which leaves that darkness without links.
  void Link(const ExecutionContext& context);
  // LightSolver::Step(). False if it was cancelled.
  bool Step(SolverStep step, const ExecutionContext& context);
  // One iteration: gather until the light settles, refine, gather. Nothing if it was cancelled, or if the
  // solver makes none.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // The last iteration refined nothing and left a residual below the cut-off.
  bool Converged() const;
  // The step that would come next; nothing before Link(), or if the solver has come to its end.
  std::optional<SolverStep> NextStep() const;
  // The passes of exact irradiance over the leaves, as many as the options say. False if it was cancelled,
  // which keeps the passes that were made.
  bool Correct(const ExecutionContext& context) { return Step(SolverStep::kCorrect, context); }
  // Lights the scene anew after its emittances or reflectances were changed, over the links there are, those
  // of a state that the pipeline began with too. Takes corrections back. Nothing if it was cancelled.
  std::optional<IterationReport> Relight(const ExecutionContext& context);
  // Relight() and Correct(), within the same limits as Solve(): the light of other materials without new form
  // factors. No link is judged or refined.
  void SolveOverLinks(const ExecutionContext& context);

  // Whether RefineLight() would do anything: the options ask for it, and the solver takes light.
  bool RefinesLight() const;
  // Stage refine light: a first mesh shows the light, whose sources are cut by what it shows and get its
  // means, in turns, until the light stands still. This is the last correction, and the only stage after the
  // solver that changes the solution. Nothing where RefinesLight() is false. REQUIRES: Link() or what begins
  // with it.
  void RefineLight(const ExecutionContext& context);

  // Stages discontinuities, triangulate, interpolate, for what a display mode needs, from the solution as it
  // is, which they leave so. For interpolants, unless transport alone is asked for, they then refine the mesh
  // (RefineMesh) until the error asked for is met; not where the mesh is to stay `as_it_is`, after a step
  // that is to be looked at. Nothing is done where it is there already. REQUIRES: Link() or what begins with
  // it.
  void BuildMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is = false);
  // The limits of what is done from here on begin anew, as Solve() begins them: for those who do its steps.
  void CountLimits();
  // Measures the energy balance, and the soundness of scene, links and triangles: nothing, if it was
  // cancelled. REQUIRES: BuildMesh() after
  // the last step.
  void Diagnose(const ExecutionContext& context = ExecutionContext());
  // That, and the error at random points. REQUIRES: the same; the mesh was made here.
  void Measure(const ExecutionContext& context);
  // Tells in the report what was missed, if so few random points as cost no time to speak of show clearly
  // that the error asked for is; nothing else is measured. REQUIRES: BuildMesh() after the last step.
  void CheckErrorRoughly(const ExecutionContext& context);
  // PipelineOptions::error_points of what is measured from here on.
  void SetErrorPoints(std::size_t points);

  const RadiositySolution& solution() const;  // REQUIRES: Link()
  const PatchVisibility& visibility() const;
  const PointIrradiance& irradiance() const;  // exact, from the solution's leaves; until the next step
  const IrradianceMesh& mesh() const;         // REQUIRES: BuildMesh()
  std::optional<MeshKind> mesh_kind() const;  // of mesh(); nothing if that is not of the present solution
  // One a triangle of the mesh, zero where there was no reason to measure; empty without refinement by it.
  std::span<const TriangleError> triangle_errors() const;

  // The interpolant's irradiance at a point of a patch, or at most `reach` [m] beside it, not
  // below 0 [W/m^2]. REQUIRES:
  // BuildMesh().
  std::optional<Rgb> Interpolated(PatchId patch, const Vec3& point, double reach = 0) const;

  // The discontinuities that there are, for a file (ListDiscontinuities); none where a limit does not leave
  // the time to find them.
  DiscontinuityList Discontinuities() const;

  const PipelineReport& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
