// mesh/pipeline/pipeline.h
//
// The offline half of the method, from a scene to its irradiance mesh, as a sequence of stages. The stages
// are visibility, links, iterations, discontinuities, triangulations and interpolants. The command line, the
// viewer and the experiments use the class Pipeline.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
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

// The kind of error by which the refinement of elements and mesh is controlled (thesis 4.4).
enum class RefineBy : std::uint8_t {
  kTransport,       // only the error of links; the mesh is not finer than the solution's quadtree leaves
  kRepresentation,  // only the error of the displayed mesh; the elements of the solution stay coarse
  kBoth,
};

// The options of a solve that a user can set. Options that the user omits get values that are derived from
// `error` and the scene.
struct PipelineOptions {
  // The requested 99th percentile of the relative error |shown - true| / max(true, 1 % of the channel's mean)
  // of displayed irradiance.
  double error = 0.02;
  // The largest transport error of a link between elements [W/m^2] (SolverOptions::eps; thesis, Appendix A,
  // parameter 1).
  std::optional<double> eps;
  // The smallest area of a quadtree element [m^2] (thesis, Appendix A, parameter 2).
  std::optional<double> min_area;
  // The smallest weight of a discontinuity that becomes an edge [W/m^2] (thesis, Appendix A, parameter 4).
  std::optional<double> min_discontinuity_weight;
  // The smallest weight of a discontinuity that refinement of the mesh may request as an edge [W/m^2].
  std::optional<double> min_wanted_weight;
  // The largest number of discontinuity lines in a quadtree leaf (thesis, Appendix A, parameter 5).
  int max_leaf_dsets = 10;
  // The following options determine the choice of discontinuities that become edges. If `weight` is omitted
  // and min_discontinuity_weight is given, the discontinuity weight is kThesis, because
  // min_discontinuity_weight is then a minimum of weights of this kind. If neither `weight` nor
  // min_discontinuity_weight is given, the discontinuity weight is kIrradiance.
  // The name of the method that chooses discontinuities, in DiscontinuityChoices().
  std::string discontinuities = "ranked";
  std::optional<DiscontinuityWeight> weight;
  bool keep_hidden_discontinuities = false;
  // The largest distance of the polyline of a triple-edge (EEE) discontinuity from the true curve [m]. If
  // triple_edge_tolerance is 0, triple-edge discontinuities are omitted.
  double triple_edge_tolerance = 0;
  int corner_divisions = 0;  // number of times that leaves at the ends of contacts are divided
  // The light counts as converged if |radiosity - limit| / (largest reflected radiosity) is at most
  // relative_cutoff for every element (thesis, Appendix A, parameter 7).
  std::optional<double> relative_cutoff;
  // The error of each triangle is measured at error_samples^2 points (thesis, Appendix A, parameter 8).
  int error_samples = 1;
  RefineBy refine = RefineBy::kBoth;
  int max_corrections = 2;  // largest number of passes of deferred correction
  // The relative error that treating a light source as constant may cause (SolverOptions::source_error). If
  // PipelineOptions::source_error is given, light sources are divided by the solver's corrections instead of
  // by RefineLight().
  std::optional<double> source_error;
  int max_iterations = 100;
  // The following five options set the members of SolverOptions with the same names.
  std::string form_factors = "cubature";
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";
  bool multigrid = false;
  // The options time_limit and memory_limit apply to Solve(), BuildMesh() and Measure(). If Solve() reaches a
  // limit of time or memory, the result is that of the last complete step. If Solve() completes no step, the
  // radiosity equals the emittance. If BuildMesh() reaches a limit of time or memory, the mesh is not
  // refined. If BuildMesh() has no time even for interpolants, the mesh has the mean irradiance of each
  // quadtree leaf. If Measure() reaches a limit of time or memory, the remaining measurements are omitted.
  std::optional<double> time_limit;    // limit of the run time [s]
  std::optional<double> memory_limit;  // limit of the memory of the whole process [bytes]
  // The fraction of memory_limit that Solve() does not use, so that memory remains for making a mesh and
  // writing a file.
  double memory_kept = 0.1;
  // The time from which time_limit is counted, for example a time before the scene is read. If limits_from is
  // omitted, time_limit is counted from the call of Solve().
  std::optional<std::chrono::steady_clock::time_point> limits_from;
  int bounces = 0;               // number of bounces whose mean irradiance is reported
  PointIrradianceOptions point;  // options of irradiance at points (thesis, Appendix A, parameters 9 and 10)
  // The number of random points at which the error of the interpolants is measured; 0: the error is not
  // measured.
  std::size_t error_points = 1000;
  std::uint64_t seed = 1;
  // If true, the pipeline keeps the light of each emitter separately (Pipeline::emitters).
  bool by_emitter = false;
  // Whether a face, an object or a material counts as one emitter.
  EmitterUnit emitter_unit = EmitterUnit::kFace;
  // The name of the solver in LightSolvers(). If `solver` is omitted, SolverFor() chooses the solver for the
  // scene. Options that SolverName() does not use are refused.
  std::optional<std::string> solver;
  std::string SolverName() const { return solver.value_or("hierarchical"); }
  DenseOptions dense;  // options of the solver `dense`
  // With the solver `sampled`, `rays` is SampledOptions::point_rays, and 0 means that the number of rays
  // depends on `error`. With form factors that are computed by rays, `rays` is LinkFormFactorOptions::rays.
  std::size_t rays = 0;
  std::size_t resolution = 0;  // side of the grids of form-factor methods such as the hemicube [cells]
  // The values of the members shots, overshoot and ambient of UniformOptions, for the solvers on uniform
  // meshes. For the solvers on uniform meshes, dense.divisions is the number of elements along each side of a
  // patch.
  std::size_t shots = 0;
  bool overshoot = false, ambient = false;
  // The name of the occlusion method, among OcclusionNames(), for everything in a solve that asks how much of
  // a source a point sees: form factors of links by cubature, exact or disk, deferred corrections, and the
  // nodes of the mesh. The dense and the sampled solver find visibility in ways of their own.
  std::string method = "auto";
  // True if the options were set to the thesis's values by SetAsThesis(). Single options may have been
  // changed afterwards.
  bool as_thesis = {};
  int crowded_splits = 3;  // the number of times that a leaf crowded with discontinuities may be divided
};

