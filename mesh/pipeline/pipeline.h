// mesh/pipeline/pipeline.h
//
// The offline half of the method, from a scene to its irradiance mesh, as a sequence of stages: visibility,
// links, iterations, discontinuities, triangulations, interpolants. The command line, the viewer and the
// experiments use the class Pipeline.

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
#include "mesh/refinement/emitter_light.h"
#include "solver/base/progress.h"
#include "solver/scene/emitters.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/diagnostics.h"
#include "solver/transport/solvers/energy.h"
#include "solver/transport/solvers/light_solver.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The kind of error by which refinement is controlled (thesis 4.4).
enum class RefineBy : std::uint8_t {
  kTransport,       // the error of links only; the mesh has the solution's leaves
  kRepresentation,  // the error of the shown mesh, over a coarse solution
  kBoth,
};

// The options that a user can set. Values of options that the user omits are derived from `error` and the
// scene.
struct PipelineOptions {
  double error = 0.02;  // requested 99th percentile of |shown - true| / max(true, 1 % of the channel's mean)
  std::optional<double> eps;                       // [W/m^2] thesis, Appendix A, 1
  std::optional<double> min_area;                  // [m^2] Appendix A, 2
  std::optional<double> min_discontinuity_weight;  // [W/m^2] Appendix A, 4
  std::optional<double> min_wanted_weight;         // [W/m^2] DiscontinuityOptions::min_wanted_weight
  int max_leaf_dsets = 10;                         // Appendix A, 5
  // The choice of discontinuities. If `weight` is omitted and min_discontinuity_weight is given, the weight
  // is DiscontinuityWeight::kThesis, the scale for which the user has chosen the minimum; otherwise, it is
  // kIrradiance.
  std::string discontinuities = "ranked";  // DiscontinuityOptions::choice
  std::optional<DiscontinuityWeight> weight;
  bool keep_hidden_discontinuities = false;
  double triple_edge_tolerance = 0;       // DiscontinuityOptions::triple_edge_tolerance [m]
  int corner_divisions = 0;               // DiscontinuityOptions::corner_divisions
  std::optional<double> relative_cutoff;  // Appendix A, 7
  int error_samples = 1;                  // Appendix A, 8: MeasureTriangles()
  RefineBy refine = RefineBy::kBoth;
  int max_corrections = 2;  // SolverOptions::max_corrections
  // The value of SolverOptions::source_error. If source_error is given, sources are divided by the solver's
  // corrections instead of by RefineLight().
  std::optional<double> source_error;
  int max_iterations = 100;
  // The next five options set the members of SolverOptions with the same names.
  std::string form_factors = "cubature";
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";
  bool multigrid = false;
  // Limits of time and memory for Solve(), BuildMesh() and Measure(). If Solve() reaches a limit, the result
  // is that of the last complete step; if no step is complete, radiosity equals emittance. If BuildMesh()
  // reaches a limit, the mesh is not refined; if no time is left even for interpolants, the mesh has the mean
  // irradiance of each leaf. If Measure() reaches a limit, the remaining measurements are omitted.
  std::optional<double> time_limit;    // [s]
  std::optional<double> memory_limit;  // [bytes] of the whole process
  // The fraction of memory_limit that Solve() does not use, so that memory remains for a mesh of the leaves
  // and for writing a file.
  double memory_kept = 0.1;
  // The time from which time_limit is counted, for example the time before the scene is read; if omitted, the
  // time of the call of Solve().
  std::optional<std::chrono::steady_clock::time_point> limits_from;
  int bounces = 0;                  // number of bounces whose mean irradiance is reported
  PointIrradianceOptions point;     // Appendix A, 9 and 10
  std::size_t error_points = 1000;  // random points for the interpolants' error; 0: not measured
  std::uint64_t seed = 1;
  // If true, the pipeline keeps the light of each emitter (Pipeline::emitters).
  bool by_emitter = false;
  EmitterUnit emitter_unit = EmitterUnit::kFace;  // what counts as one emitter
  // A name in LightSolvers(). If omitted, the solver depends on the scene (SolverFor); options of other
  // solvers than SolverName() are refused.
  std::optional<std::string> solver;
  std::string SolverName() const { return solver.value_or("hierarchical"); }
  DenseOptions dense;  // for the solver `dense`
  // For the solver `sampled`: SampledOptions::point_rays; 0: depends on `error`. For form factors by rays:
  // LinkFormFactorOptions::rays.
  std::size_t rays = 0;
  std::size_t resolution = 0;  // LinkFormFactorOptions::resolution
  // UniformOptions::shots, overshoot and ambient, of the solvers on uniform meshes. Their meshes have
  // dense.divisions.
  std::size_t shots = 0;
  bool overshoot = false, ambient = false;
};

