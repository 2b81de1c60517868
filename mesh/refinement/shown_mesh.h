// mesh/refinement/shown_mesh.h
//
// The mesh that shows a solution, and its refinement by the error of what it shows (thesis 4.4.2). First the
// sources are refined, whose light comes from the interpolants; then the leaves, until the interpolants meet
// the requested error.

#pragma once

#include <cstdint>
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
};

// Seconds spent on sources and on meshes.
struct MeshSeconds {
  double sources = 0;
  MeshReport::Seconds mesh;
};

class ShownMesh {
 public:
  // All arguments must outlive the object. `irradiance` belongs to the solutions that are passed to the
  // functions below.
  ShownMesh(const Scene& scene, const PatchVisibility& visibility, CurrentIrradiance& irradiance,
            const ShownMeshOptions& options);

  // Makes the mesh of the solution's leaves. If cancelled, returns false and keeps the previous mesh.
  bool Make(const RadiositySolution& solution, const MeshOptions& options, const ExecutionContext& context);
  // Refines the light of a solver. Makes a first mesh of the solver's leaves, then alternates until the light
  // settles: cuts the sources by what the mesh shows, gives the means of the interpolants to the sources, and
  // refines the mesh. If cancelled, returns false and leaves the last complete light. REQUIRES:
  // solver.TakesLight().
  bool RefineLight(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  // Refines the leaves of a mesh: of the mesh of RefineLight() if there is one, otherwise of a new mesh of
  // the solution's leaves. If cancelled before there is a mesh, returns false. If cancelled later, keeps the
  // last complete mesh and returns true.
  bool MakeRefined(const RadiositySolution& solution, const MeshOptions& options,
                   const ExecutionContext& context);
  // For use after a change of the light: MakeRefined() will not start from the mesh of RefineLight().
  void Forget() {
    has_looked_ = false;
    light_plan_.reset();
  }
  // Shows a mesh from elsewhere.
  void Take(IrradianceMesh mesh);
  // For use after another PatchVisibility has replaced the present one.
  void ForgetVisibility() { local_pass_.reset(); }

  // The finest sources that the interpolants provide. Of no use if cancelled.
  SourceCells FinestCells(const RadiositySolution& solution, const ExecutionContext& context);
  // Exact irradiance from these sources. The sources include, over the
  // links, the bounces of the difference from the solution's sources: between walls that face each other, a
  // difference returns many times. Null if cancelled.
  std::unique_ptr<const PointIrradiance> BetterIrradiance(const RadiositySolution& solution,
                                                          const SourceCells& finest,
                                                          const ExecutionContext& context);
  // The same without these bounces: one more bounce of the shown light, independent of all links. Where links
  // transport light that should not exist, this result does not contain the bounces of that light.
  std::unique_ptr<const PointIrradiance> ShownIrradiance(const RadiositySolution& solution,
                                                         const SourceCells& finest);

  const IrradianceMesh& mesh() const { return mesh_; }
  // The triangulations of mesh(); empty if the mesh is from elsewhere.
  std::span<const PatchTriangulation> triangulations() const { return triangulations_; }
  // One per triangle of the mesh, if the triangles were measured.
  std::span<const TriangleError> triangle_errors() const { return triangle_errors_; }

  // The report of the last of the functions above: the counts of the mesh, and the total work (evaluations
  // and seconds) that led to the mesh.
  const MeshReport& report() const { return report_; }
  // Returns the seconds since the last call.
  MeshSeconds TakeSeconds();
  // One line that says which error limits refinement could not meet; nothing if it met all.
  const std::optional<std::string>& unmet() const { return unmet_; }

 private:
  void Begin();
  bool FirstLook(const RadiositySolution& solution, const MeshOptions& options, double tolerance,
                 const ExecutionContext& context);
  bool SettleSources(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  std::optional<double> RefineSources(LightSolver& solver, std::optional<double>& score,
                                      const ExecutionContext& context);
  bool RefineLeaves(const RadiositySolution& solution, const MeshOptions& options,
                    const ExecutionContext& context);
  std::optional<RefinedMesh> Refine(const RadiositySolution& solution, const MeshOptions& options,
                                    double error, double tolerance, SampleCache* samples,
                                    const ExecutionContext& context);
  double LookAround(std::size_t points, std::uint64_t seed, double tolerance,
                    const ExecutionContext& context);
  IrradianceSampler Sampler(double tolerance, const ExecutionContext& context);
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
  MeshReport report_;
  double seconds_of_sources_ = 0;
  bool has_looked_ = false;             // mesh_ is RefineLight()'s, for the present light
  std::optional<MeshPlan> light_plan_;  // with which RefineLight() ended, for the present light
  std::optional<std::string> unmet_;
};

}  // namespace penumbra