// The values of all options that a solve uses, including those that the user has omitted.
struct ResolvedOptions {
  std::string solver_name;  // name of the solver in LightSolvers()
  SolverOptions solver;
  SampledOptions sampled;
  UniformOptions uniform;
  DiscontinuityOptions discontinuities;
  // True if the interpolants of a mesh may refine the light of the solution (Pipeline::RefineLight). With
  // --refine transport, refine_light is false, because links alone determine the light. With --source-error,
  // refine_light is false, because the solver's corrections divide the sources.
  bool refine_light = true;
  // The number of random points at which each mesh of a sampled solution is tested for missed shadows.
  std::size_t lookouts = 0;
  // The occlusion method that PipelineOptions::method names; null for the fastest exact method.
  std::shared_ptr<const OcclusionMethod> occlusion = {};
};
// Returns the name of the solver that PipelineOptions::solver names, or that is chosen for the scene. If
// PipelineOptions::solver is omitted, the choice is `sampled` for scenes with so many polygons that pairs of
// polygons would take minutes, and otherwise `hierarchical`. SolverFor() always chooses `hierarchical` if an
// option is set that only this solver obeys.
std::string SolverFor(const Scene& scene, const PipelineOptions& options);
// Throws InputError if an option is the name of a method that does not exist.
ResolvedOptions Resolve(const Scene& scene, const PipelineOptions& options);

// The kinds of meshes and interpolants.
enum class MeshKind {
  kFlat,  // mesh of quadtree leaves with constant irradiance
  // A mesh of quadtree leaves with linear interpolants of exact irradiance at the vertices.
  kGouraud,
  kGouraudMesh,  // discontinuity mesh with linear interpolants
  kInterpolant,  // discontinuity mesh with quadratic interpolants
};

struct Phase {
  std::string name;
  double seconds = 0;
};

