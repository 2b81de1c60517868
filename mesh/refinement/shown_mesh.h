// mesh/refinement/shown_mesh.h
//
// Computes and refines the mesh of a solution, controlled by the error of the interpolants (thesis 4.4.2).
// First, leaves are divided into smaller sources, whose radiosities are computed from the interpolants.
// Second, leaves are divided to refine the mesh, until the interpolants meet the requested error.

#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/current_irradiance.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/sample_cache.h"
#include "mesh/interpolants/triangle_error.h"
#include "mesh/refinement/emitter_light.h"
#include "mesh/refinement/local_pass.h"
#include "mesh/refinement/mesh_refinement.h"
#include "mesh/refinement/source_cells.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/solvers/light_solver.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

struct ShownMeshOptions {
  double error = 0.02;    // PipelineOptions::error
  int error_samples = 1;  // see MeasureTriangles()
  std::uint64_t seed = 1;
  SolverOptions solver;  // the options of the solution
  // The fraction of the error for the interpolants, for a 99th percentile.
  double interpolant_share = 0.6;
  double share_above = kShareAbove;                        // MeshRefinementOptions::share_above
  double suspicion = 0.25;                                 // MeshRefinementOptions::suspicion
  double steep = std::numeric_limits<double>::infinity();  // MeshRefinementOptions::steep
  int most_turns = 3;  // of refinement after random points have tested the mesh
  // The number of random points, spread over the scene, that test each mesh in addition to those of its
  // triangles.
  std::size_t lookouts = 0;
  int max_rounds = 8;  // MeshRefinementOptions::max_rounds
};

// Seconds spent on sources and on meshes.
struct MeshSeconds {
  double sources = 0;
  MeshReport::Seconds mesh;
};

class ShownMesh {
 public:
  // All arguments must outlive the object. `irradiance` must always be the exact irradiance from the solution
  // that is passed to the functions below.
  ShownMesh(const Scene& scene, const PatchVisibility& visibility, CurrentIrradiance& irradiance,
            const ShownMeshOptions& options);

