// mesh/refinement/shown_mesh.h
//
// Computes and refines the mesh of a solution, controlled by the error of the interpolants (thesis 4.4.2).
// First, quadtree leaves are divided into smaller light sources, whose radiosities are computed from the
// interpolants. Second, quadtree leaves are divided to refine the mesh, until the interpolants meet the
// requested error.

#pragma once

#include <cstdint>
#include <functional>
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
  double error = 0.02;    // requested 99th percentile of the relative errors of irradiance
  int error_samples = 1;  // the error of each triangle is measured at error_samples^2 points
  std::uint64_t seed = 1;
  SolverOptions solver;  // the options with which the radiosity solution is computed
  // The mesh is refined until the 99th percentile of the interpolants' errors is interpolant_share * error.
  double interpolant_share = 0.6;
  // The fraction of the area of all reflecting patch fronts on which the error may exceed its limit.
  double share_above = kShareAbove;
  // Triangles whose estimated error is below suspicion * error are not measured.
  double suspicion = 0.25;
  // A triangle is measured at additional points if the irradiances at its vertices differ by more than the
  // factor `steep`.
  double steep = std::numeric_limits<double>::infinity();
  int most_turns = 3;  // largest number of refinements that follow tests of the mesh at random points
  // The number of random points, spread over the scene, at which each mesh is tested in addition to the
  // points of its triangles.
  std::size_t lookouts = 0;
  int max_rounds = 8;  // largest number of rounds of one refinement of the mesh
};

// Time spent on dividing sources, and on making meshes [s].
struct MeshSeconds {
  double sources = 0;
  MeshReport::Seconds mesh;
};

class ShownMesh {
 public:
  // All constructor arguments must outlive the ShownMesh. `irradiance` must always be the exact irradiance
  // from the solution that is passed to the member functions.
  ShownMesh(const Scene& scene, const PatchVisibility& visibility, CurrentIrradiance& irradiance,
            const ShownMeshOptions& options);