struct PipelineReport {
  // Time of each stage: load (added by the caller), link, iterate, discontinuities, triangulate, interpolate.
  std::vector<Phase> phases;
  struct Counts {
    std::size_t patches = 0, emitters = 0, elements = 0, leaves = 0, links = 0, links_visible = 0,
                links_partial = 0, discontinuities = 0, dsets_active = 0, most_merged = 0, triangles = 0,
                interpolants = 0, point_evaluations = 0, sources_renewed = 0;
  } counts;
  // The numbers of pairs of a receiver and a source whose light transport was computed.
  InteractionCounts interactions;
  std::vector<IterationReport> iterations;
  std::optional<SolverReport::Dense> dense;
  EnergyBalance energy;
  LinkDiagnostics links;
  ViewDiagnostics views;
  TriangleQuality quality;
  std::vector<Rgb> bounces;  // mean irradiance by bounce [W/m^2]; empty unless requested
  RepresentationError interpolant_error;
  // The 99th percentile of the relative difference between two irradiances: that from the solution's leaves,
  // and that from the mesh's interpolants as light sources. For solution_error_estimate, irradiance is
  // computed with a tolerance of 2 % of the requested error.
  double solution_error_estimate = 0;
  // Error of the interpolants, compared with the irradiance from the interpolants as light sources.
  RepresentationError whole_error;
  std::vector<PartError> part_errors;  // whole_error of each reflecting part of the scene
  double error_asked = 0;
  bool error_met = false;
  // The requirements that the run did not meet, such as the requested error, each with its reason in one
  // line.
  std::vector<std::string> unmet;
  std::vector<std::string> warnings;          // warnings about probable errors in the scene; one line each
  std::optional<IterationReport> begun = {};  // the iteration that is not complete: SolverReport::begun
};

// Receives each mesh while it is refined: the mesh of each round, in the order of the rounds.
using MeshObserver = std::function<void(const IrradianceMesh&)>;

// The results of the stages of a pipeline, except results that are quick to recompute.
struct PipelineState {
  PatchVisibility visibility;
  RadiositySolution solution;
  MeshKind mesh_kind = MeshKind::kInterpolant;
  IrradianceMesh mesh;
  PipelineReport report;
  // The light of each emitter alone, as Pipeline::emitters() returns it.
  std::vector<EmitterLight> emitters = {};
};

// A Pipeline runs the stages from a scene to its irradiance mesh, and holds their results. The scene must
// outlive the pipeline.
class Pipeline {
 public:
  Pipeline(const Scene& scene, const PipelineOptions& options);
  // Starts with the results of another pipeline for the same scene and options. From the solution in the
  // PipelineState, BuildMesh() can make other kinds of meshes, and Relight() can compute the light of changed
  // materials. All steps of the solver except Relight() discard the results in the PipelineState and start
  // from the beginning.
  Pipeline(const Scene& scene, const PipelineOptions& options, PipelineState state);
  ~Pipeline();

  const Scene& scene() const;
  const PipelineOptions& options() const;
  const ResolvedOptions& resolved() const;

  // Runs the stages "link" and "iterate": calls Link(), and then makes the solver's steps until no step is
  // left (SolveStepByStep). If steps of the solver have already been made, Solve() continues after the last
  // of these steps. If the computation is cancelled, Solve() keeps the solution of the last complete step.
  // Solve() calls the observer, if any, after each step of the solver. Throws InputError if the system of
  // equations of a dense solver is too large.
  void Solve(const ExecutionContext& context, const StepObserver& observer = {});

