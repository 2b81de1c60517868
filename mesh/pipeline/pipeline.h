// mesh/pipeline/pipeline.h
//
// The offline half, from a scene to its irradiance mesh, as stages: visibility, links, iterations,
// discontinuities, triangulations, interpolants. Command line, viewer and experiments use these stages.

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

// The error that refinement reduces (thesis 4.4).
enum class RefineBy : std::uint8_t {
  kTransport,       // the error of links only; the mesh has the solution's leaves
  kRepresentation,  // the error of the shown mesh, over a coarse solution
  kBoth,
};

// The options of a user. Omitted values follow from `error` and the scene.
struct PipelineOptions {
  double error = 0.02;  // requested 99th percentile of |shown - true| / max(true, 1 % of the channel's mean)
  std::optional<double> eps;                       // [W/m^2] thesis, Appendix A, 1
  std::optional<double> min_area;                  // [m^2] Appendix A, 2
  std::optional<double> min_discontinuity_weight;  // [W/m^2] Appendix A, 4
  std::optional<double> min_wanted_weight;         // [W/m^2] DiscontinuityOptions::min_wanted_weight
  int max_leaf_dsets = 10;                         // Appendix A, 5
  // The choice of discontinuities. Without a value, `weight` is the thesis's weight if
  // min_discontinuity_weight is given, because that value is on the thesis's scale; otherwise the irradiance
  // weight.
  std::string discontinuities = "ranked";  // DiscontinuityOptions::choice
  std::optional<DiscontinuityWeight> weight;
  bool keep_hidden_discontinuities = false;
  double triple_edge_tolerance = 0;       // DiscontinuityOptions::triple_edge_tolerance [m]
  int corner_divisions = 0;               // DiscontinuityOptions::corner_divisions
  std::optional<double> relative_cutoff;  // Appendix A, 7
  int error_samples = 1;                  // Appendix A, 8: MeasureTriangles()
  RefineBy refine = RefineBy::kBoth;
  int max_corrections = 2;  // SolverOptions::max_corrections
  // SolverOptions::source_error. If given, the interpolants do not cut the sources.
  std::optional<double> source_error;
  int max_iterations = 100;
  // See the members of SolverOptions with these names.
  std::string form_factors = "cubature";
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";
  bool multigrid = false;
  // Limits of Solve(). At a limit, Solve() ends with the last complete step; if not even linking is complete,
  // the scene is dark apart from emission. The limits also hold for BuildMesh() and Measure(). At a limit,
  // BuildMesh() omits representation-based refinement or, without time for interpolants, shows the mean of
  // each leaf; Measure() omits the remaining measurements.
  std::optional<double> time_limit;    // [s]
  std::optional<double> memory_limit;  // [bytes] of the whole process
  // The fraction of memory_limit reserved for the stages after a Solve() that ends at a limit: a mesh of the
  // leaves, and a file.
  double memory_kept = 0.1;
  // The start of the time limit, for example before the scene is read; if omitted, the call of Solve().
  std::optional<std::chrono::steady_clock::time_point> limits_from;
  int bounces = 0;                  // number of bounces whose mean irradiance is reported
  PointIrradianceOptions point;     // Appendix A, 9 and 10
  std::size_t error_points = 1000;  // random points for the interpolants' error; 0: not measured
  std::uint64_t seed = 1;
  std::string solver = "hierarchical";  // a name in LightSolvers()
  DenseOptions dense;                   // for the solver `dense`
};

// The values that a solve uses.
struct ResolvedOptions {
  SolverOptions solver;
  DiscontinuityOptions discontinuities;
  // If the solver allows, the interpolants of a mesh refine the light of the solution
  // (Pipeline::RefinesLight). False with --refine transport, where links alone determine the light, and with
  // --source-error, where the corrections cut the sources.
  bool refine_light = true;
};
// Throws InputError if an option is the name of a method that does not exist.
ResolvedOptions Resolve(const Scene& scene, const PipelineOptions& options);

// The kinds of meshes and interpolants.
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
  std::vector<Rgb> bounces;  // mean irradiance by bounce [W/m^2]; empty unless requested
  RepresentationError interpolant_error;
  // The 99th percentile of the relative error of irradiance from the solution's sources, compared with
  // irradiance from the interpolants as sources. Both are exact up to 2 % of the requested error.
  double solution_error_estimate = 0;
  RepresentationError whole_error;  // interpolants, compared with irradiance from the interpolants as sources
  std::vector<PartError> part_errors;  // whole_error of each part of the scene that is seen
  double error_asked = 0;
  bool error_met = false;
  std::vector<std::string> unmet;     // which targets were missed, and why; one line each
  std::vector<std::string> warnings;  // probable errors in the scene; one line each
};

// The results of the stages, without those that are quick to recompute.
struct PipelineState {
  PatchVisibility visibility;
  RadiositySolution solution;
  MeshKind mesh_kind = MeshKind::kInterpolant;
  IrradianceMesh mesh;
  PipelineReport report;
};