  // Makes the mesh of the solution's leaves. If cancelled, returns false and keeps the previous mesh.
  bool Make(const RadiositySolution& solution, const MeshOptions& options, const ExecutionContext& context);
  // Refines the light of a solver. Makes a first mesh of the solver's leaves. After the first mesh, repeats
  // three steps until the light has converged: divides leaves where the interpolants vary into smaller
  // sources; computes the radiosity of each source from the mean of the interpolants over the source; and
  // refines the mesh. If cancelled, returns false and keeps the last complete light. REQUIRES:
  // solver.TakesLight().
  bool RefineLight(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  // The light of each emitter alone, without interpolants, on the sources that RefineLight() has made
  // (SolveByEmitter). Nothing if cancelled. REQUIRES: RefineLight() has returned true for the present light
  // of the solver, with the same options, and samples have rows (PointIrradiance::CanRecord).
  std::optional<std::vector<EmitterLight>> SplitLight(const LightSolver& solver,
                                                      std::span<const std::vector<PatchId>> emitters,
                                                      const MeshOptions& options,
                                                      const ExecutionContext& context);
  // Makes a mesh that meets the requested error, by refining the mesh of RefineLight(), or, if RefineLight()
  // was not called, a new mesh of the solution's leaves. If cancelled before there is a mesh, returns false.
  // If cancelled later, keeps the last complete mesh and returns true.
  bool MakeRefined(const RadiositySolution& solution, const MeshOptions& options,
                   const ExecutionContext& context);
  // Must be called after the light has changed. The next MakeRefined() then does not start from the mesh of
  // RefineLight().
  void Forget() {
    has_looked_ = false;
    light_plan_.reset();
    samples_are_current_ = false;
  }
  // Must be called after the light has changed within its error, so that the plan of RefineLight() holds.
  void TakeNewLight() { samples_are_current_ = false; }
  // Replaces the interpolants of the mesh. REQUIRES: there is one for each triangle.
  void SetInterpolants(std::vector<QuadraticInterpolant> irradiance);
  // The tolerance of the samples of interpolants that carry the light of single emitters.
  double EmitterTolerance() const;
  // Replaces the mesh by a mesh that another object has made.
  void Take(IrradianceMesh mesh);
  // Must be called after the PatchVisibility passed to the constructor has been replaced.
  void ForgetVisibility() {
    local_pass_.reset();
    samples_.Clear();
  }

  // A division of the leaves into sources that is finer than that of RefineLight(). The result is useless if
  // cancelled.
  SourceCells FinestCells(const RadiositySolution& solution, const ExecutionContext& context);
  // Exact irradiance from sources that are better than those of the solution. If the radiosities of `finest`
  // differ from those of the solution, the further reflections of this difference are computed over the links
  // and added: between walls that face each other, a difference is reflected many times. Returns null if
  // cancelled.
  std::unique_ptr<const PointIrradiance> BetterIrradiance(const RadiositySolution& solution,
                                                          const SourceCells& finest,
                                                          const ExecutionContext& context);
  // Exact irradiance from the sources `finest` alone, without the further reflections that BetterIrradiance()
  // adds. The result is one reflection of the light in the mesh, independent of all links; if links transport
  // light that should not exist, the result does not contain this light.
  std::unique_ptr<const PointIrradiance> ShownIrradiance(const RadiositySolution& solution,
                                                         const SourceCells& finest);

  const IrradianceMesh& mesh() const { return mesh_; }
  // The forest of triangulations().
  const ElementForest& forest() const { return plan_.forest; }
  // The triangulations of mesh(); empty if the mesh was set by Take().
  std::span<const PatchTriangulation> triangulations() const { return triangulations_; }
  // The error of each triangle of the mesh; empty if the triangles were not measured.
  std::span<const TriangleError> triangle_errors() const { return triangle_errors_; }

  // The report on the present mesh: its counts, and the total work (evaluations and seconds) by which it was
  // made.
  const MeshReport& report() const { return report_; }
  // Returns the seconds spent since the last call of TakeSeconds().
  MeshSeconds TakeSeconds();
  // One line that says which error limits refinement could not meet; nullopt if it met all limits.
  const std::optional<std::string>& unmet() const { return unmet_; }

 private:
  // Samples whose light will change again need rows of form factors.
  enum class Rows : std::uint8_t { kNone, kRecord };

  void Begin();
  bool FirstLook(const RadiositySolution& solution, const MeshOptions& options, SampleCache* samples,
                 const ExecutionContext& context);
  bool SettleSources(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  std::optional<double> RefineSources(LightSolver& solver, const ExecutionContext& context);
  SourceCells CellsOf(const RadiositySolution& solution, double finest, const ExecutionContext& context);
  bool RefineLeaves(const RadiositySolution& solution, const MeshOptions& options,
                    const ExecutionContext& context);
  std::optional<RefinedMesh> Refine(const RadiositySolution& solution, const MeshOptions& options,
                                    const MeshRefinementOptions& refinement, Rows rows,
                                    const ExecutionContext& context);
  MeshRefinementOptions RefinementTo(double error) const;
  bool RelightSamples(const ExecutionContext& context);
  bool ShowAnew(const MeshOptions& options, const ExecutionContext& context);
  double LookAround(std::size_t points, std::uint64_t seed, const ExecutionContext& context);
  double Tolerance() const;
  IrradianceSampler Sampler(Rows rows, const ExecutionContext& context);
  LocalPassCache& LocalPass();
  void Add(MeshReport latest);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  CurrentIrradiance& irradiance_;
  const ShownMeshOptions options_;

  IrradianceMesh mesh_;
  std::vector<PatchTriangulation> triangulations_;
  MeshPlan plan_;  // the plan of triangulations_
  std::vector<TriangleError> triangle_errors_;
  std::unique_ptr<LocalPassCache> local_pass_;  // for the present visibility
  SampleCache samples_;
  SourceSet samples_from_;            // the sources to which the rows of the samples belong
  bool samples_are_current_ = false;  // the samples have the present light
  std::vector<SourceCell> cells_;     // the sources of the present light; empty before RefineLight()
  MeshReport report_;
  double seconds_of_sources_ = 0;
  bool has_looked_ = false;             // mesh_ is RefineLight()'s, for the present light
  std::optional<MeshPlan> light_plan_;  // with which RefineLight() ended, for the present light
  std::optional<std::string> unmet_;
  std::vector<KnownLight> known_;  // at the points that have tested meshes of the present light
};

}  // namespace penumbra