  // Link() and Step() run the stages of Solve() one by one, so that the result of each step can be inspected.
  // Unless stated otherwise, a cancelled step leaves the solution and the report unchanged.
  //
  // Link() computes the visibility between patches, and the links between the roots of the quadtrees. After
  // Link(), the radiosity equals the emittance. All other steps of the solver call Link() first if Link() has
  // not been completed. If Link() is cancelled, the solution has no links.
  void Link(const ExecutionContext& context);
  // Makes one step of the solver by LightSolver::Step(). Returns false if the step is cancelled.
  bool Step(SolverStep step, const ExecutionContext& context);
  // Makes one iteration of the solver: gathers until the light has converged, refines links, and gathers over
  // the new links. Returns nullopt if the iteration is cancelled, or if the solver has no iterations.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // True if the last iteration of the solver refined no link and ended with a residual below the cut-off.
  bool Converged() const;
  // Returns the next step of the solver, or nullopt before Link() has been called and after the last step.
  std::optional<SolverStep> NextStep() const;
  // The kind of the next of the solver's smallest steps (LightSolver::NextSmall).
  std::optional<SolverStep> NextSmallStep() const;
  // Returns a pipeline that continues from the present state of the solver, without a mesh, and leads to the
  // same results as this pipeline. Branch() returns null if there is no solver, or if the solver's method has
  // no copies (LightSolver::Copy).
  std::unique_ptr<Pipeline> Branch() const;
  // Makes all passes of deferred correction (of the light by exact irradiance) that the options request. If
  // the correction is cancelled, the function returns false and keeps the corrections of the complete passes.
  bool Correct(const ExecutionContext& context) { return Step(SolverStep::kCorrect, context); }
  // Relight() computes the light again after a change of emittances or reflectances. Relight() uses the
  // existing links, which may be those of the PipelineState passed to the constructor. Relight() discards
  // deferred corrections of the light. Returns nullopt if the computation is cancelled.
  std::optional<IterationReport> Relight(const ExecutionContext& context);
  // SolveOverLinks() solves again after the materials of the scene have changed, with the existing links and
  // form factors: it calls Relight() and then Correct(). The limits of time and memory apply to
  // SolveOverLinks() as to Solve(). SolveOverLinks() neither tests nor refines links.
  void SolveOverLinks(const ExecutionContext& context);

  // True if RefineLight() has an effect: ResolvedOptions::refine_light and LightSolver::TakesLight() are
  // true.
  bool RefinesLight() const;
  // True if RefineLight() has been completed for the present light.
  bool LightIsRefined() const;
  // The stage "refine light" repeats two steps until the light of the solution has converged. The first step
  // of "refine light" computes the interpolants of a mesh. Where interpolants vary on a quadtree leaf, the
  // second step of "refine light" divides the leaf into smaller light sources, and sets the irradiance of
  // each light source to the mean of the interpolants over the source. RefineLight() replaces the last pass
  // of deferred correction, and is the only stage after the solver that changes the solution. RefineLight()
  // has no effect if RefinesLight() is false. REQUIRES: Link(), or a step that calls Link(), has been called.
  void RefineLight(const ExecutionContext& context);

  // BuildMesh() runs the stages "discontinuities", "triangulate" and "interpolate", as far as the kind of
  // mesh needs them. BuildMesh() changes the solution only with PipelineOptions::by_emitter: the light then
  // becomes the sum of the emitters' lights, which differs from the former light by less than the error of
  // the light. A mesh of kind kInterpolant is also refined (RefineMesh) until it meets the requested error,
  // unless the option `refine` is kTransport. If `as_it_is` is true, BuildMesh() does not refine the mesh, so
  // that the result of a single step can be inspected. BuildMesh() has no effect if a mesh of this kind
  // exists already. REQUIRES: Link(), or a step that calls Link(), has been called.
  void BuildMesh(MeshKind kind, const ExecutionContext& context, bool as_it_is = false);
  // Sets the observer, which is called with each mesh that RefineLight() and
  // BuildMesh(MeshKind::kInterpolant) make before the final mesh. The light of these meshes is not yet
  // refined to the requested error.
  void ObserveMesh(MeshObserver observer);
  // KeepOperator() stores the light transport of the present solution and mesh as a matrix, for LitBy().
  // KeepOperator() recomputes the form factors of all mesh nodes (vertices and edge midpoints). Returns false
  // if the computation is cancelled, or if irradiance is computed without form factors, as with the sampled
  // solver and with chosen occlusion methods. The matrix of light transport is deleted when a step changes
  // the solution or when another mesh is made. REQUIRES: this pipeline has made a mesh of kind kInterpolant
  // after the last step of the solver.
  bool KeepOperator(const ExecutionContext& context);
  // The memory of the matrix of light transport [bytes], or 0 if there is no matrix.
  std::size_t OperatorBytes() const;
  // Returns the solution and the mesh of a scene with the same patches and other emittances or reflectances,
  // for another Pipeline. LitBy() computes products with the matrix of light transport, and no form factors.
  // The report in the PipelineState contains no measurements. The result of LitBy() is nullopt if there is no
  // matrix of light transport, or if a patch that sends no light in this scene sends light in `other`. The
  // scene `other` must outlive the result.
  std::optional<PipelineState> LitBy(const Scene& other) const;
  // CountLimits() restarts the limits of time and memory, as Solve() does at its beginning. CountLimits() is
  // for callers that make the steps of Solve() themselves.
  void CountLimits();
  // Measures the energy balance, and checks scene, links and triangles. If the computation is cancelled, the
  // report remains unchanged. REQUIRES: BuildMesh() has been called after the last step of the solver.
  void Diagnose(const ExecutionContext& context = ExecutionContext());
  // Calls Diagnose(), and measures the error of the displayed irradiance at random points. REQUIRES: this
  // pipeline has made the mesh after the last step of the solver.
  void Measure(const ExecutionContext& context);
  // Adds a line to PipelineReport::unmet if a few random points, which take negligible time, clearly show
  // that the requested error is missed. CheckErrorRoughly() makes no other measurements. REQUIRES:
  // BuildMesh() has been called after the last step of the solver.
  void CheckErrorRoughly(const ExecutionContext& context);
  // Sets PipelineOptions::error_points for later measurements.
  void SetErrorPoints(std::size_t points);