// Runs the stages and holds their results. The scene must outlive the pipeline.
class Pipeline {
 public:
  Pipeline(const Scene& scene, const PipelineOptions& options);
  // Starts with the results of another pipeline for the same scene and options. BuildMesh() makes other kinds
  // of meshes from the solution, and Relight() continues from it. The solver's other steps discard the
  // results and start from the beginning.
  Pipeline(const Scene& scene, const PipelineOptions& options, PipelineState state);
  ~Pipeline();

  const Scene& scene() const;
  const PipelineOptions& options() const;
  const ResolvedOptions& resolved() const;

  // The stages link and iterate: Link(), then the solver's steps until none is left (SolveStepByStep).
  // Continues from the present step. If cancelled, keeps the solution of the last complete step. Calls the
  // observer, if any, after each step. Throws InputError if a dense system is too large.
  void Solve(const ExecutionContext& context, const StepObserver& observer = {});

  // The same stages step by step, for inspection of each step's result. Unless stated otherwise, a cancelled
  // step leaves solution and report unchanged.
  //
  // Link() computes the visibility between patches, and the links between roots; the scene is dark apart from
  // emission. The other steps call Link() first if it has not been completed. If cancelled, Link() leaves the
  // dark scene without links.
  void Link(const ExecutionContext& context);
  // LightSolver::Step(). False if cancelled.
  bool Step(SolverStep step, const ExecutionContext& context);
  // One iteration: gathers until the light settles, refines, gathers. Nothing if cancelled, or if the solver
  // has no iterations.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // True if the last iteration refined nothing and left a residual below the cut-off.
  bool Converged() const;
  // The next step; nothing before Link(), or if the solver has no step left.
  std::optional<SolverStep> NextStep() const;
  // The passes of exact irradiance over the leaves, as many as the options request. If cancelled, returns
  // false and keeps the complete passes.
  bool Correct(const ExecutionContext& context) { return Step(SolverStep::kCorrect, context); }
  // Computes the light after a change of emittances or reflectances, over the existing links, which may be
  // those of the initial state. Discards corrections. Nothing if cancelled.
  std::optional<IterationReport> Relight(const ExecutionContext& context);
  // Solves again after the materials of the scene have changed, with the links and form factors that exist:
  // calls Relight() and then Correct(), and stops at the limits of time and memory that Solve() has. The
  // function neither tests nor refines links.
  void SolveOverLinks(const ExecutionContext& context);

  // True if RefineLight() has an effect: the options request it, and the solver takes light.
  bool RefinesLight() const;
  // The stage refine light. Alternates until the light settles: a mesh shows the light; the sources are cut
  // by what the mesh shows, and get the means of the interpolants. The stage is the last correction, and the
  // only stage after the solver that changes the solution. No effect if RefinesLight() is false. REQUIRES:
  // Link() or a step that calls it.
  void RefineLight(const ExecutionContext& context);

  // The stages discontinuities, triangulate and interpolate, as far as the kind of mesh needs them. The
  // stages do not change the solution. For kInterpolant, unless the option `refine` is kTransport, the stages
  // also refine the mesh (RefineMesh) until the mesh meets the requested error; `as_it_is` prevents this
  // refinement, for inspection of a single step. No effect if the mesh exists already. REQUIRES: Link() or a
  // step that calls it.
  void BuildMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is = false);
  // Restarts the limits now, as Solve() does, for callers that make the steps of Solve() themselves.
  void CountLimits();
  // Measures the energy balance, and checks scene, links and triangles. No effect if cancelled. REQUIRES:
  // BuildMesh() after the last step.
  void Diagnose(const ExecutionContext& context = ExecutionContext());
  // Diagnose(), and the error at random points. REQUIRES: as for Diagnose(); this pipeline made the mesh.
  void Measure(const ExecutionContext& context);
  // Adds a line to PipelineReport::unmet if a few random points, which take negligible time, clearly show
  // that the requested error is missed. Measures nothing else. REQUIRES: BuildMesh() after the last step.
  void CheckErrorRoughly(const ExecutionContext& context);
  // Sets PipelineOptions::error_points for later measurements.
  void SetErrorPoints(std::size_t points);

  const RadiositySolution& solution() const;  // REQUIRES: Link()
  const PatchVisibility& visibility() const;
  const PointIrradiance& irradiance() const;  // exact, from the solution's leaves; valid until the next step
  const IrradianceMesh& mesh() const;         // REQUIRES: BuildMesh()
  std::optional<MeshKind> mesh_kind() const;  // of mesh(); nothing if it shows an earlier solution
  // One per triangle of the mesh, zero where there was no reason to measure; empty if the mesh was not
  // refined.
  std::span<const TriangleError> triangle_errors() const;

  // The interpolants' irradiance, at least 0 [W/m^2], at a point of the patch or at most `reach` [m] beside
  // it; nothing elsewhere. REQUIRES: BuildMesh().
  std::optional<Rgb> Interpolated(PatchId patch, const Vec3& point, double reach = 0) const;

  // The discontinuities for a file (ListDiscontinuities); empty if a limit leaves no time to find them.
  DiscontinuityList Discontinuities() const;

  const PipelineReport& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