// The values of all options that a solve uses, including those that the user has omitted.
struct ResolvedOptions {
  std::string solver_name;  // in LightSolvers()
  SolverOptions solver;
  SampledOptions sampled;
  UniformOptions uniform;
  DiscontinuityOptions discontinuities;
  // True if the interpolants of a mesh may refine the light of the solution (Pipeline::RefineLight). False
  // with --refine transport, where the light is determined by links alone, and with --source-error, where the
  // solver's corrections divide the sources.
  bool refine_light = true;
  std::size_t lookouts = 0;  // ShownMeshOptions::lookouts
};
// The solver that PipelineOptions::solver names. If the option is omitted: `sampled` for scenes with so many
// polygons that pairs of polygons would take minutes, unless an option is set that only `hierarchical` obeys;
// otherwise `hierarchical`.
std::string SolverFor(const Scene& scene, const PipelineOptions& options);
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
                interpolants = 0, point_evaluations = 0, sources_renewed = 0;
  } counts;
  InteractionCounts interactions;  // of the transport operator, links included
  std::vector<IterationReport> iterations;
  std::optional<SolverReport::Dense> dense;
  EnergyBalance energy;
  LinkDiagnostics links;
  ViewDiagnostics views;
  TriangleQuality quality;
  std::vector<Rgb> bounces;  // mean irradiance by bounce [W/m^2]; empty unless requested
  RepresentationError interpolant_error;
  // The 99th percentile of the relative difference between the irradiance from the solution's leaves and the
  // irradiance from the interpolants as sources. Irradiance is computed with a tolerance of 2 % of the
  // requested error.
  double solution_error_estimate = 0;
  RepresentationError whole_error;  // interpolants, compared with irradiance from the interpolants as sources
  std::vector<PartError> part_errors;  // whole_error of each part of the scene that is seen
  double error_asked = 0;
  bool error_met = false;
  std::vector<std::string> unmet;     // which targets were missed, and why; one line each
  std::vector<std::string> warnings;  // probable errors in the scene; one line each
};

// The results of the stages, except results that are quick to recompute.
struct PipelineState {
  PatchVisibility visibility;
  RadiositySolution solution;
  MeshKind mesh_kind = MeshKind::kInterpolant;
  IrradianceMesh mesh;
  PipelineReport report;
  std::vector<EmitterLight> emitters = {};  // Pipeline::emitters()
};

// Runs the stages and holds their results. The scene must outlive the pipeline.
class Pipeline {
 public:
  Pipeline(const Scene& scene, const PipelineOptions& options);
  // Starts with the results of another pipeline for the same scene and options. BuildMesh() can make other
  // kinds of meshes from the given solution, and Relight() can continue from the given solution. All other
  // steps of the solver discard the given results and start from the beginning.
  Pipeline(const Scene& scene, const PipelineOptions& options, PipelineState state);
  ~Pipeline();

  const Scene& scene() const;
  const PipelineOptions& options() const;
  const ResolvedOptions& resolved() const;

  // Makes the stages "link" and "iterate": calls Link(), and then makes the solver's steps until none is left
  // (SolveStepByStep). Solve() continues after the steps that have already been made. If cancelled, Solve()
  // keeps the solution of the last complete step. Calls the observer, if any, after each step. Throws
  // InputError if a dense system is too large.
  void Solve(const ExecutionContext& context, const StepObserver& observer = {});

  // Link() and Step() make the stages of Solve() one by one, so that the result of each step can be
  // inspected. Unless stated otherwise, a cancelled step leaves solution and report unchanged.
  //
  // Link() computes the visibility between patches, and the links between roots; afterwards, radiosity equals
  // emittance. The other steps call Link() first if it has not been completed. If Link() is cancelled, the
  // solution has no links.
  void Link(const ExecutionContext& context);
  // Calls LightSolver::Step(). Returns false if cancelled.
  bool Step(SolverStep step, const ExecutionContext& context);
  // Makes one iteration: gathers until the light has converged, refines links, and gathers over the new
  // links. Returns nullopt if cancelled, or if the solver has no iterations.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // True if the last iteration refined no link and ended with a residual below the cut-off.
  bool Converged() const;
  // The next step of the solver; nullopt before Link() has been called, and after the last step.
  std::optional<SolverStep> NextStep() const;
  // Makes all passes of deferred correction that the options request. If cancelled, returns false and keeps
  // the corrections of the complete passes.
  bool Correct(const ExecutionContext& context) { return Step(SolverStep::kCorrect, context); }
  // Computes the light again after a change of emittances or reflectances. Uses the existing links, which may
  // be those of the PipelineState passed to the constructor. Discards corrections. Returns nullopt if
  // cancelled.
  std::optional<IterationReport> Relight(const ExecutionContext& context);
  // Solves again after the materials of the scene have changed, with the existing links and form factors:
  // calls Relight() and then Correct(). The limits of time and memory hold as for Solve(). SolveOverLinks()
  // neither tests nor refines links.
  void SolveOverLinks(const ExecutionContext& context);