  const RadiositySolution& solution() const;  // REQUIRES: Link() has been called
  const PatchVisibility& visibility() const;
  // Exact irradiance from the solution's leaves. The result of irradiance() is valid until the next step of
  // the solver.
  const PointIrradiance& irradiance() const;
  const IrradianceMesh& mesh() const;  // REQUIRES: BuildMesh() has been called
  // Kind of mesh(); nullopt if the mesh belongs to an earlier solution.
  std::optional<MeshKind> mesh_kind() const;
  // With PipelineOptions::by_emitter, returns the light of each emitter alone, for the present solution and
  // its mesh of kind kInterpolant. The sum of the lights of all emitters is the light of the solution. The
  // list of the emitters' lights is empty before there is a mesh of kind kInterpolant, and if a limit of time
  // or memory ended the computation of the lights (PipelineReport::unmet).
  std::span<const EmitterLight> emitters() const;
  // Returns the errors of the mesh's triangles; zero for triangles that were not measured because their
  // interpolants agree with those of the neighbours. The list of triangle errors is empty if the mesh was not
  // refined.
  std::span<const TriangleError> triangle_errors() const;

  // Returns max(0, irradiance of the interpolants) [W/m^2] at a point of the patch. If the point lies outside
  // the patch by at most `reach` [m], the nearest point of the patch is used. If the point is farther outside
  // the patch than `reach`, the result is nullopt. REQUIRES: BuildMesh() has been called.
  std::optional<Rgb> Interpolated(PatchId patch, const Vec3& point, double reach = 0) const;

  // Returns the irradiance at a point in free space, as irradiance.Anywhere() does. IrradianceInSpace() also
  // divides light sources close to the point, according to the light of the interpolants on the sources
  // (CloserSources). The solution's leaves are as fine as the surfaces of the scene need them, and a point in
  // space may be closer to a leaf than any surface. Light sources are not divided if the light of the
  // solution does not come from interpolants (ResolvedOptions::refine_light, other solvers), or with
  // PipelineOptions::by_emitter. REQUIRES: `irradiance` was made from solution(), and BuildMesh() has been
  // called.
  PointIrradianceResult IrradianceInSpace(const PointIrradiance& irradiance, const ReceiverPoint& at,
                                          IrradianceParts* parts = nullptr) const;

  // Returns the list of discontinuities that is written to files (ListDiscontinuities). The list of
  // discontinuities is empty if the time limit ends before the discontinuities are found.
  DiscontinuityList Discontinuities() const;

  const PipelineReport& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
