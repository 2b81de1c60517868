// mesh/refinement/shown_mesh.h
//
// The mesh of a solution as it is shown, and its refinement by what it shows (thesis 4.4.2): of the sources,
// which take their light from the interpolants, then of the leaves, until the interpolants err by no more
// than was asked.

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
  int error_samples = 1;  // MeasureTriangles()
  std::uint64_t seed = 1;
  SolverOptions solver;  // those that the solution was made with
};

// What was spent on sources, and on meshes.
struct MeshSeconds {
  double sources = 0;
  MeshReport::Seconds mesh;
};

class ShownMesh {
 public:
  // All must outlive it. `irradiance` is that of the solutions that meshes are made of.
  ShownMesh(const Scene& scene, const PatchVisibility& visibility, CurrentIrradiance& irradiance,
            const ShownMeshOptions& options);

  // Makes the mesh of the solution's leaves. False if it was cancelled, which leaves the mesh before.
  bool Make(const RadiositySolution& solution, const MeshOptions& options, const ExecutionContext& context);
  // Refines the light of a solver: makes a first mesh of its leaves, cuts its sources by what that shows, and
  // gives them the means of the interpolants, in turns, until the light stands still. False if it was
  // cancelled, which leaves the last whole light. REQUIRES: solver.TakesLight().
  bool RefineLight(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  // Makes the mesh of the solution's leaves, or begins with that of RefineLight(), and refines the leaves.
  // What is cancelled once there is a mesh leaves the last whole one, and true. False if it was cancelled
  // before that.
  bool MakeRefined(const RadiositySolution& solution, const MeshOptions& options,
                   const ExecutionContext& context);
  // The light has changed: the mesh of RefineLight() is no beginning any more.
  void Forget() { has_looked_ = false; }
  // Shows a mesh that was made elsewhere.
  void Take(IrradianceMesh mesh);
  // After another PatchVisibility has taken the place of the present one.
  void ForgetVisibility() { local_pass_.reset(); }

  // Exact irradiance from the finest sources that the interpolants give, with the bounces over the links of
  // what these differ by: between walls that face each other a difference comes back many times. Null if it
  // was cancelled.
  std::unique_ptr<const PointIrradiance> BetterIrradiance(const RadiositySolution& solution,
                                                          const ExecutionContext& context);
  // The same without those bounces: what one more bounce makes of the light that is shown, past all links.
  // Where links carry light that should not be there, this does not bring it back.
  std::unique_ptr<const PointIrradiance> ShownIrradiance(const RadiositySolution& solution,
                                                         const ExecutionContext& context);

  const IrradianceMesh& mesh() const { return mesh_; }
  // What it was made of; empty if it was made elsewhere.
  std::span<const PatchTriangulation> triangulations() const { return triangulations_; }
  // One a triangle of the mesh, where they were measured.
  std::span<const TriangleError> triangle_errors() const { return triangle_errors_; }

  // Of what the last of the above made: counts are the mesh's, work is that of all that led to it.
  const MeshReport& report() const { return report_; }
  // The seconds that were spent since this was last called.
  MeshSeconds TakeSeconds();
  // What refinement could not reach; one line.
  const std::optional<std::string>& unmet() const { return unmet_; }

 private:
  void Begin();
  bool FirstLook(const RadiositySolution& solution, const MeshOptions& options, double tolerance,
                 const ExecutionContext& context);
  bool SettleSources(LightSolver& solver, const MeshOptions& options, const ExecutionContext& context);
  std::optional<double> RefineSources(LightSolver& solver, std::optional<double>& score,
                                      const ExecutionContext& context);
  void RefineLeaves(const RadiositySolution& solution, const MeshOptions& options,
                    const ExecutionContext& context);
  std::optional<RefinedMesh> Refine(const RadiositySolution& solution, const MeshOptions& options,
                                    double error, double tolerance, SampleCache* samples,
                                    const ExecutionContext& context);
  double LookAround(std::size_t points, std::uint64_t seed, double tolerance,
                    const ExecutionContext& context);
  SourceCells Cells(const RadiositySolution& solution, const ExecutionContext& context);
  IrradianceSampler Sampler(double tolerance, const ExecutionContext& context);
  LocalPassCache& LocalPass();
  void Add(MeshReport latest);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  CurrentIrradiance& irradiance_;
  const ShownMeshOptions options_;

  IrradianceMesh mesh_;
  std::vector<PatchTriangulation> triangulations_;
  MeshPlan plan_;  // that they were made of
  std::vector<TriangleError> triangle_errors_;
  std::unique_ptr<LocalPassCache> local_pass_;  // of the present visibility
  MeshReport report_;
  double seconds_of_sources_ = 0;
  bool has_looked_ = false;  // the mesh is that of RefineLight(), of the present light
  std::optional<std::string> unmet_;
};

}  // namespace penumbra