  // True if RefineLight() has an effect: ResolvedOptions::refine_light and LightSolver::TakesLight() are
  // true.
  bool RefinesLight() const;
  // The stage "refine light" repeats two steps until the light has converged. The first step computes the
  // interpolants of a mesh. The second step divides leaves where the interpolants vary into smaller sources,
  // and sets the irradiance of each source to the mean of the interpolants over the source. RefineLight()
  // replaces the last pass of deferred correction, and is the only stage after the solver that changes the
  // solution. RefineLight() has no effect if RefinesLight() is false. REQUIRES: Link() or a step that calls
  // it.
  void RefineLight(const ExecutionContext& context);

  // Makes the stages "discontinuities", "triangulate" and "interpolate", as far as the kind of mesh needs
  // them. BuildMesh() does not change the solution, except that, with PipelineOptions::by_emitter, the light
  // becomes the sum of that of the emitters, which differs within the error. A mesh of kind kInterpolant is
  // also refined (RefineMesh) until it meets the requested error, unless the option `refine` is kTransport.
  // If `as_it_is` is true, the mesh is not refined, so that the result of a single step can be inspected.
  // BuildMesh() has no effect if the mesh exists already. REQUIRES: Link() or a step that calls it.
  void BuildMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is = false);
  // Keeps the light transport of the present solution and mesh as a matrix, for LitBy(). Looks at each node
  // of the mesh once more. Returns false if cancelled, or if irradiance has no rows of form factors: that of
  // the sampled solver and of chosen occlusion methods. The next step or mesh drops the matrix. REQUIRES:
  // this pipeline has made the mesh, of kind kInterpolant, after the last step.
  bool KeepOperator(const ExecutionContext& context);
  // The memory of the matrix [bytes]; 0: none is kept.
  std::size_t OperatorBytes() const;
  // The solution and the mesh of a scene with the same patches and other emittances or reflectances, for
  // another Pipeline: products with the matrix, and no form factors. The report measures nothing. Nothing if
  // no matrix is kept, or if a patch of `other` sends light that sent none in this scene. `other` must
  // outlive the result.
  std::optional<PipelineState> LitBy(const Scene& other) const;
  // Restarts the limits of time and memory, as Solve() does at its beginning; for callers that make the steps
  // of Solve() themselves.
  void CountLimits();
  // Measures the energy balance, and checks scene, links and triangles. If cancelled, the report remains
  // unchanged. REQUIRES: BuildMesh() after the last step.
  void Diagnose(const ExecutionContext& context = ExecutionContext());
  // Calls Diagnose(), and measures the error at random points. REQUIRES: this pipeline has made the mesh,
  // after the last step.
  void Measure(const ExecutionContext& context);
  // Adds a line to PipelineReport::unmet if a few random points, which take negligible time, clearly show
  // that the requested error is missed. No other error is measured. REQUIRES: BuildMesh() after the last
  // step.
  void CheckErrorRoughly(const ExecutionContext& context);
  // Sets PipelineOptions::error_points for later measurements.
  void SetErrorPoints(std::size_t points);

  const RadiositySolution& solution() const;  // REQUIRES: Link()
  const PatchVisibility& visibility() const;
  const PointIrradiance& irradiance() const;  // exact, from the solution's leaves; valid until the next step
  const IrradianceMesh& mesh() const;         // REQUIRES: BuildMesh()
  std::optional<MeshKind> mesh_kind() const;  // of mesh(); nothing if it shows an earlier solution
  // With PipelineOptions::by_emitter, the light of each emitter alone on the present solution and on its mesh
  // of kind kInterpolant; their sum is the whole light. Empty before there is such a mesh, and if a limit of
  // time or memory ended the work on it (PipelineReport::unmet).
  std::span<const EmitterLight> emitters() const;
  // The errors of the mesh's triangles; zero for triangles that were not measured because their interpolants
  // agree with the neighbours. The list is empty if the mesh was not refined.
  std::span<const TriangleError> triangle_errors() const;

  // max(0, irradiance of the interpolants) [W/m^2] at a point of the patch. If the point lies outside the
  // patch, the nearest point of the patch is used if its distance is at most `reach` [m]; otherwise, the
  // result is nullopt. REQUIRES: BuildMesh().
  std::optional<Rgb> Interpolated(PatchId patch, const Vec3& point, double reach = 0) const;

  // The irradiance at a point in free space: irradiance.Anywhere(), but sources close to the point are
  // divided by the light that the interpolants show on them (CloserSources). The solution's leaves are as
  // fine as the surfaces of the scene need them, and a point in space may be closer. Sources are not divided
  // if the light of the solution is not that of the interpolants (ResolvedOptions::refine_light, other
  // solvers). REQUIRES: `irradiance` was made from solution(), and BuildMesh().
  PointIrradianceResult IrradianceInSpace(const PointIrradiance& irradiance, const ReceiverPoint& at,
                                          IrradianceParts* parts = nullptr) const;

  // The list of discontinuities that is written to files (ListDiscontinuities); empty if the time limit ends
  // before they are found.
  DiscontinuityList Discontinuities() const;

  const PipelineReport& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