  // Makes a mesh of the solution's quadtree leaves. If the computation is cancelled, the function returns
  // false and keeps the previous mesh.
  bool Make(const RadiositySolution& solution, const MeshOptions& options, const ExecutionContext& context);
  // Refines the light of a solver, with means of the mesh's interpolants as irradiances of the light sources.
  // RefineLight() first makes a mesh of the solver's quadtree leaves. RefineLight() then repeats three steps
  // until the light has converged. Where interpolants vary on a leaf, step 1 of RefineLight() divides the
  // leaf into smaller light sources. Step 2 of RefineLight() computes the radiosity of each source from the
  // mean of the interpolants over the source. Step 3 of RefineLight() refines the mesh. If the computation is
  // cancelled, the function returns false and keeps the light after the last complete repetition of the three
  // steps. REQUIRES: solver.TakesLight() is true.
  bool RefineLight(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  // Returns the light of each emitter alone, without interpolants, for the sources that RefineLight() has
  // made (SolveByEmitter). The result is nullopt if the computation is cancelled. REQUIRES: RefineLight() has
  // returned true for the present light of the solver, with the same options, and irradiance samples can
  // record form factors (PointIrradiance::CanRecord).
  std::optional<std::vector<EmitterLight>> SplitLight(const LightSolver& solver,
                                                      std::span<const std::vector<PatchId>> emitters,
                                                      const MeshOptions& options,
                                                      const ExecutionContext& context);
  // Makes a mesh that meets the requested error. The refinement starts from the mesh of RefineLight() or, if
  // RefineLight() was not called, from a new mesh of the solution's leaves. If the computation is cancelled
  // before there is a mesh, the function returns false. If the computation is cancelled after a first mesh is
  // complete, the function keeps the last complete mesh and returns true.
  bool MakeRefined(const RadiositySolution& solution, const MeshOptions& options,
                   const ExecutionContext& context);
  // Forget() must be called after the light has changed. After Forget(), the next MakeRefined() does not
  // start from the mesh of RefineLight().
  void Forget() {
    has_looked_ = false;
    light_plan_.reset();
    samples_are_current_ = false;
  }
  // TakeNewLight() must be called after the light has changed by less than its error, so that the quadtree
  // leaves and the requested discontinuities of RefineLight() remain valid.
  void TakeNewLight() { samples_are_current_ = false; }
  // Replaces the interpolants of the mesh. REQUIRES: there is one interpolant for each triangle.
  void SetInterpolants(std::vector<QuadraticInterpolant> irradiance);
  // The tolerance of the irradiance samples for interpolants that represent the light of single emitters.
  double EmitterTolerance() const;
  // Calls the observer with each mesh that RefineLight() and MakeRefined() make on their way.
  void Observe(std::function<void(const IrradianceMesh&)> observer) { observer_ = std::move(observer); }
  // Replaces the mesh by a mesh that another object has made.
  void Take(IrradianceMesh mesh);
  // ForgetVisibility() must be called after the PatchVisibility passed to the constructor has been replaced.
  void ForgetVisibility() {
    local_pass_.reset();
    samples_.Clear();
  }

  // Divides the solution's leaves into smaller light sources than RefineLight() does. If the computation is
  // cancelled, the result must not be used.
  SourceCells FinestCells(const RadiositySolution& solution, const ExecutionContext& context);
  // Returns the exact irradiance from light sources that are more accurate than those of the solution. If the
  // radiosities of `finest` differ from those of the solution, the further reflections of this difference of
  // radiosities are computed over the links and added. The further reflections matter between walls that face
  // each other, which reflect a difference of radiosities many times. If the computation is cancelled, the
  // function returns null.
  std::unique_ptr<const PointIrradiance> BetterIrradiance(const RadiositySolution& solution,
                                                          const SourceCells& finest,
                                                          const ExecutionContext& context);
  // Returns the exact irradiance from the sources `finest` alone, without the further reflections that
  // BetterIrradiance() adds. ShownIrradiance() gathers once from the light that the mesh displays. If links
  // transport light through walls by mistake, the result of ShownIrradiance() does not contain this light,
  // because links are not used.
  std::unique_ptr<const PointIrradiance> ShownIrradiance(const RadiositySolution& solution,
                                                         const SourceCells& finest);

  const IrradianceMesh& mesh() const { return mesh_; }
  // The quadtrees whose leaves triangulations() divides into triangles.
  const ElementForest& forest() const { return plan_.forest; }
  // The triangulations from which mesh() was made; the list is empty if the mesh was set by Take().
  std::span<const PatchTriangulation> triangulations() const { return triangulations_; }
  // The error of each triangle of the mesh; the list is empty if the triangles were not measured.
  std::span<const TriangleError> triangle_errors() const { return triangle_errors_; }

  // The report on the present mesh: numbers of its parts, and the evaluations and seconds that were spent to
  // make the mesh.
  const MeshReport& report() const { return report_; }
  // Returns the seconds spent since the last call of TakeSeconds().
  MeshSeconds TakeSeconds();
  // One line that says which error limits the refinement could not meet; nullopt if all limits were met.
  const std::optional<std::string>& unmet() const { return unmet_; }

 private:
  // Irradiance samples must store their form factors (kRecord) if the light will change again.
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
  MeshPlan plan_;  // the quadtree leaves, and the discontinuities requested as edges, of triangulations_
  std::vector<TriangleError> triangle_errors_;
  std::unique_ptr<LocalPassCache> local_pass_;  // data that local passes with visibility_ reuse
  SampleCache samples_;
  SourceSet samples_from_;  // the sources to which the form factors of the samples belong
  // True if the irradiance samples in samples_ belong to the present light.
  bool samples_are_current_ = false;
  std::vector<SourceCell> cells_;  // the sources of the present light; empty before RefineLight()
  MeshReport report_;
  double seconds_of_sources_ = 0;
  bool has_looked_ = false;  // true if RefineLight() has made mesh_ from the present light
  // The quadtree leaves and requested discontinuities of the last mesh that RefineLight() made.
  std::optional<MeshPlan> light_plan_;
  std::optional<std::string> unmet_;
  std::vector<KnownLight> known_;  // exact irradiance at the points where meshes were tested
  std::function<void(const IrradianceMesh&)> observer_;
};

}  // namespace penumbra
